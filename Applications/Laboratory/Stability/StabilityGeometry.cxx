// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: directions and meshes at their limits.
#include "Meshes.h"
#include "Stability.h"
#include "Surface.h"

#include "vtkCellArray.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tool::stability;

namespace
{
constexpr int Size = 48;

//------------------------------------------------------------------------------
void RunGrazing(Context& context)
{
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const Pairs sphere = MakeSpherePairs(context.Short ? 80 : 200);
  const std::vector<double> angles = context.Short
                                       ? std::vector<double>{ 85.0, 89.9 }
                                       : std::vector<double>{ 80.0, 85.0, 88.0, 89.0, 89.9 };
  std::vector<std::vector<double>> references;
  for (const double angle : angles)
  {
    references.push_back(IntegrateReference(brdf, environment, AtAngle(sphere, angle)));
  }
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    const vtkSmartPointer<vtkRadianceIntegrator> integrator = contender.Make(brdf, environment);
    double bad = 0.0;
    for (std::size_t k = 0; k < angles.size(); ++k)
    {
      const std::vector<double> radiance = Integrate(integrator, AtAngle(sphere, angles[k]));
      bad += CountBad(radiance);
      context.Add(contender.Name, "error at " + Say(angles[k]) + " degrees",
        GetRelativeL1(radiance, references[k]),
        { 0.05, { { "thesis", 0.4 } }, "harmonics are worst at grazing angles" });
    }
    context.Add(contender.Name, "negative or not finite", bad, 0.0);
  }
}

//------------------------------------------------------------------------------
// i = -o: the half vector is 0/0 there. Both lie on the horizon in the limit.
void RunOpposite(Context& context)
{
  double bad = 0.0;
  const auto look = [&](vtkBRDF* brdf)
  {
    brdf->Prepare();
    for (double cosine = 0.1; cosine > 1e-17; cosine *= 0.1)
    {
      for (const double azimuth : { 0.0, 0.7, 3.0 })
      {
        const double s = std::sqrt(1.0 - cosine * cosine);
        const double i[3] = { s * std::cos(azimuth), s * std::sin(azimuth), cosine };
        const double o[3] = { -i[0], -i[1], cosine };
        std::vector<double> values(9);
        brdf->Evaluate(i, o, values.data());
        brdf->EvaluateSoft(i, o, 0.1, values.data() + 3);
        brdf->Evaluate(i, i, values.data() + 6);
        values.push_back(brdf->Pdf(i, o));
        bad += CountBad(values);
      }
    }
  };
  for (int m = 0; m < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++m)
  {
    look(vtkSmartPointer<vtkBRDF>::Take(
      vtkEmbeddedMaterials::NewBRDF(vtkEmbeddedMaterials::GetName(m))));
  }
  for (int basis = 0; basis < 4; ++basis)
  {
    look(Project(MakePlastic(20.0), basis, 6));
  }
  if (context.BRDF)
  {
    look(context.BRDF);
  }
  context.Add("all materials", "values negative or not finite at i = -o", bad, 0.0);
}

//------------------------------------------------------------------------------
/// A sphere with its normals changed.
vtkSmartPointer<vtkPolyData> MakeSphereWith(
  const std::function<void(vtkIdType index, float normal[3])>& change)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(tool::MakeSphere());
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  vtkNew<vtkFloatArray> changed;
  changed->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < normals->GetNumberOfTuples(); ++k)
  {
    double tuple[3];
    normals->GetTuple(k, tuple);
    float normal[3] = { static_cast<float>(tuple[0]), static_cast<float>(tuple[1]),
      static_cast<float>(tuple[2]) };
    change(k, normal);
    changed->InsertNextTuple(normal);
  }
  mesh->GetPointData()->SetNormals(changed);
  return mesh;
}

vtkSmartPointer<vtkPolyData> MakeScaledNormals(float factor)
{
  return MakeSphereWith(
    [factor](vtkIdType, float normal[3])
    {
      for (int c = 0; c < 3; ++c)
      {
        normal[c] *= factor;
      }
    });
}

//------------------------------------------------------------------------------
// Triangles without area, with corners in one place, and one far away: normals come from
// derivatives.
vtkSmartPointer<vtkPolyData> MakeDegenerate()
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(tool::MakeSphere());
  mesh->GetPointData()->SetNormals(nullptr);
  const vtkIdType line[3] = { 0, 1, 1 };
  const vtkIdType point[3] = { 2, 2, 2 };
  vtkNew<vtkPoints> points;
  points->DeepCopy(mesh->GetPoints());
  const vtkIdType sliver[3] = { 0, 1, points->InsertNextPoint(0.0, 1e-30, 1.0) };
  mesh->SetPoints(points);
  for (const vtkIdType* corners : { line, point, sliver })
  {
    mesh->GetPolys()->InsertNextCell(3, corners);
  }
  mesh->GetPolys()->Modified();
  return mesh;
}

//------------------------------------------------------------------------------
void RunMeshes(Context& context)
{
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<vtkSmartPointer<vtkPolyData>> meshes = { tool::MakeSphere(),
    MakeScaledNormals(-1.0f), MakeScaledNormals(0.0f),
    MakeSphereWith(
      [nan](vtkIdType k, float normal[3])
      {
        if (k % 3 == 0)
        {
          normal[k % 2] = nan;
        }
      }),
    MakeDegenerate() };
  // Interpolated, normals of any length but 0 must come out as unit ones.
  const std::vector<vtkSmartPointer<vtkPolyData>> scaled = { MakeScaledNormals(1e-3f),
    MakeScaledNormals(1e3f) };
  StabilityRenderer offscreen(context);
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    offscreen.SetIntegrator(contender.Make(brdf, environment));
    double bad = 0.0;
    for (const auto& mesh : meshes)
    {
      offscreen.SetMesh(mesh);
      offscreen.Draw(Size);
      bad += offscreen.GetNumberOfBad();
    }
    context.Add(contender.Name,
      "pixels negative or not finite: normals away, zero, NaN; triangles without area", bad, 0.0);
    offscreen.SetMesh(meshes[0]);
    const tool::Picture unit = offscreen.Draw(Size);
    double worst = 0.0;
    for (const auto& mesh : scaled)
    {
      offscreen.SetMesh(mesh);
      worst = std::max(worst, GetPictureDifference(offscreen.Draw(Size), unit));
    }
    context.Add(contender.Name, "difference by normals of length 0.001 and 1000", worst, 1e-3);
  }
}

//------------------------------------------------------------------------------
// Largest step along a path of normals, over that of the reference.
double GetStepRatio(const std::vector<double>& x, const std::vector<double>& reference)
{
  double steps[2] = { 0.0, 0.0 };
  for (std::size_t k = 3; k < x.size(); ++k)
  {
    steps[0] = std::max(steps[0], std::abs(x[k] - x[k - 3]));
    steps[1] = std::max(steps[1], std::abs(reference[k] - reference[k - 3]));
  }
  return steps[0] / steps[1];
}

//------------------------------------------------------------------------------
// Normals that cross the poles of the map, its seam, and the view itself, on the GPU.
void RunPoles(Context& context)
{
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(30.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const Vector view = { -0.48, 0.6, 0.64 };
  struct Path
  {
    std::string Name;
    Vector Middle;
    Vector Along;
    Pairs Points;
    std::vector<double> Reference;
  };
  std::vector<Path> paths = { { "pole", { 0.0, 1.0, 0.0 }, { 0.8, 0.0, 0.6 }, {}, {} },
    { "seam", { -1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, {}, {} },
    { "normal along the view", view, { 0.8, 0.0, 0.6 }, {}, {} } };
  for (Path& path : paths)
  {
    // 0.1 degree steps, none at the pole itself.
    for (int k = -40; k < 40; ++k)
    {
      const double angle = vtkMath::RadiansFromDegrees(0.1 * (k + 0.5));
      Vector n;
      for (std::size_t c = 0; c < 3; ++c)
      {
        n[c] = std::cos(angle) * path.Middle[c] + std::sin(angle) * path.Along[c];
      }
      vtkMath::Normalize(n.data());
      path.Points.Add(n, view);
    }
    path.Reference = IntegrateReference(brdf, environment, path.Points);
  }
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    const vtkSmartPointer<vtkRadianceIntegrator> integrator = contender.Make(brdf, environment);
    for (const Path& path : paths)
    {
      context.Add(contender.Name,
        "largest step over that of the reference, across the " + path.Name,
        GetStepRatio(
          tool::DrawPairs(integrator, path.Points.Normals, path.Points.Views), path.Reference),
        { 1.5,
          { { "median-cut", 6.0 }, { "importance", 4.0 }, { "variance", 4.0 }, { "thesis", 6.0 },
            { "filtered", 12.0 } },
          "dots of few lights and rays of few samples, not the map" });
    }
  }
}

//------------------------------------------------------------------------------
// The same light with the map's columns elsewhere: nothing may change.
void RunSeams(Context& context)
{
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(30.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 128);
  const Pairs pairs = MakeSpherePairs(150);
  const int width = environment->GetWidth();
  // The brightest texel comes to lie on the seam.
  const std::vector<float>& pixels = environment->GetPixels();
  const auto brightest =
    static_cast<int>((std::max_element(pixels.begin(), pixels.end()) - pixels.begin()) / 3 % width);
  const vtkSmartPointer<vtkEnvironment> rolled = Roll(environment, width - brightest);
  rolled->SetRotationY(360.0 * (width - brightest) / width);
  const std::vector<double> reference = IntegrateReference(brdf, environment, pairs);
  context.Add("reference", "difference by where the map's seam lies",
    GetRelativeL1(IntegrateReference(brdf, rolled, pairs), reference), 2e-3,
    "the sun moved onto the seam and turned back");
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    const std::vector<double> here = Integrate(contender.Make(brdf, environment), pairs);
    const std::vector<double> there = Integrate(contender.Make(brdf, rolled), pairs);
    context.Add(contender.Name, "difference by where the map's seam lies",
      GetRelativeL1(there, here),
      { 0.02, { { "median-cut", 0.06 }, { "importance", 0.1 }, { "thesis", 0.06 } },
        "cuts and draws begin at the seam: other lights" });
  }
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void AddGeometryCases(std::vector<Case>& cases)
{
  cases.push_back({ "grazing", "geometry", "views at 80 to 89.9 degrees", RunGrazing });
  cases.push_back(
    { "opposite", "geometry", "light from where the view looks to, i = -o", RunOpposite });
  cases.push_back({ "meshes", "geometry", "normals and triangles that are none", RunMeshes });
  cases.push_back({ "poles", "geometry", "poles and seams of maps and tables", RunPoles });
  cases.push_back({ "seams", "geometry", "a sun on the map's seam", RunSeams });
}
} // namespace tool::stability
