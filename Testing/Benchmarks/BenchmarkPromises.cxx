// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether plans keep what they say: materials under maps, one plan for all views (or one for each
// picture, --for-view), and the error of the chosen method in pictures of several shapes, against
// the reference. A line of CSV for each picture, then how many promises were broken, by how much,
// and how far the predictions were off. Minutes for each tolerance; errors, not times.
#include "BenchmarkCase.h"
#include "OcclusionMeshes.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDF.h"
#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkGenericCell.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricSuperEllipsoid.h"
#include "vtkParametricTorus.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkRTAnalyticSource.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkStaticCellLocator.h"
#include "vtkXMLPolyDataReader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
constexpr int PlannedPixels = 16384; // that a plan for the view is given: others than are compared
const char* const Everywhere = "everywhere";

// What some pixels of a picture show.
struct Pixels
{
  vtkNew<vtkDoubleArray> Normals, Views;

  Pixels()
  {
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
  }
};

struct Picture
{
  std::string Name;
  Pixels Compared, Planned, Finer, Finest;
};

vtkSmartPointer<vtkPolyData> MakeMesh(const std::string& name)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SplittingOff();
  vtkNew<vtkXMLPolyDataReader> file;
  if (name.find('/') != std::string::npos)
  {
    file->SetFileName(name.c_str());
    normals->SetInputConnection(file->GetOutputPort());
  }
  else if (name == "sphere")
  {
    vtkNew<vtkSphereSource> source;
    source->SetThetaResolution(256);
    source->SetPhiResolution(128);
    normals->SetInputConnection(source->GetOutputPort());
  }
  else if (name == "plate")
  {
    vtkNew<vtkPlaneSource> source;
    normals->SetInputConnection(source->GetOutputPort());
  }
  else if (name == "isosurface")
  {
    vtkNew<vtkRTAnalyticSource> source;
    vtkNew<vtkContourFilter> contour;
    contour->SetInputConnection(source->GetOutputPort());
    contour->SetValue(0, 157.0);
    normals->SetInputConnection(contour->GetOutputPort());
  }
  else if (name == "knob" || name == "bumps")
  {
    return MakeOcclusionMesh(name);
  }
  else
  {
    vtkNew<vtkParametricTorus> torus;
    torus->SetRingRadius(0.7);
    torus->SetCrossSectionRadius(0.35);
    vtkNew<vtkParametricSuperEllipsoid> box; // rounded
    box->SetN1(0.3);
    box->SetN2(0.3);
    vtkNew<vtkParametricFunctionSource> source;
    source->SetUResolution(256);
    source->SetVResolution(128);
    source->SetParametricFunction(name == "torus" ? static_cast<vtkParametricFunction*>(torus)
                                                  : static_cast<vtkParametricFunction*>(box));
    normals->SetInputConnection(source->GetOutputPort());
  }
  normals->Update();
  return normals->GetOutput();
}

// About so many pixels of a picture in perspective, from an oblique direction, that show the mesh.
// turn: the camera, in degrees, about the vertical axis.
void Look(vtkPolyData* mesh, int count, double turn, Pixels& pixels)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  double center[3];
  mesh->GetCenter(center);
  const double radius = 0.5 * mesh->GetLength();
  const double turned = vtkMath::RadiansFromDegrees(turn);
  double towards[3] = { std::cos(turned) + 2.0 * std::sin(turned), 0.8,
    2.0 * std::cos(turned) - std::sin(turned) };
  double right[3], up[3], eye[3];
  vtkMath::Normalize(towards);
  const double y[3] = { 0.0, 1.0, 0.0 };
  vtkMath::Cross(y, towards, right);
  vtkMath::Normalize(right);
  vtkMath::Cross(towards, right, up);
  for (int c = 0; c < 3; ++c)
  {
    eye[c] = center[c] + 4.0 * radius * towards[c];
  }
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  vtkNew<vtkGenericCell> cell;
  const int side = static_cast<int>(std::sqrt(2.0 * count));
  for (int k = 0; k < side * side; ++k)
  {
    const double at[2] = { 2.0 * (k % side + 0.5) / side - 1.0,
      2.0 * (k / side + 0.5) / side - 1.0 };
    double end[3], t, x[3], local[3], weights[8];
    int sub;
    vtkIdType id;
    for (int c = 0; c < 3; ++c)
    {
      const double target = center[c] + radius * (at[0] * right[c] + at[1] * up[c]);
      end[c] = eye[c] + 2.0 * (target - eye[c]);
    }
    if (!locator->IntersectWithLine(eye, end, 1e-9, t, x, local, sub, id, cell))
    {
      continue;
    }
    cell->EvaluateLocation(sub, local, x, weights);
    double n[3] = { 0.0, 0.0, 0.0 };
    double o[3];
    for (int c = 0; c < 3; ++c)
    {
      for (vtkIdType p = 0; p < cell->GetNumberOfPoints(); ++p)
      {
        n[c] += weights[p] * normals->GetComponent(cell->GetPointId(p), c);
      }
      o[c] = eye[c] - x[c];
    }
    vtkMath::Normalize(n);
    vtkMath::Normalize(o);
    vtkMath::MultiplyScalar(n, vtkMath::Dot(n, o) < 0.0 ? -1.0 : 1.0); // as VTK turns them
    pixels.Normals->InsertNextTuple(n);
    pixels.Views->InsertNextTuple(o);
  }
}

// Relative L1 of some of a picture's pixels, and its standard error: a few of them can decide.
struct Error
{
  double Value = 0.0;
  double Deviation = 0.0;
  vtkIdType Pixels = 0;

  Error() = default;
  Error(vtkDoubleArray* radiance, vtkDoubleArray* reference)
  {
    const vtkIdType pixels = this->Pixels = reference->GetNumberOfTuples();
    std::vector<double> differences(static_cast<std::size_t>(pixels));
    std::vector<double> references(static_cast<std::size_t>(pixels));
    double sum = 0.0;
    for (vtkIdType k = 0; k < pixels; ++k)
    {
      const std::size_t at = static_cast<std::size_t>(k);
      for (int c = 0; c < 3; ++c)
      {
        const double wanted = reference->GetComponent(k, c);
        differences[at] += std::abs(radiance->GetComponent(k, c) - wanted);
        references[at] += wanted;
      }
      this->Value += differences[at];
      sum += references[at];
    }
    sum = std::max(sum, 1e-30); // black pictures
    this->Value /= sum;
    for (std::size_t k = 0; k < differences.size(); ++k)
    {
      this->Deviation += std::pow(differences[k] - this->Value * references[k], 2.0);
    }
    this->Deviation = std::sqrt(this->Deviation) / sum;
  }
};

// The reference takes nearly all of the time, and does not change with the planner.
bool ReadDoubles(const std::string& file, vtkDoubleArray* values, vtkIdType tuples)
{
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(tuples);
  std::ifstream stream(file, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(3 * sizeof(double)) * tuples;
  return stream.read(reinterpret_cast<char*>(values->GetPointer(0)), bytes) &&
         stream.peek() == std::ifstream::traits_type::eof();
}

bool MakeReference(vtkBRDF* brdf, vtkEnvironment* environment, const Pixels& pixels,
  const std::string& file, vtkDoubleArray* reference)
{
  if (!file.empty() && ReadDoubles(file, reference, pixels.Normals->GetNumberOfTuples()))
  {
    return true;
  }
  vtkNew<vtkAdaptiveRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  if (!integrator->Integrate(pixels.Normals, pixels.Views, reference))
  {
    return false;
  }
  if (!file.empty())
  {
    std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(reference->GetPointer(0)),
        static_cast<std::streamsize>(sizeof(double)) * reference->GetNumberOfValues());
  }
  return true;
}

std::string GetStem(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return name.substr(0, name.find('.'));
}

// What was promised and what came, over all pictures.
class Count
{
public:
  void Add(double predicted, const Error& measured)
  {
    this->Ratios.push_back(measured.Value / std::max(predicted, 1e-6));
    this->Sure += measured.Value - 2.0 * measured.Deviation > predicted ? 1 : 0;
  }

  void Print(const char* of)
  {
    std::sort(this->Ratios.begin(), this->Ratios.end());
    const auto share = [this](double from, double to)
    {
      const auto inside = std::count_if(this->Ratios.begin(), this->Ratios.end(),
        [from, to](double ratio) { return ratio > from && ratio <= to; });
      return 100.0 * static_cast<double>(inside) / static_cast<double>(this->Ratios.size());
    };
    if (!this->Ratios.empty())
    {
      std::printf(
        "# %s: %zu; measured / predicted: median %.2f, worst %.2f; above 1: %.1f %% (%d by "
        "more than two standard errors of the measurement), above 1.25: %.1f %%, within a "
        "factor of 2: %.1f %%\n",
        of, this->Ratios.size(), this->Ratios[this->Ratios.size() / 2], this->Ratios.back(),
        share(1.0, 1e9), this->Sure, share(1.25, 1e9), share(0.5, 2.0));
    }
  }

private:
  std::vector<double> Ratios;
  int Sure = 0; // broken promises that are no matter of chance
};
}

int main(int argc, char** argv)
{
  std::vector<std::string> materials, environments;
  std::vector<std::string> shapes = { Everywhere, "sphere", "torus", "box", "isosurface", "plate" };
  std::vector<double> tolerances = { 0.02 };
  int pixels = 1000;
  bool forView = false;
  std::string references;
  int refine = 1;
  double turn = 0.0;
  CLI::App app("Whether plans keep what they say.");
  app.add_option("--materials", materials, "Files or embedded names")->required();
  app.add_option("--environments", environments, "Files or embedded names")->required();
  app.add_option("--shapes", shapes, "Those above, knob, bumps or .vtp files");
  app.add_option("--tolerances", tolerances);
  app.add_option("--pixels", pixels, "Of each picture, about");
  app.add_flag("--for-view", forView, "One plan for each picture");
  app.add_option("--references", references,
    "A folder that keeps the reference for the next run, of the same meshes and pixels");
  app.add_option("--refine", refine,
    "Where an error plus two standard errors is above the promise, measure it again with so many "
    "times the pixels; and where it is still above, with the square of that");
  app.add_option("--turn", turn, "Of the camera, in degrees: other pictures than usual");
  CLI11_PARSE(app, argc, argv);

  std::vector<Picture> pictures;
  pictures.reserve(shapes.size());
  for (const std::string& shape : shapes)
  {
    pictures.emplace_back();
    Picture& picture = pictures.back();
    picture.Name = shape;
    const vtkSmartPointer<vtkPolyData> mesh = shape == Everywhere ? nullptr : MakeMesh(shape);
    for (const auto& [some, count] : { std::pair(&picture.Compared, pixels),
           std::pair(&picture.Planned, PlannedPixels), std::pair(&picture.Finer, refine * pixels),
           std::pair(&picture.Finest, refine * refine * pixels) })
    {
      if (mesh)
      {
        Look(mesh, count, turn, *some);
      }
      else
      {
        AddEverywherePairs(count, some->Normals, some->Views);
      }
    }
  }
  std::printf(
    "material,environment,shape,pixels,tolerance,method,sizes,MB,cost,predicted,uncertainty,"
    "measured,deviation,tried,cpu\n");
  std::vector<Count> counts(shapes.size());
  Count all;
  for (const std::string& light : environments)
  {
    const vtkSmartPointer<vtkEnvironment> environment = BenchmarkCase::FindEnvironment(light);
    for (const std::string& material : materials)
    {
      const vtkSmartPointer<vtkBRDF> brdf = BenchmarkCase::FindBRDF(material);
      if (!environment || !brdf)
      {
        std::fprintf(stderr, "%s, %s: not found\n", material.c_str(), light.c_str());
        return 1;
      }
      std::vector<vtkSmartPointer<vtkRadiancePlanner>> planners;
      for (const double tolerance : tolerances)
      {
        planners.push_back(vtkSmartPointer<vtkRadiancePlanner>::New());
        planners.back()->SetBRDF(brdf);
        planners.back()->SetEnvironment(environment);
        planners.back()->SetErrorTolerance(tolerance);
      }
      for (std::size_t k = 0; k < pictures.size(); ++k)
      {
        Picture& picture = pictures[k];
        const auto measure =
          [&](vtkRadianceIntegrator* method, const Pixels& compared, const char* suffix)
        {
          vtkNew<vtkDoubleArray> reference, radiance;
          const std::string file = references.empty()
                                     ? ""
                                     : references + "/" + GetStem(material) + "-" + GetStem(light) +
                                         "-" + GetStem(picture.Name) + suffix + ".double";
          return MakeReference(brdf, environment, compared, file, reference) &&
                     method->Integrate(compared.Normals, compared.Views, radiance)
                   ? Error(radiance, reference)
                   : Error();
        };
        for (std::size_t t = 0; t < tolerances.size(); ++t)
        {
          vtkRadiancePlanner* planner = planners[t];
          if (forView)
          {
            planner->SetPairs(picture.Planned.Normals, picture.Planned.Views);
          }
          const std::clock_t start = std::clock();
          if (!planner->Update())
          {
            return 1;
          }
          const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
          const int choice = planner->GetChoice();
          const auto chosen =
            vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
          const double predicted = planner->GetPredictedError(choice);
          Error measured = measure(chosen, picture.Compared, "");
          if (refine > 1 && measured.Value + 2.0 * measured.Deviation > predicted)
          {
            measured = measure(chosen, picture.Finer, "-finer");
          }
          if (refine > 1 && measured.Value > predicted)
          {
            measured = measure(chosen, picture.Finest, "-finest");
          }
          if (measured.Pixels == 0)
          {
            return 1;
          }
          std::printf("%s,%s,%s,%lld,%g,%s,\"%s\",%.2f,%.2f,%.5f,%.5f,%.5f,%.5f,%d,%.2f\n",
            GetStem(material).c_str(), GetStem(light).c_str(), picture.Name.c_str(),
            static_cast<long long>(measured.Pixels), tolerances[t],
            planner->GetMethodName(choice).c_str(), planner->GetDescription(choice).c_str(),
            1e-6 * static_cast<double>(planner->GetTextureBytes(choice)),
            planner->GetPredictedCost(choice), predicted, planner->GetErrorUncertainty(choice),
            measured.Value, measured.Deviation, planner->GetNumberOfCandidates(), seconds);
          std::fflush(stdout);
          counts[k].Add(predicted, measured);
          all.Add(predicted, measured);
        }
      }
    }
  }
  for (std::size_t k = 0; k < shapes.size(); ++k)
  {
    counts[k].Print(shapes[k].c_str());
  }
  all.Print("all pictures");
  return 0;
}
