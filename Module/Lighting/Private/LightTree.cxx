// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightTree.h"

#include "HalfVector.h" // for Pi
#include "ParallelFor.h"
#include "SRGB.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Of a moment and a luminance side by side.
double GetVariance(const glm::dvec4& m)
{
  const glm::dvec3 moment(m);
  return m.w > 0.0 ? std::max(m.w - glm::dot(moment, moment) / m.w, 0.0) : 0.0;
}

// Below these shares of the cell's and of the whole map's sum the variance is rounding.
constexpr double OwnRounding = 1e-12;
constexpr double MapRounding = 1e-14;

// Texels to sum until it is asked whether to go on: some milliseconds.
constexpr std::int64_t TexelsPerReport = 1 << 20;

// Large cells are summed in so many parts, side by side.
constexpr int Parts = 16;
constexpr std::int64_t LargeCell = 1 << 14;

std::int64_t CountTexels(const LightCell& cell)
{
  return static_cast<std::int64_t>(cell.X1 - cell.X0) * (cell.Y1 - cell.Y0);
}

// A cut of the last cell that was summed: its halves and their sums.
struct Cut
{
  LightCell Halves[2];
  glm::dvec4 Sums[2];
  double Cost = std::numeric_limits<double>::infinity();
};

Cut FindBestCut(CellSlices& slices, const LightCell& n)
{
  slices.Sum(n, n.X1 - n.X0 > 1, n.Y1 - n.Y0 > 1);
  Cut best;
  for (const bool across : { true, false })
  {
    const std::vector<glm::dvec4>& all = across ? slices.Columns : slices.Rows;
    const glm::dvec4 sum = std::accumulate(all.begin(), all.end(), glm::dvec4(0.0));
    glm::dvec4 part(0.0);
    for (std::size_t k = 1; k < all.size(); ++k)
    {
      part += all[k - 1];
      const double cost = GetVariance(part) + GetVariance(sum - part);
      const int at = static_cast<int>(k);
      if (cost < best.Cost && across)
      {
        best = { { { n.X0, n.Y0, n.X0 + at, n.Y1 }, { n.X0 + at, n.Y0, n.X1, n.Y1 } },
          { part, sum - part }, cost };
      }
      else if (cost < best.Cost)
      {
        best = { { { n.X0, n.Y0, n.X1, n.Y0 + at }, { n.X0, n.Y0 + at, n.X1, n.Y1 } },
          { part, sum - part }, cost };
      }
    }
  }
  return best;
}
} // namespace

//------------------------------------------------------------------------------
void CellSlices::Sum(const LightCell& n, bool columns, bool rows)
{
  const std::size_t width = columns ? static_cast<std::size_t>(n.X1 - n.X0) : 0;
  const int height = n.Y1 - n.Y0;
  const int parts = CountTexels(n) >= LargeCell ? std::min(Parts, height) : 1;
  this->Rows.assign(rows ? static_cast<std::size_t>(height) : 0, glm::dvec4(0.0));
  this->Columns.assign(width, glm::dvec4(0.0));
  // Of each column, by part: luminance times cosine, sine of the latitude and 1.
  std::vector<glm::dvec3> partSums(static_cast<std::size_t>(parts) * width, glm::dvec3(0.0));
  const auto sumPart = [&](int part)
  {
    std::vector<float> room;
    glm::dvec3* sums = partSums.data() + static_cast<std::size_t>(part) * width;
    const glm::dvec2* azimuths = this->Directions.Columns.data() + n.X0;
    const int last = n.Y0 + height * (part + 1) / parts;
    for (int y = n.Y0 + height * part / parts; y < last; ++y)
    {
      const float* rgb = this->Changes.GetRow(this->Environment, y, n.X0, n.X1, room);
      const glm::dvec2 latitude = this->Directions.Rows[static_cast<std::size_t>(y)];
      const double solidAngle = this->Environment->GetTexelSolidAngle(y);
      const glm::dvec3 weight = solidAngle * glm::dvec3(latitude, 1.0);
      double total = 0.0;
      glm::dvec2 moment(0.0);
      for (int x = 0; x < n.X1 - n.X0; ++x)
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
        this->Rows[static_cast<std::size_t>(y - n.Y0)] =
          solidAngle *
          glm::dvec4(latitude.x * moment.x, latitude.y * total, latitude.x * moment.y, total);
      }
    }
  };
  if (parts > 1)
  {
    ParallelForEach(parts, sumPart);
  }
  else
  {
    sumPart(0);
  }
  for (std::size_t x = 0; x < width; ++x)
  {
    glm::dvec3 sum(0.0);
    for (std::size_t k = x; k < partSums.size(); k += width)
    {
      sum += partSums[k];
    }
    const glm::dvec2 azimuth = this->Directions.Columns[static_cast<std::size_t>(n.X0) + x];
    this->Columns[x] = glm::dvec4(sum.x * azimuth.x, sum.y, sum.x * azimuth.y, sum.z);
  }
}

//------------------------------------------------------------------------------
LightTree::LightTree(vtkEnvironment* environment, const TexelChanges& changes, int cells,
  const std::function<bool()>& goOn)
  : Width(environment->GetWidth())
  , Height(environment->GetHeight())
{
  this->Stopped = !goOn();
  if (this->Stopped)
  {
    return;
  }
  CellSlices slices(environment, changes);
  // The largest variance first; of several, the node that was made first.
  std::priority_queue<std::pair<double, std::int64_t>> queue;
  double total = 0.0;
  const auto push = [&](const LightCell& cell, const glm::dvec4& sum)
  {
    const double variance = GetVariance(sum);
    if (!cell.IsTexel() && variance > std::max(OwnRounding * sum.w, MapRounding * total))
    {
      queue.push({ variance, -static_cast<std::int64_t>(this->Nodes.size()) });
    }
    Node node;
    static_cast<LightCell&>(node) = cell;
    this->Nodes.push_back(node);
  };
  const LightCell whole{ 0, 0, this->Width, this->Height };
  slices.Sum(whole, false, true);
  const auto sum = std::accumulate(slices.Rows.begin(), slices.Rows.end(), glm::dvec4(0.0));
  total = sum.w;
  push(whole, sum);
  std::int64_t visited = 0;
  for (int count = 1; count < cells && !queue.empty(); ++count)
  {
    const auto next = static_cast<std::size_t>(-queue.top().second);
    queue.pop();
    visited += CountTexels(this->Nodes[next]);
    const Cut cut = FindBestCut(slices, this->Nodes[next]);
    push(cut.Halves[0], cut.Sums[0]);
    push(cut.Halves[1], cut.Sums[1]);
    this->Nodes[next].Split = count + 1;
    if (visited >= TexelsPerReport)
    {
      visited = 0;
      this->Stopped = !goOn();
    }
    if (this->Stopped)
    {
      return;
    }
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
  for (std::size_t k = this->Nodes.size(); k-- > 0;)
  {
    Node& node = this->Nodes[k];
    for (std::size_t child = node.Split == INT_MAX ? 2 : 0; child < 2; ++child)
    {
      const Node& half = this->Nodes[2 * static_cast<std::size_t>(node.Split) - 3 + child];
      node.Luminance += half.Luminance;
      node.Moment += half.Moment;
      node.Irradiance += half.Irradiance;
      node.SolidAngle += half.SolidAngle;
    }
  }
}

//------------------------------------------------------------------------------
void LightTree::FillLightSet(int count, vtkLightSet* output) const
{
  const int cells = std::min(count, static_cast<int>(this->Nodes.size() / 2) + 1);
  output->RemoveAllLights();
  // Nodes come by twos after the first; only the first cells - 1 splits' can be in the set.
  for (std::size_t k = 0; k < 2 * static_cast<std::size_t>(cells) - 1; ++k)
  {
    if (cells < this->Nodes[k].Split)
    {
      this->Nodes[k].AddLight(this->Width, this->Height, output);
    }
  }
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
    for (int x = this->X0; x < this->X1; ++x)
    {
      const float* pixel = texels + 3 * (x - this->X0);
      const glm::dvec3 radiance(pixel[0], pixel[1], pixel[2]);
      rgb += radiance;
      moment += vtkEnvironment::GetLuminance(&radiance.x) * directions.Columns[std::size_t(x)];
    }
    const double solidAngle = environment->GetTexelSolidAngle(y);
    const double luminance = vtkEnvironment::GetLuminance(&rgb.x);
    const glm::dvec2 latitude = directions.Rows[std::size_t(y)];
    this->Irradiance += solidAngle * rgb;
    this->Luminance += solidAngle * luminance;
    this->Moment +=
      solidAngle * glm::dvec3(latitude.x * moment.x, latitude.y * luminance, latitude.x * moment.y);
    this->SolidAngle += solidAngle * (this->X1 - this->X0);
  }
}

//------------------------------------------------------------------------------
void LightCell::AddLight(int width, int height, vtkLightSet* output) const
{
  if (!(this->Luminance > 0.0))
  {
    return;
  }
  // Directions that cancel (a cell all around the sphere) leave only its middle to point at.
  glm::dvec3 direction = this->Moment;
  if (!(glm::length(direction) > 1e-9 * this->Luminance))
  {
    vtkEnvironment::GetDirection(
      0.5 * (this->X0 + this->X1) / width, 0.5 * (this->Y0 + this->Y1) / height, &direction.x);
  }
  const double variance =
    this->IsTexel() ? 0.0
                    : GetVariance(glm::dvec4(this->Moment, this->Luminance)) / this->Luminance;
  if (output->AddLight(&direction.x, &this->Irradiance.x, this->SolidAngle,
        vtkLightSet::GetConcentrationOfVariance(variance)))
  {
    output->SetLastRegion(this->X0, this->Y0, this->X1, this->Y1);
  }
}
} // namespace measuredbrdf
