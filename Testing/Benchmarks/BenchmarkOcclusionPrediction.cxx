// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Whether the error of leaving occlusion out is what a few hundred traced points foretell: meshes,
// materials and maps, against many more points as cameras all around see them, with other rays. A
// line of CSV for each mesh, material and map, then how far the predictions were off. Errors, not
// times.
#include "BenchmarkCase.h"
#include "vtkAppendPolyData.h"
#include "vtkContourFilter.h"
#include "vtkCubeSource.h"
#include "vtkCylinderSource.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkOcclusionPredictor.h"
#include "vtkPLYReader.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkRTAnalyticSource.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTracedRadianceIntegrator.h"
#include "vtkTracedScene.h"
#include "vtkXMLPolyDataReader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace
{
constexpr double Within = 1.5;
// Errors below a tenth of the usual tolerance count as this much: nobody asks for their ratio.
constexpr double LeastError = 0.002;
constexpr int MostPredicted = 6400;
constexpr double SharpAngle = 40.0; // degrees: edges that stay sharp

//------------------------------------------------------------------------------
// 60 balls on a helix that touch and overlap.
void AddMolecule(vtkAppendPolyData* parts)
{
  for (int k = 0; k < 60; ++k)
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetCenter(std::cos(0.7 * k), 0.07 * k, std::sin(0.7 * k));
    ball->SetRadius(k % 3 == 0 ? 0.45 : 0.3);
    ball->SetThetaResolution(24);
    ball->SetPhiResolution(16);
    parts->AddInputConnection(ball->GetOutputPort());
  }
}

// A base plate with ribs, bolts and a hub.
void AddMachinePart(vtkAppendPolyData* parts)
{
  vtkNew<vtkCubeSource> plate;
  plate->SetBounds(-2.0, 2.0, -0.2, 0.0, -1.5, 1.5);
  parts->AddInputConnection(plate->GetOutputPort());
  for (int k = 0; k < 7; ++k)
  {
    vtkNew<vtkCubeSource> rib;
    rib->SetBounds(-1.8 + 0.55 * k, -1.65 + 0.55 * k, 0.0, 0.9, -1.3, 0.2);
    parts->AddInputConnection(rib->GetOutputPort());
    vtkNew<vtkCylinderSource> bolt;
    bolt->SetResolution(24);
    bolt->SetCenter(-1.7 + 0.55 * k, 0.15, 1.1);
    bolt->SetHeight(0.4);
    bolt->SetRadius(0.15);
    parts->AddInputConnection(bolt->GetOutputPort());
  }
  vtkNew<vtkCylinderSource> hub;
  hub->SetResolution(64);
  hub->SetCenter(0.0, 0.5, 0.65);
  hub->SetHeight(1.2);
  hub->SetRadius(0.3);
  parts->AddInputConnection(hub->GetOutputPort());
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeMesh(const std::string& name)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetFeatureAngle(SharpAngle);
  vtkNew<vtkXMLPolyDataReader> vtp;
  vtkNew<vtkPLYReader> ply;
  vtkNew<vtkAppendPolyData> parts;
  if (name.find('/') != std::string::npos)
  {
    const bool isPly = name.size() > 4 && name.substr(name.size() - 4) == ".ply";
    vtp->SetFileName(name.c_str());
    ply->SetFileName(name.c_str());
    normals->SetInputConnection(isPly ? ply->GetOutputPort() : vtp->GetOutputPort());
  }
  else if (name == "isosurface")
  {
    vtkNew<vtkRTAnalyticSource> source;
    vtkNew<vtkContourFilter> contour;
    contour->SetInputConnection(source->GetOutputPort());
    contour->SetValue(0, 157.0);
    normals->SetInputConnection(contour->GetOutputPort());
  }
  else if (name == "torus")
  {
    vtkNew<vtkParametricTorus> torus;
    torus->SetRingRadius(0.7);
    torus->SetCrossSectionRadius(0.35);
    vtkNew<vtkParametricFunctionSource> source;
    source->SetParametricFunction(torus);
    normals->SetInputConnection(source->GetOutputPort());
  }
  else
  {
    name == "molecule" ? AddMolecule(parts) : AddMachinePart(parts);
    normals->SetInputConnection(parts->GetOutputPort());
  }
  normals->Update();
  return normals->GetOutput();
}

//------------------------------------------------------------------------------
std::string GetStem(const std::string& path)
{
  const std::string name = std::filesystem::path(path).filename().string();
  return name.substr(0, name.find('.'));
}

/// A mesh, and points of it as cameras all around see them.
struct Case
{
  vtkNew<vtkTracedScene> Scene;
  vtkNew<vtkPolyData> Hits;
  vtkNew<vtkDoubleArray> Views;
};

// The last so many points.
void KeepLast(vtkPolyData* drawn, vtkDoubleArray* views, int count, Case& mesh)
{
  const vtkIdType all = drawn->GetNumberOfPoints();
  const vtkIdType first = std::max<vtkIdType>(all - count, 0);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  mesh.Views->SetNumberOfComponents(3);
  vtkPointData* from = drawn->GetPointData();
  vtkPointData* to = mesh.Hits->GetPointData();
  to->CopyAllOn();
  to->CopyAllocate(from);
  for (vtkIdType k = first; k < all; ++k)
  {
    points->InsertNextPoint(drawn->GetPoint(k));
    mesh.Views->InsertNextTuple(views->GetTuple(k));
    to->CopyData(from, k, k - first);
  }
  mesh.Hits->SetPoints(points);
}

double Measure(Case& mesh, vtkBRDF* brdf, vtkEnvironment* environment, int samples)
{
  vtkNew<vtkTracedRadianceIntegrator> integrator;
  integrator->SetScene(mesh.Scene);
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  integrator->SetNumberOfSamples(samples);
  integrator->UnoccludedReferenceOff();
  integrator->SetSeed(1);
  vtkNew<vtkDoubleArray> radiance;
  vtkNew<vtkDoubleArray> open;
  integrator->Integrate(mesh.Hits, mesh.Views, radiance, open);
  double difference = 0.0;
  double sum = 0.0;
  for (vtkIdType k = 0; k < radiance->GetNumberOfValues(); ++k)
  {
    difference += std::abs(open->GetValue(k) - radiance->GetValue(k));
    sum += radiance->GetValue(k);
  }
  return difference / std::max(sum, 1e-30);
}
}

int main(int argc, char** argv)
{
  std::vector<std::string> materials, environments;
  std::vector<std::string> shapes = { "torus", "isosurface", "molecule", "machine-part" };
  int points = 10000;
  int samples = 64;
  CLI::App app("Whether the error of leaving occlusion out is what a few points foretell.");
  app.add_option("--materials", materials, "Files or embedded names")->required();
  app.add_option("--environments", environments, "Files or embedded names")->required();
  app.add_option(
    "--shapes", shapes, "torus, isosurface, molecule, machine-part, or .vtp and .ply files");
  app.add_option("--points", points, "That errors are measured at");
  app.add_option("--samples", samples, "Directions a point");
  CLI11_PARSE(app, argc, argv);

  std::printf("mesh,triangles,material,environment,predicted,uncertainty,measured,cpu_seconds\n");
  int count = 0;
  int good = 0;
  int sure = 0;
  double worst = 1.0;
  for (const std::string& shape : shapes)
  {
    Case mesh;
    mesh.Scene->AddSurface(MakeMesh(shape));
    const double everywhere[3] = { 0.0, 0.0, 0.0 };
    vtkNew<vtkPolyData> drawn;
    vtkNew<vtkDoubleArray> views;
    // None of those that predictions see: these are the first.
    mesh.Scene->DrawVisiblePoints(points + MostPredicted, everywhere, drawn, views);
    KeepLast(drawn, views, points, mesh);
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
        brdf->Prepare();
        vtkNew<vtkOcclusionPredictor> predictor;
        predictor->SetScene(mesh.Scene);
        predictor->SetBRDF(brdf);
        predictor->SetEnvironment(environment);
        const std::clock_t begin = std::clock();
        if (!predictor->Update())
        {
          return 1;
        }
        const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        const double predicted = predictor->GetError();
        const double measured = Measure(mesh, brdf, environment, samples);
        std::printf("%s,%lld,%s,%s,%.5f,%.5f,%.5f,%.3f\n", GetStem(shape).c_str(),
          static_cast<long long>(mesh.Scene->GetNumberOfTriangles()), GetStem(material).c_str(),
          GetStem(light).c_str(), predicted, predictor->GetUncertainty(), measured, seconds);
        std::fflush(stdout);
        const double ratio = std::max(predicted, LeastError) / std::max(measured, LeastError);
        const double factor = std::max(ratio, 1.0 / ratio);
        ++count;
        good += factor <= Within ? 1 : 0;
        sure += std::abs(predicted - measured) <= predictor->GetUncertainty() ? 1 : 0;
        worst = std::max(worst, factor);
      }
    }
  }
  std::printf("# %d: within a factor of %.2g: %.1f %%; worst factor %.2f; within two standard "
              "errors: %.1f %%\n",
    count, Within, 100.0 * good / count, worst, 100.0 * sure / count);
  return 0;
}
