// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightTree.h"

#include "HalfVector.h" // for Pi
#include "SummedAreaTable.h"
#include "TexelDirections.h"
#include "vtkEnvironment.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace measuredbrdf
{
namespace
{
// Moment and luminance side by side: one table, one cache line a look-up.
using Moments = glm::dvec4;

double GetVariance(const Moments& m)
{
  const glm::dvec3 moment(m);
  return m.w > 0.0 ? std::max(m.w - glm::dot(moment, moment) / m.w, 0.0) : 0.0;
}

// Below these the variance is rounding: that of the cell's own sum and, with sums from differences
// of a table, that of the whole map's.
constexpr double OwnRounding = 1e-12;
constexpr double TableRounding = 1e-14;

// Splits between two reports of progress: some milliseconds.
constexpr int SplitsPerReport = 4096;

// Texels that become cells before anything is cut. Each costs the rest a light: with a share of 1 %
// and 16 texels the sum of variances of 64 lights grows by up to 29 %, with these by up to 7 %.
constexpr double BrightRadiance = 100.0; // times the mean
constexpr double BrightShare = 0.05;     // of the energy
constexpr std::size_t MaximumBrightTexels = 4;

double GetTexelLuminance(vtkEnvironment* environment, std::size_t texel)
{
  const float* pixel = &environment->GetPixels()[3 * texel];
  const double rgb[3] = { pixel[0], pixel[1], pixel[2] };
  return vtkEnvironment::GetLuminance(rgb);
}
} // namespace

// Finds cuts from a table of sums without the bright texels.
class LightTree::Cutter
{
public:
  Cutter(vtkEnvironment* environment, const std::vector<std::size_t>& bright, Rule rule)
    : SplitRule(rule)
    , Width(environment->GetWidth())
    , Height(environment->GetHeight())
  {
    const TexelDirections directions(this->Width, this->Height);
    this->Table = BasicSummedAreaTable<Moments>(this->Width, this->Height,
      [&](int y, Moments* values)
      {
        const double solidAngle = environment->GetTexelSolidAngle(y);
        const std::size_t first =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(this->Width);
        for (int x = 0; x < this->Width; ++x)
        {
          const std::size_t texel = first + static_cast<std::size_t>(x);
          values[x] =
            solidAngle * GetTexelLuminance(environment, texel) * Moments(directions.Get(x, y), 1.0);
        }
        for (auto it = std::lower_bound(bright.begin(), bright.end(), first);
             it != bright.end() && *it < first + static_cast<std::size_t>(this->Width); ++it)
        {
          values[*it - first] = Moments(0.0);
        }
      });
    this->Total = this->Table.GetSum(0, 0, this->Width, this->Height).w;
  }

  /// The cell's variance, 0 where it is nothing but rounding or there is nothing to cut.
  double GetVariance(const Node& n) const
  {
    const Moments sum = this->Table.GetSum(n.X0, n.Y0, n.X1, n.Y1);
    const double variance = measuredbrdf::GetVariance(sum);
    const double rounding = std::max(OwnRounding * sum.w, TableRounding * this->Total);
    return n.IsTexel() || variance <= rounding ? 0.0 : variance;
  }

  void Cut(const Node& n, Node& first, Node& second) const
  {
    const Moments sum = this->Table.GetSum(n.X0, n.Y0, n.X1, n.Y1);
    first = second = Node{ n.X0, n.Y0, n.X1, n.Y1 };
    double best = std::numeric_limits<double>::infinity();
    bool tryX = true;
    bool tryY = true;
    if (this->SplitRule == Rule::MinimumVariance)
    {
      tryX = n.Y1 - n.Y0 == 1 || (n.X1 - n.X0 > 1 && this->IsWide(n));
      tryY = !tryX;
    }
    for (int x = n.X0 + 1; tryX && x < n.X1; ++x)
    {
      if (this->Improve(this->Table.GetSum(n.X0, n.Y0, x, n.Y1), sum, best))
      {
        first = Node{ n.X0, n.Y0, x, n.Y1 };
        second = Node{ x, n.Y0, n.X1, n.Y1 };
      }
    }
    for (int y = n.Y0 + 1; tryY && y < n.Y1; ++y)
    {
      if (this->Improve(this->Table.GetSum(n.X0, n.Y0, n.X1, y), sum, best))
      {
        first = Node{ n.X0, n.Y0, n.X1, y };
        second = Node{ n.X0, y, n.X1, n.Y1 };
      }
    }
  }

private:
  // Debevec 2005: the width shrinks with the cosine of the middle row's latitude.
  bool IsWide(const Node& n) const
  {
    const double latitude = Pi * (0.5 * (n.Y0 + n.Y1) / this->Height - 0.5);
    return 2.0 * (n.X1 - n.X0) / this->Width * std::cos(latitude) >=
           1.0 * (n.Y1 - n.Y0) / this->Height;
  }

  bool Improve(const Moments& part, const Moments& sum, double& best) const
  {
    const double first = measuredbrdf::GetVariance(part);
    const double second = measuredbrdf::GetVariance(sum - part);
    const double cost = this->SplitRule == Rule::Greedy ? first + second : std::max(first, second);
    const bool better = cost < best;
    best = better ? cost : best;
    return better;
  }

  Rule SplitRule;
  int Width;
  int Height;
  double Total = 0.0;
  BasicSummedAreaTable<Moments> Table;
};

//------------------------------------------------------------------------------
double LightTree::Node::GetVariance() const
{
  return this->IsTexel() ? 0.0 : measuredbrdf::GetVariance(Moments(this->Moment, this->Luminance));
}

//------------------------------------------------------------------------------
LightTree::LightTree(vtkEnvironment* environment, Rule rule, bool brightTexels)
  : SplitRule(rule)
  , Width(environment->GetWidth())
  , Height(environment->GetHeight())
{
  if (brightTexels)
  {
    this->FindBrightTexels(environment);
  }
}

//------------------------------------------------------------------------------
void LightTree::FindBrightTexels(vtkEnvironment* environment)
{
  double total[3];
  environment->GetTotal(total);
  const double energy = vtkEnvironment::GetLuminance(total);
  const double radiance = BrightRadiance * energy / (4.0 * Pi);
  std::vector<std::pair<double, std::size_t>> found;
  for (int y = 0; y < this->Height; ++y)
  {
    const double least =
      std::max(radiance, BrightShare * energy / environment->GetTexelSolidAngle(y));
    for (int x = 0; x < this->Width; ++x)
    {
      const std::size_t texel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(this->Width) +
        static_cast<std::size_t>(x);
      const double luminance = GetTexelLuminance(environment, texel);
      if (luminance > least)
      {
        found.emplace_back(-luminance * environment->GetTexelSolidAngle(y), texel);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.resize(std::min(found.size(), MaximumBrightTexels));
  for (const auto& entry : found)
  {
    this->Bright.push_back(entry.second);
  }
}

//------------------------------------------------------------------------------
void LightTree::AddChildren(std::size_t parent, const Node& first, const Node& second)
{
  this->Nodes.push_back(first);
  this->Nodes.push_back(second);
  this->Nodes[parent].Split = static_cast<int>(this->Nodes.size() / 2) + 1;
}

//------------------------------------------------------------------------------
void LightTree::Push(const Cutter& cutter, std::size_t node, int depth)
{
  const double variance = cutter.GetVariance(this->Nodes[node]);
  if (variance > 0.0)
  {
    this->Queue.push({ this->SplitRule == Rule::Greedy ? variance : -depth, node, depth });
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
  if (this->Nodes.empty())
  {
    const Node whole{ 0, 0, this->Width, this->Height };
    this->Nodes.push_back(whole);
    for (const std::size_t texel : this->Bright)
    {
      const int x = static_cast<int>(texel % static_cast<std::size_t>(this->Width));
      const int y = static_cast<int>(texel / static_cast<std::size_t>(this->Width));
      this->AddChildren(this->Nodes.size() - 1, Node{ x, y, x + 1, y + 1 }, whole);
    }
    std::sort(this->Bright.begin(), this->Bright.end());
  }
  const Cutter cutter(environment, this->Bright, this->SplitRule);
  if (firstNode == 0)
  {
    this->Push(cutter, this->Nodes.size() - 1, 0);
  }
  const int before = static_cast<int>(this->Nodes.size() / 2) + 1;
  for (int count = before; count < cells && !this->Queue.empty(); ++count)
  {
    const Candidate next = this->Queue.top();
    this->Queue.pop();
    Node first, second;
    cutter.Cut(this->Nodes[next.Node], first, second);
    this->AddChildren(next.Node, first, second);
    this->Push(cutter, this->Nodes.size() - 2, next.Depth + 1);
    this->Push(cutter, this->Nodes.size() - 1, next.Depth + 1);
    if (count % SplitsPerReport == 0 &&
        !progress(static_cast<double>(count - before) / (cells - before)))
    {
      return false;
    }
  }
  this->Gather(environment, firstNode);
  return progress(1.0);
}

//------------------------------------------------------------------------------
void LightTree::Gather(vtkEnvironment* environment, std::size_t firstNode)
{
  // The leaves from the pixels themselves, not from differences of a table: their energy is exact.
  const TexelDirections directions(this->Width, this->Height);
  const auto gather = [&](Node& node)
  {
    for (int y = node.Y0; y < node.Y1; ++y)
    {
      const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(this->Width);
      auto bright = node.IsTexel() ? this->Bright.end()
                                   : std::lower_bound(this->Bright.begin(), this->Bright.end(),
                                       row + static_cast<std::size_t>(node.X0));
      glm::dvec3 rgb(0.0);
      glm::dvec2 moment(0.0);
      int skipped = 0;
      for (int x = node.X0; x < node.X1; ++x)
      {
        const std::size_t texel = row + static_cast<std::size_t>(x);
        if (bright != this->Bright.end() && *bright == texel)
        {
          ++bright;
          ++skipped;
          continue;
        }
        const float* pixel = &environment->GetPixels()[3 * texel];
        const glm::dvec3 radiance(pixel[0], pixel[1], pixel[2]);
        rgb += radiance;
        moment += vtkEnvironment::GetLuminance(&radiance.x) * directions.Columns[std::size_t(x)];
      }
      const double solidAngle = environment->GetTexelSolidAngle(y);
      const double luminance = vtkEnvironment::GetLuminance(&rgb.x);
      const glm::dvec2 latitude = directions.Rows[std::size_t(y)];
      node.Irradiance += solidAngle * rgb;
      node.Luminance += solidAngle * luminance;
      node.Moment += solidAngle * glm::dvec3(latitude.x * moment.x, latitude.y * luminance,
                                    latitude.x * moment.y);
      node.SolidAngle += solidAngle * (node.X1 - node.X0 - skipped);
    }
  };
  vtkSMPTools::For(static_cast<vtkIdType>(firstNode), static_cast<vtkIdType>(this->Nodes.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        Node& node = this->Nodes[static_cast<std::size_t>(k)];
        if (node.Split == INT_MAX)
        {
          gather(node);
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

  const double energy = this->Nodes[0].Luminance;
  if (this->Residuals.empty())
  {
    this->Residuals.push_back(energy > 0.0 ? this->Nodes[0].GetVariance() / energy : 0.0);
  }
  std::vector<std::size_t> parents(this->Nodes.size() / 2 + 2, 0); // by number of cells
  for (std::size_t k = 0; k < this->Nodes.size(); ++k)
  {
    if (this->Nodes[k].Split != INT_MAX)
    {
      parents[static_cast<std::size_t>(this->Nodes[k].Split)] = k;
    }
  }
  for (std::size_t cells = this->Residuals.size() + 1; cells <= this->Nodes.size() / 2 + 1; ++cells)
  {
    const double gain = this->Nodes[parents[cells]].GetVariance() -
                        this->Nodes[2 * cells - 3].GetVariance() -
                        this->Nodes[2 * cells - 2].GetVariance();
    const double before = this->Residuals.back();
    this->Residuals.push_back(energy > 0.0 ? std::clamp(before - gain / energy, 0.0, before) : 0.0);
  }
}
} // namespace measuredbrdf
