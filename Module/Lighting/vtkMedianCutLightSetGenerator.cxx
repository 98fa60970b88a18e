// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMedianCutLightSetGenerator.h"

#include "HalfVector.h" // for Pi
#include "LightTree.h"
#include "ParallelFor.h"
#include "TexelTree.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>

#include <cmath>
#include <vector>

using measuredbrdf::Pi;

namespace
{
using measuredbrdf::LightCell;

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

  double GetSum(const LightCell& r)
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
  const LightCell& r, SummedAreaTable& table, int width, int height, std::vector<LightCell>& halves)
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
  std::vector<LightCell> regions(1, LightCell{ 0, 0, width, height });
  for (int made = 1; made < count; made *= 2)
  {
    std::vector<LightCell> halves;
    halves.reserve(2 * regions.size());
    for (const LightCell& region : regions)
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
  const measuredbrdf::TexelChanges none;
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(regions.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        regions[std::size_t(k)].Gather(environment, none, directions);
      }
    });

  output->RemoveAllLights();
  for (const LightCell& region : regions)
  {
    region.AddLight(width, height, output);
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkMedianCutLightSetGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
