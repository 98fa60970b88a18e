// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMedianCutLightSetGenerator.h"

#include "HalfVector.h" // for Pi
#include "ParallelFor.h"
#include "TexelDirections.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>

#include <cmath>
#include <vector>

using measuredbrdf::Pi;

namespace
{
// Texels [x0,x1) x [y0,y1).
struct Region
{
  int X0, Y0, X1, Y1;
};

// The luminance times solid angle of any rectangle of texels from four look-ups (Crow 1984).
class SummedAreaTable
{
public:
  explicit SummedAreaTable(vtkEnvironment* environment)
    : Stride(static_cast<std::size_t>(environment->GetWidth()) + 1)
    , Sums(Stride * (static_cast<std::size_t>(environment->GetHeight()) + 1), 0.0)
  {
    const float* pixel = environment->GetPixels().data();
    for (int y = 0; y < environment->GetHeight(); ++y)
    {
      const double solidAngle = environment->GetTexelSolidAngle(y);
      double row = 0.0;
      for (int x = 0; x < environment->GetWidth(); ++x, pixel += 3)
      {
        const double rgb[3] = { pixel[0], pixel[1], pixel[2] };
        row += solidAngle * vtkEnvironment::GetLuminance(rgb);
        this->At(x + 1, y + 1) = this->At(x + 1, y) + row;
      }
    }
  }

  double GetSum(const Region& r)
  {
    return (this->At(r.X1, r.Y1) - this->At(r.X0, r.Y1)) -
           (this->At(r.X1, r.Y0) - this->At(r.X0, r.Y0));
  }

private:
  double& At(int x, int y)
  {
    return this->Sums[this->Stride * static_cast<std::size_t>(y) + static_cast<std::size_t>(x)];
  }

  std::size_t Stride;
  std::vector<double> Sums;
};

// What a region's light is made of.
struct Energy
{
  glm::dvec3 Irradiance = glm::dvec3(0.0);
  glm::dvec3 Moment = glm::dvec3(0.0); // luminance-weighted sum of directions
  double Luminance = 0.0;
  double SolidAngle = 0.0;
};

// The cut in [first, last] whose lower part, lower(cut), is nearest to half of total. lower grows.
template <typename Lower>
int FindCut(int first, int last, double total, Lower&& lower)
{
  int begin = first;
  int end = last;
  while (begin < end) // the first cut that holds half or more
  {
    const int middle = begin + (end - begin) / 2;
    if (2.0 * lower(middle) >= total)
    {
      end = middle;
    }
    else
    {
      begin = middle + 1;
    }
  }
  const bool before = begin > first && std::abs(2.0 * lower(begin - 1) - total) <
                                         std::abs(2.0 * lower(begin) - total);
  return before ? begin - 1 : begin;
}

// Both halves of a region, across its longer side (Debevec 2005: the width shrinks with the cosine
// of the middle row's latitude).
void Split(
  const Region& r, SummedAreaTable& table, int width, int height, std::vector<Region>& halves)
{
  const double latitude = Pi * (0.5 * (r.Y0 + r.Y1) / height - 0.5);
  const double extentX = 2.0 * Pi * (r.X1 - r.X0) / width * std::cos(latitude);
  const double extentY = Pi * (r.Y1 - r.Y0) / height;
  const bool canX = r.X1 - r.X0 > 1;
  const bool canY = r.Y1 - r.Y0 > 1;
  const double total = table.GetSum(r);
  if (canX && (extentX >= extentY || !canY))
  {
    const int cut = FindCut(r.X0 + 1, r.X1 - 1, total,
      [&](int x) {
        return table.GetSum({ r.X0, r.Y0, x, r.Y1 });
      });
    halves.push_back({ r.X0, r.Y0, cut, r.Y1 });
    halves.push_back({ cut, r.Y0, r.X1, r.Y1 });
  }
  else if (canY)
  {
    const int cut = FindCut(r.Y0 + 1, r.Y1 - 1, total,
      [&](int y) {
        return table.GetSum({ r.X0, r.Y0, r.X1, y });
      });
    halves.push_back({ r.X0, r.Y0, r.X1, cut });
    halves.push_back({ r.X0, cut, r.X1, r.Y1 });
  }
  else
  {
    halves.push_back(r);
  }
}

Energy Gather(
  const Region& r, vtkEnvironment* environment, const measuredbrdf::TexelDirections& directions)
{
  Energy energy;
  for (int y = r.Y0; y < r.Y1; ++y)
  {
    const float* pixel =
      &environment->GetPixels()[3 * (static_cast<std::size_t>(y) * environment->GetWidth() +
                                      static_cast<std::size_t>(r.X0))];
    glm::dvec3 rgb(0.0);
    glm::dvec2 moment(0.0);
    for (int x = r.X0; x < r.X1; ++x, pixel += 3)
    {
      const glm::dvec3 radiance(pixel[0], pixel[1], pixel[2]);
      rgb += radiance;
      moment += vtkEnvironment::GetLuminance(&radiance.x) * directions.Columns[std::size_t(x)];
    }
    const double solidAngle = environment->GetTexelSolidAngle(y);
    const double luminance = vtkEnvironment::GetLuminance(&rgb.x);
    const glm::dvec2 row = directions.Rows[std::size_t(y)];
    energy.Irradiance += solidAngle * rgb;
    energy.Luminance += solidAngle * luminance;
    energy.Moment += solidAngle * glm::dvec3(row.x * moment.x, row.y * luminance, row.x * moment.y);
    energy.SolidAngle += solidAngle * (r.X1 - r.X0);
  }
  return energy;
}

void AddLight(const Region& r, const Energy& energy, int width, int height, vtkLightSet* output)
{
  if (!(energy.Luminance > 0.0))
  {
    return;
  }
  // Directions that cancel (a region all around the sphere) leave only its middle to point at.
  glm::dvec3 direction = energy.Moment;
  if (!(glm::length(direction) > 1e-9 * energy.Luminance))
  {
    vtkEnvironment::GetDirection(
      0.5 * (r.X0 + r.X1) / width, 0.5 * (r.Y0 + r.Y1) / height, &direction.x);
  }
  const double mean = glm::length(energy.Moment) / energy.Luminance;
  const bool texel = r.X1 - r.X0 == 1 && r.Y1 - r.Y0 == 1;
  const double concentration =
    vtkLightSet::GetConcentrationOfVariance(texel ? 0.0 : 1.0 - mean * mean);
  if (output->AddLight(&direction.x, &energy.Irradiance.x, energy.SolidAngle, concentration))
  {
    output->SetLastRegion(r.X0, r.Y0, r.X1, r.Y1);
  }
}
} // namespace

vtkStandardNewMacro(vtkMedianCutLightSetGenerator);

//------------------------------------------------------------------------------
bool vtkMedianCutLightSetGenerator::Generate(
  vtkEnvironment* environment, int count, vtkLightSet* output)
{
  if (!this->CheckArguments(environment, count, output))
  {
    return false;
  }
  if ((count & (count - 1)) != 0)
  {
    vtkErrorMacro(
      "Generate: median cut makes a power of two of lights (64, 128, ...), not " << count << ".");
    return false;
  }

  environment = environment->GetSubdivided();
  const int width = environment->GetWidth();
  const int height = environment->GetHeight();
  SummedAreaTable table(environment);
  std::vector<Region> regions(1, Region{ 0, 0, width, height });
  for (int made = 1; made < count; made *= 2)
  {
    std::vector<Region> halves;
    halves.reserve(2 * regions.size());
    for (const Region& region : regions)
    {
      Split(region, table, width, height, halves);
    }
    if (halves.size() == regions.size()) // only single texels are left
    {
      break;
    }
    regions.swap(halves);
  }

  const measuredbrdf::TexelDirections directions(width, height);
  std::vector<Energy> energies(regions.size());
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(regions.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        energies[std::size_t(k)] = Gather(regions[std::size_t(k)], environment, directions);
      }
    });

  output->RemoveAllLights();
  for (std::size_t k = 0; k < regions.size(); ++k)
  {
    AddLight(regions[k], energies[k], width, height, output);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkMedianCutLightSetGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
