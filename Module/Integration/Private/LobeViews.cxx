// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeViews.h"

#include "HalfTurn.h"
#include "HalfVector.h" // for Pi
#include "LightLanes.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "RetroLobe.h"
#include "vtkBRDF.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int MostSeeds = 256;   // draws from the material that tell where its lobes are
constexpr int PointsPerSide = 4; // of a cell, at their centers
constexpr int KnownLevels = 6;
constexpr int Levels = 14; // deepest cells: 0.009 degrees a side

using Points = std::array<glm::dvec3, PointsPerSide * PointsPerSide>;

Points MakePoints(double a, double b, double side)
{
  Points points;
  for (int k = 0; k < PointsPerSide * PointsPerSide; ++k)
  {
    points[k] = SquareToHemisphere({ a + side * (k % PointsPerSide + 0.5) / PointsPerSide,
      b + side * (k / PointsPerSide + 0.5) / PointsPerSide });
  }
  return points;
}

// Coarse cells' points, which every tree needs, are made once: level after level, row after row.
std::vector<Points> MakeKnownPoints()
{
  std::vector<Points> known;
  for (int level = 0; level < KnownLevels; ++level)
  {
    const int count = 1 << level;
    const double side = 2.0 / count;
    for (int k = 0; k < count * count; ++k)
    {
      known.push_back(MakePoints(-1.0 + side * (k % count), -1.0 + side * (k / count), side));
    }
  }
  return known;
}

// Of a cell; room is for those that are not known.
const Points& GetPoints(double a, double b, double side, int level, Points& room)
{
  // Threads may use it until the very end.
  static const auto& known = *new std::vector<Points>(MakeKnownPoints());
  if (level >= KnownLevels)
  {
    return room = MakePoints(a, b, side);
  }
  const int column = static_cast<int>((a + 1.0) / side);
  const int row = static_cast<int>((b + 1.0) / side);
  return known[((1 << (2 * level)) - 1) / 3 + (row << level) + column];
}

struct Node
{
  double A; // lower corner on the square
  double B;
  int Level; // side = 2 / 2^Level
  int Child = -1;
  LobeQuadrature::Cell Cell;

  double GetSide() const { return std::ldexp(2.0, -this->Level); }
};

class Tree
{
public:
  Tree(vtkBRDF* brdf, const glm::dvec3& o)
    : Lights(brdf)
    , View(o)
  {
    this->Add(-1.0, -1.0, 0);
  }

  void Split(int index)
  {
    const Node node = this->Nodes[index];
    this->Nodes[index].Child = static_cast<int>(this->Nodes.size());
    const double half = node.GetSide() / 2.0;
    for (int k = 0; k < 4; ++k)
    {
      this->Add(node.A + (k % 2) * half, node.B + (k / 2) * half, node.Level + 1);
    }
  }

  int FindLeaf(const glm::dvec2& p) const
  {
    int index = 0;
    while (this->Nodes[index].Child >= 0)
    {
      const Node& node = this->Nodes[index];
      const double half = node.GetSide() / 2.0;
      index = node.Child + (p.x >= node.A + half ? 1 : 0) + (p.y >= node.B + half ? 2 : 0);
    }
    return index;
  }

  std::vector<Node> Nodes;

private:
  void Add(double a, double b, int level)
  {
    Node node;
    node.A = a;
    node.B = b;
    node.Level = level;
    const double side = node.GetSide();
    node.Cell.SolidAngle = side * side * Pi / 2.0;
    const double part = node.Cell.SolidAngle / (PointsPerSide * PointsPerSide);
    glm::dvec3 weight(0.0);
    glm::dvec3 centroid(0.0);
    glm::dvec3 center(0.0);
    double cosine = 0.0;
    Points room, values;
    const Points& points = GetPoints(a, b, side, level, room);
    this->Lights.Evaluate(points.size(), points.data(), this->View, values.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const glm::dvec3& i = points[k];
      const glm::dvec3& f = values[k];
      weight += f * (i.z * part);
      cosine += i.z * part;
      centroid += i * ((f.x + f.y + f.z) * i.z);
      center += i;
    }
    node.Cell.Weight = weight;
    node.Cell.Cosine = cosine;
    const double length = glm::length(centroid);
    node.Cell.Direction = length > 0.0 ? centroid / length : glm::normalize(center);
    this->Nodes.push_back(node);
  }

  LightLanes Lights;
  glm::dvec3 View;
};

// What splitting may gain: energy times the spread of directions it stands for.
double GetPriority(const Node& node)
{
  const glm::dvec3& w = node.Cell.Weight;
  return node.Level >= Levels ? 0.0 : (w.x + w.y + w.z) * node.Cell.SolidAngle;
}

// Lobes that fall between the points of large cells.
int SplitWhereLobesAre(
  vtkBRDF* brdf, const glm::dvec3& o, int seeds, int leaves, int most, Tree& tree)
{
  for (int k = 0; k < seeds && leaves < most; ++k)
  {
    glm::dvec3 i;
    if (!brdf->Sample(
          &o.x, (k + 0.5) / seeds, RadicalInverse(static_cast<unsigned int>(k), 2), &i.x))
    {
      continue;
    }
    const double wanted = 8.0 / (seeds * std::max(brdf->Pdf(&i.x, &o.x), 1e-3));
    const glm::dvec2 p = HemisphereToSquare(i);
    for (int leaf = tree.FindLeaf(p); leaves < most; leaf = tree.FindLeaf(p))
    {
      const Node& node = tree.Nodes[leaf];
      if (node.Cell.SolidAngle <= wanted || node.Level >= Levels)
      {
        break;
      }
      tree.Split(leaf);
      leaves += 3;
    }
  }
  return leaves;
}

// Retro-reflection, which neither points nor draws need show: until its cells' means do.
int SplitTowardsTheViewer(vtkBRDF* brdf, const glm::dvec3& o, int leaves, int most, Tree& tree)
{
  for (const glm::dvec3& i : RetroLobe(o).GetProbes())
  {
    glm::dvec3 f;
    brdf->Evaluate(&i.x, &o.x, &f.x);
    const double peak = f.x + f.y + f.z;
    const glm::dvec2 p = HemisphereToSquare(i);
    for (int leaf = tree.FindLeaf(p); peak > 3.0 * RetroLobe::LeastPeak / Pi && leaves < most;
         leaf = tree.FindLeaf(p))
    {
      const Node& node = tree.Nodes[leaf];
      const glm::dvec3& w = node.Cell.Weight;
      if (w.x + w.y + w.z >= 0.5 * peak * node.Cell.Cosine || node.Level >= Levels)
      {
        break;
      }
      tree.Split(leaf);
      leaves += 3;
    }
  }
  return leaves;
}

// The cells that matter most, while there are fewer than count.
void SplitByPriority(int leaves, int count, Tree& tree)
{
  std::priority_queue<std::pair<double, int>> queue;
  for (std::size_t k = 0; k < tree.Nodes.size(); ++k)
  {
    if (tree.Nodes[k].Child < 0)
    {
      queue.emplace(GetPriority(tree.Nodes[k]), static_cast<int>(k));
    }
  }
  while (leaves + 3 <= count && queue.top().first > 0.0)
  {
    const int index = queue.top().second;
    queue.pop();
    tree.Split(index);
    leaves += 3;
    for (int k = static_cast<int>(tree.Nodes.size()) - 4; k < static_cast<int>(tree.Nodes.size());
         ++k)
    {
      queue.emplace(GetPriority(tree.Nodes[k]), k);
    }
  }
}
}

LobeQuadrature::LobeQuadrature(vtkBRDF* brdf, const glm::dvec3& o, int count)
{
  Tree tree(brdf, o);
  for (int level = 0, first = 0; level < 2; ++level)
  {
    const int last = tree.Nodes.size();
    for (; first < last; ++first)
    {
      tree.Split(first);
    }
  }
  int leaves = SplitWhereLobesAre(brdf, o, std::min(count, MostSeeds), 16, count / 2, tree);
  leaves = SplitTowardsTheViewer(brdf, o, leaves, count * 3 / 4, tree);
  SplitByPriority(leaves, count, tree);
  for (const Node& node : tree.Nodes)
  {
    if (node.Child < 0)
    {
      this->Cells.push_back(node.Cell);
    }
  }
}

glm::dvec3 LobeQuadrature::GetAlbedo() const
{
  glm::dvec3 sum(0.0);
  for (const Cell& cell : this->Cells)
  {
    sum += cell.Weight;
  }
  return sum;
}

glm::dvec3 LobeQuadrature::GetFloor(double minimumCosine) const
{
  glm::dvec3 least(std::numeric_limits<double>::max());
  for (const Cell& cell : this->Cells)
  {
    if (cell.Direction.z >= minimumCosine)
    {
      least = glm::min(least, cell.Weight / cell.Cosine);
    }
  }
  return least;
}

namespace
{
constexpr double FloorCosine = 0.17;    // 80 degrees: measured f drops or soars beyond
constexpr double LeastAmplitude = 1e-6; // of the albedo: below, the rest is rounding of floats

// The normal where there is no direction.
glm::dvec3 ToUnit(const glm::dvec3& d)
{
  const double length = glm::length(d);
  return length > 0.0 ? d / length : glm::dvec3(0.0, 0.0, 1.0);
}
}

LobeMeans::LobeMeans(const LobeQuadrature& quadrature)
  : Floor(glm::max(quadrature.GetFloor(FloorCosine), glm::dvec3(0.0)))
{
  const glm::dvec3 albedo = quadrature.GetAlbedo();
  this->Albedo = albedo.x + albedo.y + albedo.z;
  glm::dvec3 axis(0.0);
  for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
  {
    this->Amplitude += cell.Weight - this->Floor * cell.Cosine;
    const double energy = LobeQuadrature::GetEnergy(cell, this->Floor);
    const double density = energy / cell.SolidAngle;
    axis += cell.Direction * (energy * density * density);
  }
  for (int c = 0; c < 3; ++c)
  {
    if (this->Amplitude[c] <= LeastAmplitude * Pi * this->Floor[c])
    {
      this->Amplitude[c] = 0.0;
    }
  }
  this->Axis = ToUnit(axis);
  this->Delta = std::atan2(-this->Axis.x, this->Axis.z);
}

void LobeMeans::Add(const LobeMeans& other, double weight)
{
  this->Floor += weight * other.Floor;
  this->Amplitude += weight * other.Amplitude;
  this->Delta += weight * other.Delta;
  this->Axis += weight * other.Axis;
  this->Albedo += weight * other.Albedo;
}

namespace
{
constexpr int ViewCells = 512; // of a view's quadrature
constexpr int QuickCells = 128;

// Views are found from coarse to fine: one is interpolated where those about it agree, by so much
// of the albedo and so many radians, with what their neighbors say. That also smooths the axes.
constexpr int Stride = 8;
constexpr double LargestBend = 1e-3;
constexpr double LargestQuickBend = 0.03;

constexpr double KnotPower = 1.5;   // 1: evenly spaced
constexpr double FastestAxis = 1.5; // times the view's angle; mirror directions: 1

double GetDistance(const LobeMeans& a, const LobeMeans& b)
{
  const glm::dvec3 differences =
    glm::max(glm::abs(a.Amplitude - b.Amplitude), Pi * glm::abs(a.Floor - b.Floor));
  const double largest = std::max({ differences.x, differences.y, differences.z });
  return std::max(largest > 0.0 ? 3.0 * largest / a.Albedo : 0.0, std::abs(a.Delta - b.Delta));
}
}

double LobeViews::GetLastAngle() { return std::acos(MinimumViewCosine); }

double LobeViews::GetAngle(int index, int count)
{
  const double t = 1.0 - static_cast<double>(index) / (count - 1);
  return GetLastAngle() * (1.0 - t * t);
}

double LobeViews::GetPosition(double angle)
{
  return (NumberOfViews - 1) * (1.0 - std::sqrt(std::max(1.0 - angle / GetLastAngle(), 0.0)));
}

double LobeViews::GetKnotAngle(int k, int count)
{
  const double t = 1.0 - static_cast<double>(k) / (count - 1);
  return GetLastAngle() * (1.0 - std::pow(t, KnotPower));
}

double LobeViews::GetKnotPosition(double angle, int count)
{
  const double t = std::clamp(1.0 - angle / GetLastAngle(), 0.0, 1.0);
  return (count - 1) * (1.0 - std::pow(t, 1.0 / KnotPower));
}

const std::atomic<bool> LobeViews::Never{ false };

LobeViews::LobeViews(vtkBRDF* brdf, const std::atomic<bool>& abort, bool quick)
  : Views(NumberOfViews)
{
  const int cells = quick ? QuickCells : ViewCells;
  const double bend = quick ? LargestQuickBend : LargestBend;
  std::vector<int> wanted;
  for (int k = 0; k < NumberOfViews - 1; k += Stride)
  {
    wanted.push_back(k);
  }
  wanted.push_back(NumberOfViews - 1);
  this->Evaluate(brdf, wanted, cells, abort);
  std::vector<int> known = wanted; // sorted
  std::vector<std::pair<int, int>> gaps;
  for (std::size_t k = 0; k + 1 < known.size(); ++k)
  {
    gaps.emplace_back(known[k], known[k + 1]);
  }
  while (!gaps.empty() && !abort)
  {
    wanted.clear();
    std::vector<LobeMeans> guesses;
    for (const auto& [low, high] : gaps)
    {
      wanted.push_back((low + high) / 2);
      guesses.push_back(this->Interpolate(known, wanted.back()));
    }
    this->Evaluate(brdf, wanted, cells, abort);
    std::vector<std::pair<int, int>> finer;
    for (std::size_t k = 0; k < gaps.size(); ++k)
    {
      const auto [low, high] = gaps[k];
      const int middle = wanted[k];
      const LobeMeans& means = this->Views[middle].Means;
      if (GetDistance(means, guesses[k]) > bend)
      {
        for (const auto& gap : { std::pair(low, middle), std::pair(middle, high) })
        {
          if (gap.second - gap.first > 1)
          {
            finer.push_back(gap);
          }
        }
      }
    }
    known.insert(known.end(), wanted.begin(), wanted.end());
    std::sort(known.begin(), known.end());
    gaps = finer;
  }
  for (int k = 0; k < NumberOfViews; ++k)
  {
    View& view = this->Views[k];
    if (view.Cells.empty())
    {
      view.Means = this->Interpolate(known, k);
    }
  }
  this->LimitAxes();
}

// To the middle between the least function above and the largest below that are never steeper.
void LobeViews::LimitAxes()
{
  std::vector<double> limited;
  for (int k = 0; k < NumberOfViews; ++k)
  {
    double above = HUGE_VAL;
    double below = -HUGE_VAL;
    for (int other = 0; other < NumberOfViews; ++other)
    {
      const double delta = this->Views[other].Means.Delta;
      const double reach = FastestAxis * std::abs(GetAngle(k) - GetAngle(other));
      above = std::min(above, delta + reach);
      below = std::max(below, delta - reach);
    }
    const double farthest = FastestAxis * GetAngle(k); // seen along the normal it is the normal
    limited.push_back(std::clamp(0.5 * (above + below), -farthest, farthest));
  }
  for (std::size_t k = 0; k < limited.size(); ++k)
  {
    this->Views[k].Means.Delta = limited[k];
  }
}

double LobeViews::GetAxis(double theta) const
{
  const double exact = GetPosition(theta);
  const int low = std::min(static_cast<int>(exact), NumberOfViews - 2);
  const double below = this->Views[low].Means.Delta;
  const double above = this->Views[static_cast<std::size_t>(low) + 1].Means.Delta;
  return below + (exact - low) * (above - below);
}

void LobeViews::Evaluate(
  vtkBRDF* brdf, const std::vector<int>& indices, int cells, const std::atomic<bool>& abort)
{
  measuredbrdf::ParallelForEach(
    indices.size(),
    [&](std::size_t k)
    {
      const double theta = GetAngle(indices[k]);
      const LobeQuadrature quadrature(
        brdf, glm::dvec3(std::sin(theta), 0.0, std::cos(theta)), cells);
      View& view = this->Views[indices[k]];
      view.Means = LobeMeans(quadrature);
      for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
      {
        view.Cells.push_back(
          { LobeQuadrature::GetEnergy(cell, view.Means.Floor), cell.SolidAngle });
      }
    },
    &abort);
}

// Cubic, after Lagrange, through the four known ones about it.
LobeMeans LobeViews::Interpolate(const std::vector<int>& known, int index) const
{
  const int count = static_cast<int>(known.size());
  const int above =
    static_cast<int>(std::lower_bound(known.begin(), known.end(), index) - known.begin());
  const int first = std::clamp(above - 2, 0, count - 4);
  LobeMeans sum;
  for (int k = first; k < first + 4; ++k)
  {
    const int at = known[k];
    double weight = 1.0;
    for (int other = first; other < first + 4; ++other)
    {
      const int node = known[other];
      weight *= other == k ? 1.0 : static_cast<double>(index - node) / (at - node);
    }
    sum.Add(this->Views[at].Means, weight);
  }
  sum.Floor = glm::max(sum.Floor, glm::dvec3(0.0));
  sum.Amplitude = glm::max(sum.Amplitude, glm::dvec3(0.0));
  sum.Albedo = std::max(sum.Albedo, 0.0);
  const double length = glm::length(sum.Axis);
  sum.Axis = length > 0.0 ? sum.Axis / length : glm::dvec3(0.0, 0.0, 1.0);
  return sum;
}

double LobeViews::GetSharpShare(double solidAngle, double farthest) const
{
  double largest = 0.0;
  for (int k = 0; k < NumberOfViews && GetAngle(k) <= farthest; ++k)
  {
    const View& view = this->Views[k];
    double energy = 0.0;
    for (const Cell& cell : view.Cells)
    {
      energy += cell.Energy;
    }
    double above = 0.0;
    for (const Cell& cell : view.Cells)
    {
      above += std::max(cell.Energy - energy / solidAngle * cell.SolidAngle, 0.0);
    }
    if (!view.Cells.empty() && view.Means.Albedo > 0.0)
    {
      largest = std::max(largest, above / view.Means.Albedo);
    }
  }
  return largest;
}

namespace
{
constexpr int AnisotropicViewCells = 256; // of a view's quadrature
}

glm::dvec3 AnisotropicViews::GetView(double theta, double phi)
{
  const double s = std::sin(theta);
  return glm::dvec3(s * std::cos(phi), s * std::sin(phi), std::cos(theta));
}

AnisotropicViews::AnisotropicViews(vtkBRDF* brdf, const std::atomic<bool>& abort)
  : Periods(IsSameAfterHalfATurn(brdf) ? 2 : 1)
  , Means(static_cast<std::size_t>(Angles * Azimuths))
{
  measuredbrdf::ParallelForEach(
    this->Means.size(),
    [&](std::size_t k)
    {
      const int index = static_cast<int>(k);
      this->Means[k] = LobeMeans(LobeQuadrature(brdf,
        GetView(GetAngle(index % Angles), this->GetAzimuth(index / Angles)), AnisotropicViewCells));
    },
    &abort);
}
} // namespace measuredbrdf
