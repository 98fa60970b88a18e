// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What surfaces hide from themselves, traced for pixels of a picture: the truth of benchmarks of
 * occlusion. Each pixel's truth is what a mapper draws without occlusion, times the share of its
 * light that 9,000 traced directions find visible; so errors are those of occlusion alone.
 */

#ifndef OcclusionTruth_h
#define OcclusionTruth_h

#include "BenchmarkCase.h"
#include "FloatWindow.h"
#include "HalfVector.h" // for Pi
#include "SurfaceTracer.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace occlusiontruth
{
using measuredbrdf::SurfaceTracer;

using measuredbrdf::Pi;
constexpr int Rows = 96; // of the grid of directions: equal areas
constexpr int Columns = 2 * Rows;
constexpr double LampDegrees = 1.2; // as planners have it
inline const double Far = std::numeric_limits<double>::infinity();

// Cell of equal area about y.
inline glm::dvec3 GetDirection(int cell)
{
  const double y = 1.0 - 2.0 * (cell / Columns + 0.5) / Rows;
  const double azimuth = 2.0 * Pi * (cell % Columns + 0.5) / Columns;
  const double s = std::sqrt(1.0 - y * y);
  return { s * std::cos(azimuth), y, s * std::sin(azimuth) };
}

inline int FindCell(const glm::dvec3& d)
{
  const int row = std::min(static_cast<int>((1.0 - d.y) * 0.5 * Rows), Rows - 1);
  const double turn = std::atan2(d.z, d.x) / (2.0 * Pi);
  return row * Columns +
         std::min(static_cast<int>((turn < 0.0 ? turn + 1.0 : turn) * Columns), Columns - 1);
}

struct Pixel
{
  int X, Y;
  glm::dvec3 Point, Origin, Normal, View;
  std::vector<char> Visible; // of cells above the horizon
};

// A map as cells' means and lamps.
struct Map
{
  std::string Name;
  vtkSmartPointer<vtkEnvironment> Environment;
  std::vector<glm::dvec3> Cells;
};

// Means of the texels in each cell. Lamps stay in their cells: all directions of such a cell are
// taken as its middle, but what is hidden of it is found by several rays.
inline Map MakeMap(const std::string& name, vtkEnvironment* environment)
{
  Map map = { name, environment, std::vector<glm::dvec3>(Rows * Columns, glm::dvec3(0.0)) };
  std::vector<double> areas(map.Cells.size(), 0.0);
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 d, radiance;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, &d.x);
      environment->GetRadiance(&d.x, &radiance.x);
      const double area = std::sqrt(std::max(1.0 - d.y * d.y, 0.0));
      const auto cell = static_cast<std::size_t>(FindCell(d));
      map.Cells[cell] += area * glm::max(radiance, glm::dvec3(0.0));
      areas[cell] += area;
    }
  }
  for (std::size_t k = 0; k < areas.size(); ++k)
  {
    map.Cells[k] /= std::max(areas[k], 1e-12);
  }
  return map;
}

inline double Sum(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

inline std::vector<Pixel> FindPixels(
  vtkPolyData* surface, const SurfaceTracer& tracer, FloatWindow& window, int count)
{
  std::vector<Pixel> pixels;
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> place(0, window.GetSize() - 1);
  for (int tries = 0; tries < 100 * count && static_cast<int>(pixels.size()) < count; ++tries)
  {
    Pixel pixel;
    pixel.X = place(generator);
    pixel.Y = place(generator);
    glm::dvec3 eye, direction;
    window.GetRay(pixel.X, pixel.Y, &eye.x, &direction.x);
    SurfaceTracer::Hit hit;
    if (!tracer.Intersect(&eye.x, &direction.x, 0.0, Far, hit))
    {
      continue;
    }
    pixel.Point = eye + hit.T * direction;
    pixel.View = -glm::normalize(direction);
    pixel.Normal = glm::dvec3(0.0);
    for (int k = 0; k < 3; ++k)
    {
      glm::dvec3 normal;
      surface->GetPointData()->GetNormals()->GetTuple(hit.Points[k], &normal.x);
      pixel.Normal += hit.Barycentrics[k] * normal;
    }
    pixel.Normal = glm::normalize(pixel.Normal);
    glm::dvec3 face = glm::make_vec3(hit.Normal);
    face *= glm::dot(face, pixel.View) < 0.0 ? -1.0 : 1.0;
    if (glm::dot(pixel.Normal, pixel.View) > 0.05) // false for NaN, of triangles without area
    {
      tracer.OffsetOrigin(&pixel.Point.x, &face.x, &face.x, &pixel.Origin.x);
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

inline void TracePixels(const SurfaceTracer& tracer, std::vector<Pixel>& pixels)
{
  for (Pixel& pixel : pixels)
  {
    pixel.Visible.assign(Rows * Columns, 0);
    for (int cell = 0; cell < Rows * Columns; ++cell)
    {
      const glm::dvec3 d = GetDirection(cell);
      pixel.Visible[static_cast<std::size_t>(cell)] =
        glm::dot(d, pixel.Normal) > 0.0 && !tracer.IsOccluded(&pixel.Origin.x, &d.x, 0.0, Far);
    }
  }
}

struct Material
{
  std::string Name;
  vtkSmartPointer<vtkBRDF> BRDF;
};

inline std::vector<Material> MakeMaterials()
{
  std::vector<Material> materials;
  const std::pair<const char*, glm::dvec3> mattes[] = { { "lambert", glm::dvec3(1.0) },
    { "grey", glm::dvec3(0.5) }, { "orange", glm::dvec3(0.7, 0.3, 0.1) } };
  for (const auto& [name, albedo] : mattes)
  {
    vtkNew<vtkLambertBRDF> matte;
    matte->SetAlbedo(albedo.x, albedo.y, albedo.z);
    materials.push_back({ name, matte });
  }
  for (const double exponent : { 50.0, 400.0 })
  {
    vtkNew<vtkBlinnPhongBRDF> gloss;
    gloss->SetSpecular(0.5, 0.5, 0.5);
    gloss->SetExponent(exponent);
    materials.push_back({ "blinn" + std::to_string(static_cast<int>(exponent)), gloss });
  }
  for (const char* name : { "cardboard", "satin_purple", "vch_ultra_pink" })
  {
    if (auto brdf = BenchmarkCase::FindBRDF(std::string("rgl/") + name + "_rgb.bsdf"))
    {
      materials.push_back({ name, brdf });
    }
  }
  return materials;
}

// Kernels f cos over the grid, of each pixel.
inline std::vector<std::vector<glm::vec3>> MakeKernels(
  vtkBRDF* brdf, const std::vector<Pixel>& pixels)
{
  brdf->Prepare();
  std::vector<std::vector<glm::vec3>> kernels;
  for (const Pixel& pixel : pixels)
  {
    const double s = std::copysign(1.0, pixel.Normal.z);
    const double a = -1.0 / (s + pixel.Normal.z);
    const double b = pixel.Normal.x * pixel.Normal.y * a;
    const glm::dmat3 frame(
      { 1.0 + s * pixel.Normal.x * pixel.Normal.x * a, s * b, -s * pixel.Normal.x },
      { b, s + pixel.Normal.y * pixel.Normal.y * a, -pixel.Normal.y }, pixel.Normal);
    const glm::dvec3 o = glm::transpose(frame) * pixel.View;
    std::vector<glm::vec3> kernel(Rows * Columns, glm::vec3(0.0f));
    for (int cell = 0; cell < Rows * Columns; ++cell)
    {
      const glm::dvec3 i = glm::transpose(frame) * GetDirection(cell);
      if (i.z > 0.0)
      {
        double f[3];
        brdf->Evaluate(&i.x, &o.x, f);
        kernel[static_cast<std::size_t>(cell)] = glm::vec3(glm::make_vec3(f) * i.z);
      }
    }
    kernels.push_back(std::move(kernel));
  }
  return kernels;
}

/// Of a pixel's light without occlusion.
struct Shares
{
  glm::dvec3 Visible; // of the light, of each channel
  double Open;        // of the hemisphere, by the cosine
};

inline Shares GetShares(const Pixel& pixel, const std::vector<glm::vec3>& kernel, const Map& map)
{
  glm::dvec3 all(0.0);
  glm::dvec3 seen(0.0);
  double cosine = 0.0;
  double open = 0.0;
  for (std::size_t cell = 0; cell < map.Cells.size(); ++cell)
  {
    const glm::dvec3 light = glm::dvec3(kernel[cell]) * map.Cells[cell];
    const double z = glm::dot(GetDirection(static_cast<int>(cell)), pixel.Normal);
    all += light;
    cosine += std::max(z, 0.0);
    if (pixel.Visible[cell])
    {
      seen += light;
      open += std::max(z, 0.0);
    }
  }
  return { seen / glm::max(all, glm::dvec3(1e-12)), open / cosine };
}

/// Processor time of this program, of all its threads.
inline double GetSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
}

#endif
