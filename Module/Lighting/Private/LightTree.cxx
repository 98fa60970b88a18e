// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightTree.h"

#include "HalfVector.h" // for Pi
#include "ParallelFor.h"
#include "SRGB.h"
#include "TexelTree.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace measuredbrdf
{
namespace
{
// Moment and luminance side by side.
using Moments = glm::dvec4;

double GetVariance(const Moments& m)
{
  const glm::dvec3 moment(m);
  return m.w > 0.0 ? std::max(m.w - glm::dot(moment, moment) / m.w, 0.0) : 0.0;
}

// Below these shares of the cell's and of the whole map's sum the variance is rounding.
constexpr double OwnRounding = 1e-12;
constexpr double MapRounding = 1e-14;

// Texels to sum between two reports of progress: some milliseconds.
constexpr std::int64_t TexelsPerReport = 1 << 20;

// Large cells are summed in so many parts, side by side.
constexpr int Parts = 16;
constexpr std::int64_t LargeCell = 1 << 14;
} // namespace

// Finds cuts from sums over the columns and rows of a cell, made anew for each: a table of all sums
// would take 32 bytes a texel.
class LightTree::Cutter
{
public:
  Cutter(vtkEnvironment* environment, const LightTree& tree)
    : Environment(environment)
    , Changes(*tree.Changes)
    , Directions(tree.Width, tree.Height)
  {
  }

  Moments GetSum(const Node& n)
  {
    this->SumUp(n, false, true);
    return std::accumulate(this->Rows.begin(), this->Rows.end(), Moments(0.0));
  }

  /// The halves and their sums.
  void Cut(const Node& n, Node (&halves)[2], Moments (&sums)[2])
  {
    this->SumUp(n, n.X1 - n.X0 > 1, n.Y1 - n.Y0 > 1);
    double best = std::numeric_limits<double>::infinity();
    const auto findBest = [&](const std::vector<Moments>& slices, const auto& cut)
    {
      const Moments sum = std::accumulate(slices.begin(), slices.end(), Moments(0.0));
      Moments part(0.0);
      for (std::size_t k = 1; k < slices.size(); ++k)
      {
        part += slices[k - 1];
        const double cost = measuredbrdf::GetVariance(part) + measuredbrdf::GetVariance(sum - part);
        if (cost < best)
        {
          best = cost;
          cut(static_cast<int>(k));
          sums[0] = part;
          sums[1] = sum - part;
        }
      }
    };
    halves[0] = halves[1] = n;
    findBest(this->Columns,
      [&](int k)
      {
        halves[0] = Node{ { n.X0, n.Y0, n.X0 + k, n.Y1 } };
        halves[1] = Node{ { n.X0 + k, n.Y0, n.X1, n.Y1 } };
      });
    findBest(this->Rows,
      [&](int k)
      {
        halves[0] = Node{ { n.X0, n.Y0, n.X1, n.Y0 + k } };
        halves[1] = Node{ { n.X0, n.Y0 + k, n.X1, n.Y1 } };
      });
  }

private:
  // The sums of columns and rows, none of either where it is not wanted.
  void SumUp(const Node& n, bool columns, bool rows)
  {
    const std::size_t width = columns ? static_cast<std::size_t>(n.X1 - n.X0) : 0;
    const int height = n.Y1 - n.Y0;
    const std::int64_t texels = static_cast<std::int64_t>(n.X1 - n.X0) * height;
    const int parts = texels >= LargeCell ? std::min(Parts, height) : 1;
    this->Rows.assign(rows ? static_cast<std::size_t>(height) : 0, Moments(0.0));
    this->Columns.assign(width, Moments(0.0));
    // Of each column, by part: luminance times cosine, sine of the latitude and 1.
    this->Sums.assign(static_cast<std::size_t>(parts) * width, glm::dvec3(0.0));
    const auto sumPart = [&](vtkIdType part)
    {
      std::vector<float> room;
      glm::dvec3* sums = this->Sums.data() + static_cast<std::size_t>(part) * width;
      const glm::dvec2* azimuths = this->Directions.Columns.data() + n.X0;
      const int last = n.Y0 + static_cast<int>(height * (part + 1) / parts);
      for (int y = n.Y0 + static_cast<int>(height * part / parts); y < last; ++y)
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
            Moments(latitude.x * moment.x, latitude.y * total, latitude.x * moment.y, total);
        }
      }
    };
    if (parts > 1)
    {
      measuredbrdf::ParallelFor(0, parts, 1,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType part = begin; part < end; ++part)
          {
            sumPart(part);
          }
        });
    }
    else
    {
      sumPart(0);
    }
    for (std::size_t x = 0; x < width; ++x)
    {
      glm::dvec3 sum(0.0);
      for (std::size_t part = 0; part < static_cast<std::size_t>(parts); ++part)
      {
        sum += this->Sums[part * width + x];
      }
      const glm::dvec2 azimuth = this->Directions.Columns[static_cast<std::size_t>(n.X0) + x];
      this->Columns[x] = Moments(sum.x * azimuth.x, sum.y, sum.x * azimuth.y, sum.z);
    }
  }

  vtkEnvironment* Environment;
  const TexelChanges& Changes;
  TexelDirections Directions;
  std::vector<Moments> Columns; // of the last cell
  std::vector<Moments> Rows;
  std::vector<glm::dvec3> Sums;
};

//------------------------------------------------------------------------------
LightTree::LightTree(vtkEnvironment* environment, std::shared_ptr<const TexelChanges> changes)
  : Width(environment->GetWidth())
  , Height(environment->GetHeight())
  , Changes(changes ? std::move(changes) : std::make_shared<TexelChanges>())
{
}

//------------------------------------------------------------------------------
void LightTree::Push(std::size_t node, const glm::dvec4& sum)
{
  const double variance = measuredbrdf::GetVariance(sum);
  if (!this->Nodes[node].IsTexel() &&
      variance > std::max(OwnRounding * sum.w, MapRounding * this->Total))
  {
    this->Queue.push({ variance, node });
  }
}

//------------------------------------------------------------------------------
bool LightTree::Grow(
  vtkEnvironment* environment, int cells, const std::function<bool(double)>& progress)
{
  const std::size_t firstNode = this->Nodes.size();
  if (!progress(0.0))
  {
    return false;
  }
  Cutter cutter(environment, *this);
  if (this->Nodes.empty())
  {
    this->Nodes.push_back({ { 0, 0, this->Width, this->Height } });
    const Moments sum = cutter.GetSum(this->Nodes.back());
    this->Total = sum.w;
    this->Residuals.push_back(sum.w > 0.0 ? measuredbrdf::GetVariance(sum) / sum.w : 0.0);
    this->Push(0, sum);
  }
  const int begin = this->GetNumberOfCells();
  std::int64_t visited = 0;
  for (int count = begin; count < cells && !this->Queue.empty(); ++count)
  {
    const Candidate next = this->Queue.top();
    this->Queue.pop();
    Node halves[2];
    Moments sums[2] = { Moments(0.0), Moments(0.0) };
    const Node& whole = this->Nodes[next.Node];
    visited += static_cast<std::int64_t>(whole.X1 - whole.X0) * (whole.Y1 - whole.Y0);
    cutter.Cut(whole, halves, sums);
    this->Nodes.insert(this->Nodes.end(), { halves[0], halves[1] });
    this->Nodes[next.Node].Split = static_cast<int>(this->Nodes.size() / 2) + 1;
    this->Push(this->Nodes.size() - 2, sums[0]);
    this->Push(this->Nodes.size() - 1, sums[1]);
    const double before = this->Residuals.back();
    const double gain =
      next.Variance - measuredbrdf::GetVariance(sums[0]) - measuredbrdf::GetVariance(sums[1]);
    const bool isRounding = this->Queue.empty();
    this->Residuals.push_back(
      isRounding ? 0.0 : std::clamp(before - gain / this->Total, 0.0, before));
    if (visited >= TexelsPerReport)
    {
      visited = 0;
      if (!progress(static_cast<double>(count - begin) / (cells - begin)))
      {
        return false;
      }
    }
  }
  this->Gather(environment, firstNode);
  return progress(1.0);
}

//------------------------------------------------------------------------------
void LightTree::FillLightSet(int count, vtkLightSet* output) const
{
  const int cells = std::min(count, this->GetNumberOfCells());
  output->RemoveAllLights();
  // Only the first cells - 1 splits' nodes can be in the set.
  for (std::size_t k = 0; k < 2 * static_cast<std::size_t>(cells) - 1; ++k)
  {
    const Node& node = this->Nodes[k];
    if (this->IsIn(k, cells))
    {
      node.AddLight(this->Width, this->Height, output);
    }
  }
}

//------------------------------------------------------------------------------
void LightTree::Gather(vtkEnvironment* environment, std::size_t firstNode)
{
  const TexelDirections directions(this->Width, this->Height);
  measuredbrdf::ParallelFor(static_cast<vtkIdType>(firstNode),
    static_cast<vtkIdType>(this->Nodes.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        Node& node = this->Nodes[static_cast<std::size_t>(k)];
        if (node.Split == INT_MAX)
        {
          node.Gather(environment, *this->Changes, directions); // exact, not by differences of sums
        }
      }
    });

  // Children come after their parents.
  for (std::size_t k = this->Nodes.size(); k-- > firstNode;)
  {
    Node& node = this->Nodes[k];
    if (node.Split != INT_MAX)
    {
      for (std::size_t child : { 2 * std::size_t(node.Split) - 3, 2 * std::size_t(node.Split) - 2 })
      {
        node.Luminance += this->Nodes[child].Luminance;
        node.Moment += this->Nodes[child].Moment;
        node.Irradiance += this->Nodes[child].Irradiance;
        node.SolidAngle += this->Nodes[child].SolidAngle;
      }
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
    this->IsTexel() ? 0.0 : GetVariance(Moments(this->Moment, this->Luminance)) / this->Luminance;
  if (output->AddLight(&direction.x, &this->Irradiance.x, this->SolidAngle,
        vtkLightSet::GetConcentrationOfVariance(variance)))
  {
    output->SetLastRegion(this->X0, this->Y0, this->X1, this->Y1);
  }
}
} // namespace measuredbrdf
