// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// How well a point's code tells which lamps and panels it hides, whatever the map and the material:
// for points of meshes and directions over the sphere, the visible share against traced rays.
// Errors are means of |difference| times the cosine over all points and directions, of lamps those
// above the horizon, as shares of the light of lamps (panels) that nothing hides. A line of CSV for
// each mesh.
#include "HiddenSky.h"
#include "LocalFrame.h"
#include "OcclusionMeshes.h"
#include "SurfacePoints.h"
#include "SurfaceTracer.h"
#include "VisibilityTask.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace measuredbrdf;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr std::array<double, 3> Concentrations = { 40.0, 150.0, 600.0 };
constexpr int PanelRays = 48;

struct Errors
{
  double Lamps = 0.0, LampLight = 0.0;
  std::array<double, Concentrations.size()> Panels{}, PanelLight{};
};

// Golden-ratio lattice on the sphere.
glm::dvec3 GetPoint(int k, int count)
{
  const double z = 1.0 - 2.0 * (k + 0.5) / count;
  const double turn = 2.0 * Pi * k * 0.61803398874989485;
  const double s = std::sqrt(1.0 - z * z);
  return { s * std::cos(turn), s * std::sin(turn), z };
}

// Of a von Mises-Fisher lobe about z (Jakob 2012).
glm::dvec3 GetLobePoint(int k, double concentration)
{
  const double u = (k + 0.5) / PanelRays;
  const double z = 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * concentration)) / concentration;
  const double turn = 2.0 * Pi * k * 0.61803398874989485;
  const double s = std::sqrt(std::max(1.0 - z * z, 0.0));
  return { s * std::cos(turn), s * std::sin(turn), z };
}

struct Point
{
  HiddenSky Sky;
  glm::dvec3 Origin;
};

bool IsVisible(const SurfaceTracer& tracer, const Point& point, const glm::dvec3& d)
{
  return !tracer.IsOccluded(&point.Origin.x, &d.x, 0.0, std::numeric_limits<double>::infinity());
}

bool IsBuried(const SurfaceTracer& tracer, const Point& point)
{
  for (int k = 0; k < 200; ++k)
  {
    const glm::dvec3 d = GetPoint(k, 200);
    if (glm::dot(d, point.Sky.GetNormal()) > 0.1 && IsVisible(tracer, point, d))
    {
      return false;
    }
  }
  return true;
}

void AddErrors(const SurfaceTracer& tracer, const Point& point, const glm::dvec3& d, Errors& errors)
{
  const glm::dvec3& n = point.Sky.GetNormal();
  const double z = glm::dot(n, d);
  if (z > 0.0)
  {
    const double truth = IsVisible(tracer, point, d) ? 1.0 : 0.0;
    errors.Lamps += z * std::abs(point.Sky.GetVisibleLamp(d) - truth);
    errors.LampLight += z;
  }
  const glm::dmat3 frame = FrameAbout(d);
  for (std::size_t c = 0; c < Concentrations.size(); ++c)
  {
    double all = 0.0;
    double hidden = 0.0;
    for (int k = 0; k < PanelRays; ++k)
    {
      const glm::dvec3 ray = frame * GetLobePoint(k, Concentrations[c]);
      const double cosine = std::max(glm::dot(ray, n), 0.0);
      all += cosine;
      hidden += cosine > 0.0 && !IsVisible(tracer, point, ray) ? cosine : 0.0;
    }
    const double radius = std::sqrt(3.0 / Concentrations[c]);
    errors.Panels[c] += std::abs(all * point.Sky.GetHiddenPanel(d, radius) - hidden) / PanelRays;
    errors.PanelLight[c] += all / PanelRays;
  }
}
}

int main(int argc, char** argv)
{
  std::vector<std::string> meshes = { "bumps", "gear", "isosurface", "knob", "molecule", "torus" };
  int count = 500;
  int directions = 60;
  CLI::App app("Lamps and panels that points hide: their codes against traced rays.");
  app.add_option(
    "--meshes", meshes, "Those of the default, inside-bowl, or .vtp files with point normals");
  app.add_option("--points", count, "Of each mesh");
  app.add_option("--directions", directions, "Of sources over the sphere");
  CLI11_PARSE(app, argc, argv);
  std::printf("mesh,lamps %%");
  for (const double concentration : Concentrations)
  {
    std::printf(",panels of %g %%", concentration);
  }
  std::printf("\n");
  for (const std::string& name : meshes)
  {
    const auto surface = MakeOcclusionMesh(name);
    vtkNew<vtkSurfaceVisibilityFilter> filter;
    filter->SetInputData(surface);
    filter->Update();
    SideArrays side;
    vtkPointData* data = vtkPolyData::SafeDownCast(filter->GetOutput())->GetPointData();
    side.Sky = vtkUnsignedCharArray::SafeDownCast(
      data->GetArray(vtkSurfaceVisibilityFilter::GetHiddenSkyArrayName()));
    side.Light = vtkUnsignedCharArray::SafeDownCast(
      data->GetArray(vtkSurfaceVisibilityFilter::GetHiddenLightArrayName()));
    SurfaceTracer tracer;
    tracer.AddSurface(surface);
    tracer.Build();
    const std::vector<SurfaceVertex> vertices = FindSurfacePoints(surface);
    std::mt19937 generator(5);
    std::uniform_int_distribution<vtkIdType> pick(0, surface->GetNumberOfPoints() - 1);
    Errors errors;
    for (int k = 0; k < count; ++k)
    {
      const vtkIdType id = pick(generator);
      const SurfaceVertex& vertex = vertices[static_cast<std::size_t>(id)];
      Point point = { HiddenSky(side.Get(id)), glm::dvec3(0.0) };
      tracer.OffsetOrigin(
        &vertex.Origin.x, &vertex.FaceNormal.x, &vertex.FaceNormal.x, &point.Origin.x);
      if (IsBuried(tracer, point))
      {
        continue; // has the code of another point
      }
      for (int s = 0; s < directions; ++s)
      {
        AddErrors(tracer, point, GetPoint(s, directions), errors);
      }
    }
    std::printf("%s,%.2f", name.c_str(), 100.0 * errors.Lamps / errors.LampLight);
    for (std::size_t c = 0; c < Concentrations.size(); ++c)
    {
      std::printf(",%.2f", 100.0 * errors.Panels[c] / errors.PanelLight[c]);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  return 0;
}
