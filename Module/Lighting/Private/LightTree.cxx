// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightTree.h"

#include "ParallelFor.h"
#include "SRGB.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace measuredbrdf
{
namespace
{
double GetVariance(const glm::dvec4& m)
{
  const glm::dvec3 moment(m);
  return m.w > 0.0 ? std::max(m.w - glm::dot(moment, moment) / m.w, 0.0) : 0.0;
}

// Below these shares of the cell's and of the whole map's sum the variance is rounding.
constexpr double OwnRounding = 1e-12;
constexpr double MapRounding = 1e-14;

// Texels to sum until it is asked whether to go on: some milliseconds.
constexpr vtkIdType TexelsPerReport = 1 << 20;

// Large cells are summed in so many parts, side by side.
constexpr int Parts = 16;
constexpr vtkIdType LargeCell = 1 << 14;

vtkIdType CountTexels(const LightCell& cell)
{
  return static_cast<vtkIdType>(cell.GetWidth()) * cell.GetHeight();
}

// A cut of the last cell that was summed: its halves and their moments.
struct BestCut
{
  std::array<LightCell, 2> Halves;
  glm::dvec4 Moments[2];
  double Cost = std::numeric_limits<double>::infinity();
};

BestCut FindBestCut(CellSlices& slices, const LightCell& cell)
{
  slices.Sum(cell, cell.GetWidth() > 1, cell.GetHeight() > 1);
  BestCut best;
  for (const bool columns : { true, false })
  {
    const std::vector<glm::dvec4>& all = columns ? slices.Columns : slices.Rows;
    const glm::dvec4 sum = std::accumulate(all.begin(), all.end(), glm::dvec4(0.0));
    glm::dvec4 part(0.0);
    for (std::size_t k = 1; k < all.size(); ++k)
    {
      part += all[k - 1];
      const double cost = GetVariance(part) + GetVariance(sum - part);
      if (cost < best.Cost)
      {
        best = { cell.Cut(columns, static_cast<int>(k)), { part, sum - part }, cost };
      }
    }
  }
  return best;
}
} // namespace

//------------------------------------------------------------------------------
void CellSlices::Sum(const LightCell& cell, bool columns, bool rows)
{
  const int width = columns ? cell.GetWidth() : 0;
  const int height = cell.GetHeight();
  const int parts = CountTexels(cell) >= LargeCell ? std::min(Parts, height) : 1;
  this->Rows.assign(rows ? height : 0, glm::dvec4(0.0));
  this->Columns.assign(width, glm::dvec4(0.0));
  const glm::dvec2* azimuths = this->Directions.Columns.data() + cell.X0;
  // Of each column, by part: luminance times cosine, sine of the latitude and 1.
  std::vector<glm::dvec3> partSums(static_cast<std::size_t>(parts) * width, glm::dvec3(0.0));
  const auto sumPart = [&](int part)
  {
    std::vector<float> room;
    glm::dvec3* sums = partSums.data() + static_cast<std::size_t>(part) * width;
    for (int row = height * part / parts; row < height * (part + 1) / parts; ++row)
    {
      const int y = cell.Y0 + row;
      const float* rgb = this->Changes.GetRow(this->Environment, y, cell.X0, cell.X1, room);
      const glm::dvec2 latitude = this->Directions.Rows[y];
      const double solidAngle = this->Environment->GetTexelSolidAngle(y);
      const glm::dvec3 weight = solidAngle * glm::dvec3(latitude, 1.0);
      double total = 0.0;
      glm::dvec2 moment(0.0);
      for (int x = 0; x < cell.GetWidth(); ++x)
      {
        const double luminance = GetLuminance(rgb + 3 * x);
        total += luminance;
        moment += luminance * azimuths[x];
        if (columns)
        {
          sums[x] += luminance * weight;
        }
      }
      if (rows)
      {
        this->Rows[row] = solidAngle * glm::dvec4(latitude.x * moment.x, latitude.y * total,
                                         latitude.x * moment.y, total);
      }
    }
  };
  ParallelForEach(parts, sumPart);
  for (int x = 0; x < width; ++x)
  {
    glm::dvec3 sum(0.0);
    for (int part = 0; part < parts; ++part)
    {
      sum += partSums[static_cast<std::size_t>(part) * width + x];
    }
    this->Columns[x] = glm::dvec4(sum.x * azimuths[x].x, sum.y, sum.x * azimuths[x].y, sum.z);
  }
}

//------------------------------------------------------------------------------
LightTree::LightTree(vtkEnvironment* environment, const TexelChanges& changes, int cells,
  const std::function<bool()>& goOn)
  : Width(environment->GetWidth())
  , Height(environment->GetHeight())
  , Stopped(!goOn())
{
  CellSlices slices(environment, changes);
  // The largest variance first; of several, the node that was made first.
  std::priority_queue<std::pair<double, vtkIdType>> queue;
  double total = 0.0;
  const auto push = [&](const LightCell& cell, const glm::dvec4& moment)
  {
    const double variance = GetVariance(moment);
    if (!cell.IsTexel() && variance > std::max(OwnRounding * moment.w, MapRounding * total))
    {
      queue.push({ variance, -static_cast<vtkIdType>(this->Nodes.size()) });
    }
    this->Nodes.push_back({ cell });
  };
  const LightCell whole{ 0, 0, this->Width, this->Height };
  slices.Sum(whole, false, true);
  const auto sum = std::accumulate(slices.Rows.begin(), slices.Rows.end(), glm::dvec4(0.0));
  total = sum.w;
  push(whole, sum);
  vtkIdType visited = 0;
  for (int count = 1; count < cells && !queue.empty() && !this->Stopped; ++count)
  {
    const vtkIdType next = -queue.top().second;
    queue.pop();
    visited += CountTexels(this->Nodes[next]);
    const BestCut cut = FindBestCut(slices, this->Nodes[next]);
    push(cut.Halves[0], cut.Moments[0]);
    push(cut.Halves[1], cut.Moments[1]);
    this->Nodes[next].Split = count + 1;
    if (visited >= TexelsPerReport)
    {
      visited = 0;
      this->Stopped = !goOn();
    }
  }
  if (this->Stopped)
  {
    return;
  }
  // Exact sums of the leaves, not by differences; then of all above. Children come after their
  // parents.
  ParallelForEach(
    this->Nodes.size(),
    [&](std::size_t k)
    {
      if (this->Nodes[k].Split == INT_MAX)
      {
        this->Nodes[k].Gather(environment, changes, slices.Directions);
      }
    },
    nullptr, 0);
  for (auto node = this->Nodes.rbegin(); node != this->Nodes.rend(); ++node)
  {
    for (int child = node->Split == INT_MAX ? 2 : 0; child < 2; ++child)
    {
      const Node& half = this->Nodes[2 * static_cast<std::size_t>(node->Split) - 3 + child];
      node->Moment += half.Moment;
      node->Irradiance += half.Irradiance;
      node->SolidAngle += half.SolidAngle;
    }
  }
}

//------------------------------------------------------------------------------
void LightTree::FillLightSet(int count, vtkLightSet* output) const
{
  const int cells = std::min(count, static_cast<int>(this->Nodes.size() / 2) + 1);
  output->RemoveAllLights();
  // Nodes come by twos after the first; only the first cells - 1 splits' can be in the set.
  for (int k = 0; k < 2 * cells - 1; ++k)
  {
    if (cells < this->Nodes[k].Split)
    {
      this->Nodes[k].AddLight(this->Width, this->Height, output);
    }
  }
}

//------------------------------------------------------------------------------
std::array<LightCell, 2> LightCell::Cut(bool columns, int at) const
{
  const int x = columns ? this->X0 + at : this->X1;
  const int y = columns ? this->Y1 : this->Y0 + at;
  return { LightCell{ this->X0, this->Y0, x, y },
    LightCell{ columns ? x : this->X0, columns ? this->Y0 : y, this->X1, this->Y1 } };
}

//------------------------------------------------------------------------------
void LightCell::Gather(
  vtkEnvironment* environment, const TexelChanges& changes, const TexelDirections& directions)
{
  std::vector<float> room;
  for (int y = this->Y0; y < this->Y1; ++y)
  {
    const float* texels = changes.GetRow(environment, y, this->X0, this->X1, room);
    glm::dvec3 rgb(0.0);
    glm::dvec2 moment(0.0);
    for (int x = this->X0; x < this->X1; ++x, texels += 3)
    {
      const glm::dvec3 radiance = glm::make_vec3(texels);
      rgb += radiance;
      moment += GetLuminance(radiance) * directions.Columns[x];
    }
    const double solidAngle = environment->GetTexelSolidAngle(y);
    const double luminance = GetLuminance(rgb);
    const glm::dvec2 latitude = directions.Rows[y];
    this->Irradiance += solidAngle * rgb;
    this->Moment += solidAngle * glm::dvec4(latitude.x * moment.x, latitude.y * luminance,
                                   latitude.x * moment.y, luminance);
    this->SolidAngle += solidAngle * this->GetWidth();
  }
}

//------------------------------------------------------------------------------
void LightCell::AddLight(int width, int height, vtkLightSet* output) const
{
  const double luminance = this->Moment.w;
  if (!(luminance > 0.0))
  {
    return;
  }
  // Directions that cancel (a cell all around the sphere) leave only its middle to point at.
  glm::dvec3 direction(this->Moment);
  if (!(glm::length(direction) > 1e-9 * luminance))
  {
    vtkEnvironment::GetDirection(
      0.5 * (this->X0 + this->X1) / width, 0.5 * (this->Y0 + this->Y1) / height, &direction.x);
  }
  const double variance = this->IsTexel() ? 0.0 : GetVariance(this->Moment) / luminance;
  if (output->AddLight(&direction.x, &this->Irradiance.x, this->SolidAngle,
        vtkLightSet::GetConcentrationOfVariance(variance)))
  {
    output->SetLastRegion(this->X0, this->Y0, this->X1, this->Y1);
  }
}
} // namespace measuredbrdf
