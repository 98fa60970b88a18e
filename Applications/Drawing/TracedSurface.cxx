// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TracedSurface.h"

#include "Methods.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDF.h"
#include "vtkCamera.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTracedRadianceIntegrator.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace
{
/// What rays through pixels meet, and the directions back to the eye.
struct Rays
{
  vtkNew<vtkPolyData> Hits;
  vtkNew<vtkDoubleArray> Views;
};

// Through the middle of each pixel or, where that just misses the mesh, through the first place on
// a spiral around it that does not.
void CastRays(vtkTracedScene* traced, const tool::OffscreenScene& camera,
  const tool::Surface& surface, const tool::Size& size, Rays& rays)
{
  constexpr int attempts = 32;
  constexpr double farthest = 0.75;       // pixels
  constexpr double turn = 2.399963229728; // the golden angle
  const auto count = static_cast<vtkIdType>(surface.Pixels.size());
  vtkNew<vtkDoubleArray> origins, directions;
  for (vtkDoubleArray* array : { origins.Get(), directions.Get(), rays.Views.Get() })
  {
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(count);
  }
  glm::dvec3 eye;
  camera.GetCamera()->GetPosition(&eye.x);
  std::vector<bool> met(surface.Pixels.size(), false);
  const auto missed = [&met]() { return std::find(met.begin(), met.end(), false) != met.end(); };
  for (int attempt = 0; attempt <= attempts && missed(); ++attempt)
  {
    const double radius = farthest * std::sqrt(static_cast<double>(attempt) / attempts);
    for (vtkIdType k = 0; k < count; ++k)
    {
      if (!met[static_cast<std::size_t>(k)])
      {
        const int pixel = surface.Pixels[static_cast<std::size_t>(k)];
        const glm::dvec3 ray =
          camera.GetRay(pixel % size.Width + 0.5 + radius * std::cos(turn * attempt),
            pixel / size.Width + 0.5 + radius * std::sin(turn * attempt), size.Width, size.Height);
        origins->SetTuple(k, &eye.x);
        directions->SetTuple(k, &ray.x);
        rays.Views->SetTuple3(k, -ray.x, -ray.y, -ray.z);
      }
    }
    traced->CastRays(origins, directions, rays.Hits);
    auto* surfaces = vtkIntArray::SafeDownCast(rays.Hits->GetPointData()->GetArray("Surface"));
    for (vtkIdType k = 0; k < count; ++k)
    {
      met[static_cast<std::size_t>(k)] = surfaces->GetValue(k) >= 0;
    }
  }
}

}

namespace tool
{
//------------------------------------------------------------------------------
void TraceOptions::AddTo(CLI::App* command)
{
  command
    ->add_option(
      "--samples", this->Samples, "Where light is traced, directions a pixel (default 512)")
    ->check(CLI::Range(8, 1 << 24));
  command
    ->add_option("--bounces", this->Bounces,
      "Where light is traced, how often that of surfaces was reflected at most (default 0: what "
      "hides the sky is black)")
    ->check(CLI::Range(0, 1000));
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTracedScene> MakeTracedScene(vtkPolyData* mesh)
{
  auto traced = vtkSmartPointer<vtkTracedScene>::New();
  traced->AddSurface(mesh);
  if (traced->GetNumberOfTriangles() == 0)
  {
    throw Error("the mesh has no triangle that could hide anything");
  }
  return traced;
}

//------------------------------------------------------------------------------
TracedSurface TraceSurface(vtkTracedScene* traced, vtkBRDF* brdf, vtkEnvironment* environment,
  const OffscreenScene& camera, const Surface& surface, const Size& size,
  const TraceOptions& options)
{
  Rays rays;
  CastRays(traced, camera, surface, size, rays);
  vtkNew<vtkTracedRadianceIntegrator> integrator;
  integrator->SetScene(traced);
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  integrator->SetNumberOfSamples(options.Samples);
  integrator->SetNumberOfBounces(options.Bounces);
  vtkNew<vtkDoubleArray> radiance;
  vtkNew<vtkDoubleArray> unoccluded;
  vtkSmartPointer<vtkDoubleArray> tangents;
  if (!brdf->IsIsotropic())
  {
    std::vector<double> normals(3 * surface.Pixels.size());
    for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
    {
      rays.Hits->GetPointData()->GetNormals()->GetTuple(static_cast<vtkIdType>(k), &normals[3 * k]);
    }
    tangents = MakeTangents(normals);
  }
  const bool done = RunWithProgress(
    integrator.Get(),
    [&](vtkTracedRadianceIntegrator* made)
    { return made->Integrate(rays.Hits, rays.Views, radiance, unoccluded, tangents); },
    "tracing");
  if (!done)
  {
    throw Error("tracing: " + TakeErrorText());
  }
  return { ToVector(radiance), ToVector(unoccluded), integrator->GetNoise() };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkOcclusionPredictor> PredictOcclusion(
  vtkTracedScene* traced, vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto predictor = vtkSmartPointer<vtkOcclusionPredictor>::New();
  predictor->SetScene(traced);
  predictor->SetBRDF(brdf);
  predictor->SetEnvironment(environment);
  if (!predictor->Update())
  {
    throw Error("predicting occlusion: " + TakeErrorText());
  }
  return predictor;
}

} // namespace tool
