// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays of a scene: processor time to build, bytes a triangle, and occlusion rays a second of one
// core. Heights over a plane; rays leave from places on it in all upward directions.
#include "SurfaceTracer.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <random>
#include <vector>

using measuredbrdf::SurfaceTracer;

namespace
{
double GetSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double GetHeight(double x, double y)
{
  return 0.1 * std::sin(9.0 * x) * std::cos(7.0 * y) + 0.02 * std::sin(61.0 * x + 47.0 * y);
}

vtkSmartPointer<vtkPolyData> MakeHeights(int steps)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  for (int b = 0; b <= steps; ++b)
  {
    for (int a = 0; a <= steps; ++a)
    {
      const double x = static_cast<double>(a) / steps;
      const double y = static_cast<double>(b) / steps;
      points->InsertNextPoint(x, y, GetHeight(x, y));
      if (a < steps && b < steps)
      {
        const vtkIdType k = static_cast<vtkIdType>(b) * (steps + 1) + a;
        const vtkIdType lower[3] = { k, k + 1, k + steps + 2 };
        const vtkIdType upper[3] = { k, k + steps + 2, k + steps + 1 };
        triangles->InsertNextCell(3, lower);
        triangles->InsertNextCell(3, upper);
      }
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

void Measure(vtkPolyData* surface)
{
  const double start = GetSeconds();
  SurfaceTracer tracer;
  tracer.AddSurface(surface);
  tracer.Build();
  const double built = GetSeconds();
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  constexpr int rays = 500000;
  int hidden = 0;
  for (int k = 0; k < rays; ++k)
  {
    const double x = uniform(generator);
    const double y = uniform(generator);
    const double z = uniform(generator);
    const double turn = 2.0 * 3.14159265358979 * uniform(generator);
    const double origin[3] = { x, y, GetHeight(x, y) + 1e-3 };
    const double s = std::sqrt(1.0 - z * z);
    const double direction[3] = { s * std::cos(turn), s * std::sin(turn), z };
    hidden +=
      tracer.IsOccluded(origin, direction, 0.0, std::numeric_limits<double>::infinity()) ? 1 : 0;
  }
  const double traced = GetSeconds() - built;
  std::printf("%lld,%.2f,%.1f,%.2f,%.3f\n", static_cast<long long>(tracer.GetNumberOfTriangles()),
    built - start,
    static_cast<double>(tracer.GetBytes()) / static_cast<double>(tracer.GetNumberOfTriangles()),
    1e-6 * rays / traced, static_cast<double>(hidden) / rays);
  std::fflush(stdout);
}
}

/// usage: BenchmarkTracing [STEPS...]: 2 STEPS^2 triangles each
int main(int argc, char** argv)
{
  std::vector<int> all = { 500, 2236 };
  if (argc > 1)
  {
    all.clear();
    for (int k = 1; k < argc; ++k)
    {
      all.push_back(std::atoi(argv[k]));
    }
  }
  std::printf("triangles,build CPU s,bytes a triangle,million rays a CPU s,hidden\n");
  for (const int steps : all)
  {
    Measure(MakeHeights(steps));
  }
  return 0;
}
