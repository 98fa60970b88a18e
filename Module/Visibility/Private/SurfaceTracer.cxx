// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceTracer.h"

#include "SurfacePoints.h"
#include "vtkPolyData.h"

#include <Eigen/Core>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr std::uint64_t MostElements = std::numeric_limits<std::uint32_t>::max() - 1u;

// SurfaceTracer::OffsetOrigin states the rule.
constexpr double OffsetOfExtent = 0x1p-20;
constexpr double OffsetOfPosition = 0x1p-48;

constexpr std::size_t Width = 4; // children of a node of the tree
constexpr int Bins = 16;
constexpr std::uint32_t MostInLeaf = 8;
constexpr std::uint32_t FewInLeaf = 2; // these stay together whatever it costs
constexpr double TraversalCost = 1.0;  // of a node, in triangle tests
// Below this depth parts are halved by number, so the whole tree is less deep than the stack.
constexpr int DeepestByArea = 60;
constexpr std::size_t StackSize = (Width - 1) * (DeepestByArea + 34) + Width;

// Boxes are entered and left in single precision. Coordinates are at most about 1, so planes that
// are this far outside of the triangles, and ends this much later, miss no box whose triangle the
// ray meets.
constexpr float BoxSlack = 0x1p-21f;
constexpr float EndSlack = 1.0f + 0x1p-21f;

constexpr float Largest = std::numeric_limits<float>::max();

bool IsWithinRange(const glm::dvec3& v) { return std::isfinite(glm::dot(v, v)); }
}

/**
 * The triangles of several surfaces, in single precision about the middle of the scene, and a tree
 * of boxes with four children each.
 */
struct SurfaceTracer::Internals
{
  /// Where a surface's points and cells begin in the counts over all surfaces.
  struct Start
  {
    std::uint32_t Point;
    std::uint32_t Cell;
  };

  /// 16 bytes. Corners count over all surfaces' points, cells over all surfaces' cells.
  struct Triangle
  {
    std::uint32_t Corners[3];
    std::uint32_t Cell;
  };

  /// Four boxes, each with a node below it or a run of triangles. Absent children have boxes that
  /// no ray meets.
  struct Node
  {
    float Bounds[2][3][Width]; // low and high of x, y, z
    std::uint32_t First[Width];
    std::uint32_t Count[Width]; // of triangles from First on; 0: First is a node
  };

  /// A ray in own coordinates; t is as in those of the scene.
  struct Ray
  {
    glm::dvec3 Origin;
    glm::dvec3 Direction;
    double Least;
    double Most; // t, of the nearest hit so far
  };

  struct Box
  {
    glm::vec3 Low = glm::vec3(Largest);
    glm::vec3 High = glm::vec3(-Largest);

    void Add(const Box& other)
    {
      this->Low = glm::min(this->Low, other.Low);
      this->High = glm::max(this->High, other.High);
    }
    glm::vec3 GetCenter() const { return 0.5f * this->Low + 0.5f * this->High; }
    double GetArea() const // half of it
    {
      const glm::dvec3 size = glm::dvec3(this->High) - glm::dvec3(this->Low);
      return size.x < 0.0 ? 0.0 : size.x * size.y + size.y * size.z + size.z * size.x;
    }
  };

  /// Some of the triangles, while the tree is built.
  struct Part
  {
    std::uint32_t Begin = 0;
    std::uint32_t End = 0;
    int Depth = 0; // how often the whole was cut for it
    Box Bounds;
    Box Centers;
    bool IsLeaf = true; // it is not to be cut
  };

  /// Where to cut a part: behind a bin of an axis.
  struct Split
  {
    int Axis = -1;
    int Bin = 0;
    double Cost = std::numeric_limits<double>::max();
  };

  std::vector<Start> Starts;
  std::vector<glm::dvec3> Positions; // until Finish
  std::vector<glm::vec3> Points;     // in own coordinates
  std::vector<Triangle> Triangles;
  std::vector<Node> Nodes;
  std::uint64_t Cells = 0;
  vtkIdType Skipped = 0;

  /// Own coordinates: (position - Middle) * Scale, a power of two. All lie in [-1,1], whatever the
  /// unit of length, so products of single precision numbers neither overflow nor vanish.
  glm::dvec3 Middle = glm::dvec3(0.0);
  double Scale = 1.0;
  glm::dvec3 Low = glm::dvec3(0.0); // of all triangles
  glm::dvec3 High = glm::dvec3(0.0);
  double Offset = 0.0;

  glm::dvec3 GetPoint(std::uint32_t corner) const { return this->Points[corner]; }
  glm::dvec3 GetNormal(const Triangle& triangle) const // times twice the area
  {
    const glm::dvec3 a = this->GetPoint(triangle.Corners[0]);
    return glm::cross(
      this->GetPoint(triangle.Corners[1]) - a, this->GetPoint(triangle.Corners[2]) - a);
  }
  Box GetBox(const Triangle& triangle) const
  {
    Box box;
    for (const std::uint32_t corner : triangle.Corners)
    {
      box.Add({ this->Points[corner], this->Points[corner] });
    }
    return box;
  }

  int Add(vtkPolyData* surface, const double* m);
  void Finish();
  void BuildTree();
  Part MakePart(std::uint32_t begin, std::uint32_t end, int depth) const;
  Split FindSplit(const Part& part) const;
  std::uint32_t Cut(const Part& part);
  std::vector<Part> Divide(const Part& whole);

  static int GetBin(float center, float low, float high)
  {
    return std::min(static_cast<int>(Bins * ((center - low) / (high - low))), Bins - 1);
  }

  /**
   * Whether the ray meets the triangle between Least and Most; then its t and weights of corners.
   * By edge functions (Pluecker coordinates): exactly opposite for the two triangles at an edge, so
   * that no ray passes between them. In double precision.
   */
  bool Meets(const Triangle& triangle, const Ray& ray, double& t, glm::dvec3& weights) const
  {
    const glm::dvec3 a = this->GetPoint(triangle.Corners[0]) - ray.Origin;
    const glm::dvec3 b = this->GetPoint(triangle.Corners[1]) - ray.Origin;
    const glm::dvec3 c = this->GetPoint(triangle.Corners[2]) - ray.Origin;
    const double u = glm::dot(glm::cross(c + b, c - b), ray.Direction);
    const double v = glm::dot(glm::cross(a + c, a - c), ray.Direction);
    const double w = glm::dot(glm::cross(b + a, b - a), ray.Direction);
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0))
    {
      return false;
    }
    const double sum = u + v + w;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double slope = glm::dot(normal, ray.Direction);
    t = glm::dot(normal, a) / slope;
    if (sum == 0.0 || slope == 0.0 || !(t > ray.Least && t < ray.Most))
    {
      return false;
    }
    weights = glm::dvec3(u, v, w) / sum;
    return true;
  }

  // The nearest hit, or with `any` the first one found; its triangle's index, or -1. A ray that is
  // none, or not finite, meets nothing.
  std::int64_t Trace(const double origin[3], const double direction[3], double tMin, double tMax,
    bool any, double& t, glm::dvec3& weights) const;
};

int SurfaceTracer::Internals::Add(vtkPolyData* surface, const double* m)
{
  const std::uint64_t points = this->Positions.size();
  if (!surface ||
      points + static_cast<std::uint64_t>(surface->GetNumberOfPoints()) > MostElements ||
      this->Cells + static_cast<std::uint64_t>(surface->GetNumberOfCells()) > MostElements)
  {
    return -1;
  }
  const Start start{ static_cast<std::uint32_t>(points), static_cast<std::uint32_t>(this->Cells) };
  this->Starts.push_back(start);
  for (vtkIdType k = 0; k < surface->GetNumberOfPoints(); ++k)
  {
    glm::dvec3 p;
    surface->GetPoint(k, &p.x);
    glm::dvec3 placed = p;
    for (int c = 0; c < 3 && m; ++c)
    {
      placed[c] = m[4 * c] * p.x + m[4 * c + 1] * p.y + m[4 * c + 2] * p.z + m[4 * c + 3];
    }
    this->Positions.push_back(placed);
  }
  this->Skipped += ForEachFace(surface, Faces::Triangles,
    [&](const vtkIdType* corners, vtkIdType, vtkIdType cell)
    {
      Triangle triangle{ {}, start.Cell + static_cast<std::uint32_t>(cell) };
      bool isFinite = true;
      for (int c = 0; c < 3; ++c)
      {
        triangle.Corners[c] = start.Point + static_cast<std::uint32_t>(corners[c]);
        const glm::dvec3& p = this->Positions[triangle.Corners[c]];
        isFinite = isFinite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
      }
      if (isFinite)
      {
        this->Triangles.push_back(triangle);
      }
      this->Skipped += isFinite ? 0 : 1;
    });
  this->Cells += static_cast<std::uint64_t>(surface->GetNumberOfCells());
  return static_cast<int>(this->Starts.size()) - 1;
}

// After the last surface: to single precision about the middle, and without triangles of no area.
void SurfaceTracer::Internals::Finish()
{
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(-low);
  for (const Triangle& triangle : this->Triangles)
  {
    for (const std::uint32_t corner : triangle.Corners)
    {
      low = glm::min(low, this->Positions[corner]);
      high = glm::max(high, this->Positions[corner]);
    }
  }
  if (this->Triangles.empty())
  {
    low = high = glm::dvec3(0.0);
  }
  this->Middle = 0.5 * low + 0.5 * high;
  const glm::dvec3 half = high - this->Middle;
  const double longest = std::max({ half.x, half.y, half.z });
  int exponent = 0;
  std::frexp(longest, &exponent);
  this->Scale = longest > 0.0 ? std::ldexp(1.0, -exponent) : 1.0;
  this->Points.reserve(this->Positions.size());
  for (const glm::dvec3& position : this->Positions)
  {
    const glm::dvec3 own = (position - this->Middle) * this->Scale;
    // Points that no triangle uses may be anywhere.
    const bool isWithin =
      std::abs(own.x) <= 1.0 && std::abs(own.y) <= 1.0 && std::abs(own.z) <= 1.0;
    this->Points.push_back(isWithin ? glm::vec3(own) : glm::vec3(0.0f));
  }
  std::vector<glm::dvec3>().swap(this->Positions);

  const auto last = std::remove_if(this->Triangles.begin(), this->Triangles.end(),
    [this](const Triangle& triangle)
    {
      const double area = glm::length(this->GetNormal(triangle));
      return !(area > 0.0) || !std::isfinite(area);
    });
  this->Skipped += static_cast<vtkIdType>(this->Triangles.end() - last);
  this->Triangles.erase(last, this->Triangles.end());
  this->Triangles.shrink_to_fit();

  this->Low = (low - this->Middle) * this->Scale;
  this->High = half * this->Scale;
  const glm::dvec3 farthest = glm::abs(this->Middle) + half;
  this->Offset =
    OffsetOfExtent * longest + OffsetOfPosition * std::max({ farthest.x, farthest.y, farthest.z });
}

/**
 * Builds the tree from the root on. A part of the triangles is cut in two where the surface area
 * heuristic says that rays then meet the fewest boxes and triangles, over bins (Wald 2007, "On fast
 * Construction of SAH-based Bounding Volume Hierarchies"). A node's children come of cutting its
 * part, then the largest of what results, until there are four.
 */
void SurfaceTracer::Internals::BuildTree()
{
  if (this->Triangles.empty())
  {
    return;
  }
  this->Nodes.emplace_back();
  const auto all = static_cast<std::uint32_t>(this->Triangles.size());
  std::vector<std::pair<std::uint32_t, Part>> tasks = { { 0, this->MakePart(0, all, 0) } };
  while (!tasks.empty())
  {
    const auto [number, whole] = tasks.back();
    tasks.pop_back();
    const std::vector<Part> parts = this->Divide(whole);
    for (std::size_t k = 0; k < Width; ++k)
    {
      const Part part = k < parts.size() ? parts[k] : Part();
      Node& node = this->Nodes[number];
      for (int c = 0; c < 3; ++c)
      {
        const float slack = k < parts.size() ? BoxSlack : 0.0f;
        node.Bounds[0][c][k] = part.Bounds.Low[c] - slack;
        node.Bounds[1][c][k] = part.Bounds.High[c] + slack;
      }
      node.First[k] = part.Begin;
      node.Count[k] = part.IsLeaf ? part.End - part.Begin : 0;
      if (!part.IsLeaf)
      {
        node.First[k] = static_cast<std::uint32_t>(this->Nodes.size());
        tasks.emplace_back(node.First[k], part);
        this->Nodes.emplace_back();
      }
    }
  }
  this->Nodes.shrink_to_fit();
}

SurfaceTracer::Internals::Part SurfaceTracer::Internals::MakePart(
  std::uint32_t begin, std::uint32_t end, int depth) const
{
  Part part{ begin, end, depth, {}, {}, end - begin <= FewInLeaf };
  for (std::uint32_t k = begin; k < end; ++k)
  {
    const Box box = this->GetBox(this->Triangles[k]);
    part.Bounds.Add(box);
    part.Centers.Add({ box.GetCenter(), box.GetCenter() });
  }
  return part;
}

SurfaceTracer::Internals::Split SurfaceTracer::Internals::FindSplit(const Part& part) const
{
  std::array<std::array<Box, Bins>, 3> boxes;
  std::array<std::array<std::uint32_t, Bins>, 3> counts{};
  const Box& centers = part.Centers;
  for (std::uint32_t k = part.Begin; k < part.End; ++k)
  {
    const Box box = this->GetBox(this->Triangles[k]);
    const glm::vec3 center = box.GetCenter();
    for (int axis = 0; axis < 3; ++axis)
    {
      if (centers.High[axis] > centers.Low[axis])
      {
        const int bin = GetBin(center[axis], centers.Low[axis], centers.High[axis]);
        boxes[axis][bin].Add(box);
        ++counts[axis][bin];
      }
    }
  }
  const double area = std::max(part.Bounds.GetArea(), std::numeric_limits<double>::min());
  Split best;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<double, Bins> right{}; // cost of all bins from here on
    Box box;
    std::uint32_t count = 0;
    for (int bin = Bins; bin-- > 1;)
    {
      box.Add(boxes[axis][bin]);
      count += counts[axis][bin];
      right[bin] = count > 0 ? box.GetArea() * count : std::numeric_limits<double>::max();
    }
    box = Box();
    count = 0;
    for (int bin = 0; bin + 1 < Bins; ++bin)
    {
      box.Add(boxes[axis][bin]);
      count += counts[axis][bin];
      const double cost = TraversalCost + (box.GetArea() * count + right[bin + 1]) / area;
      if (count > 0 && cost < best.Cost)
      {
        best = { axis, bin, cost };
      }
    }
  }
  return best;
}

// Orders the part's triangles; returns where its second half begins, or its own begin where cutting
// it would make rays slower.
std::uint32_t SurfaceTracer::Internals::Cut(const Part& part)
{
  const std::uint32_t count = part.End - part.Begin;
  const Split split = part.Depth < DeepestByArea ? this->FindSplit(part) : Split();
  if (count <= MostInLeaf && (split.Axis < 0 || split.Cost >= static_cast<double>(count)))
  {
    return part.Begin;
  }
  const auto begin = this->Triangles.begin() + part.Begin;
  const auto end = this->Triangles.begin() + part.End;
  if (split.Axis >= 0)
  {
    const float low = part.Centers.Low[split.Axis];
    const float high = part.Centers.High[split.Axis];
    const auto middle = std::partition(begin, end,
      [&](const Triangle& triangle)
      { return GetBin(this->GetBox(triangle).GetCenter()[split.Axis], low, high) <= split.Bin; });
    return static_cast<std::uint32_t>(middle - this->Triangles.begin());
  }
  // Too deep, or all centers in one place: as many triangles on either side.
  const glm::vec3 size = part.Centers.High - part.Centers.Low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::nth_element(begin, begin + count / 2, end,
    [this, axis](const Triangle& a, const Triangle& b)
    { return this->GetBox(a).GetCenter()[axis] < this->GetBox(b).GetCenter()[axis]; });
  return part.Begin + count / 2;
}

std::vector<SurfaceTracer::Internals::Part> SurfaceTracer::Internals::Divide(const Part& whole)
{
  std::vector<Part> parts = { whole };
  while (parts.size() < Width)
  {
    const auto largest = std::max_element(parts.begin(), parts.end(),
      [](const Part& a, const Part& b)
      { return (a.IsLeaf ? -1.0 : a.Bounds.GetArea()) < (b.IsLeaf ? -1.0 : b.Bounds.GetArea()); });
    if (largest->IsLeaf)
    {
      break;
    }
    const Part part = *largest;
    const std::uint32_t middle = this->Cut(part);
    if (middle == part.Begin)
    {
      largest->IsLeaf = true;
      continue;
    }
    *largest = this->MakePart(part.Begin, middle, part.Depth + 1);
    parts.push_back(this->MakePart(middle, part.End, part.Depth + 1));
  }
  return parts;
}

std::int64_t SurfaceTracer::Internals::Trace(const double origin[3], const double direction[3],
  double tMin, double tMax, bool any, double& t, glm::dvec3& weights) const
{
  using Lanes = Eigen::Array<float, Width, 1>;
  using Load = Eigen::Map<const Lanes>;
  struct Waiting
  {
    std::uint32_t Node;
    float Enter;
  };
  Ray ray = { (glm::make_vec3(origin) - this->Middle) * this->Scale,
    glm::make_vec3(direction) * this->Scale, tMin, tMax };
  const double length = glm::length(ray.Direction);
  if (!IsWithinRange(ray.Origin) || !IsWithinRange(ray.Direction) || !(length > 0.0) ||
      !(tMin < tMax) || this->Nodes.empty())
  {
    return -1;
  }
  // For boxes, in single precision: the ray from where it enters the scene's box on, which is
  // precise enough there.
  const double slack = this->Offset * this->Scale;
  double near = tMin, far = tMax;
  for (int c = 0; c < 3; ++c)
  {
    const double d = ray.Direction[c];
    const double inverse = 1.0 / std::copysign(std::max(std::abs(d), 1e-250), d);
    const double a = (this->Low[c] - slack - ray.Origin[c]) * inverse;
    const double b = (this->High[c] + slack - ray.Origin[c]) * inverse;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  if (!(near <= far))
  {
    return -1;
  }
  const double shift = near > tMin ? near : 0.0; // t where it begins
  float from[3], inverse[3];                     // of the unit direction
  int side[3];                                   // which of a box's planes it meets first
  for (int c = 0; c < 3; ++c)
  {
    from[c] = static_cast<float>(ray.Origin[c] + shift * ray.Direction[c]);
    // Never 1/0: 0 times infinity is no number.
    const auto d = static_cast<float>(ray.Direction[c] / length);
    inverse[c] = 1.0f / std::copysign(std::max(std::abs(d), 1e-20f), d);
    side[c] = std::signbit(d) ? 1 : 0;
  }
  const float least = static_cast<float>((tMin - shift) * length) / EndSlack;
  const auto getEnd = [&]()
  {
    const double most = (ray.Most - shift) * length;
    return most < 0.5 * Largest ? static_cast<float>(most) * EndSlack + BoxSlack : Largest;
  };

  std::int64_t found = -1;
  float end = getEnd();
  std::array<Waiting, StackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = { 0, least };
  while (waiting > 0)
  {
    const Waiting next = stack[--waiting];
    if (next.Enter > end)
    {
      continue;
    }
    const Node& node = this->Nodes[next.Node];
    Lanes enter = Lanes::Constant(least);
    Lanes leave = Lanes::Constant(end);
    for (int c = 0; c < 3; ++c)
    {
      enter = enter.max((Load(node.Bounds[side[c]][c]) - from[c]) * inverse[c]);
      leave = leave.min((Load(node.Bounds[1 - side[c]][c]) - from[c]) * inverse[c]);
    }
    leave *= EndSlack;
    const std::size_t first = waiting;
    for (std::size_t k = 0; k < Width; ++k)
    {
      const float at = enter[static_cast<Eigen::Index>(k)];
      if (!(at <= leave[static_cast<Eigen::Index>(k)]))
      {
        continue;
      }
      if (node.Count[k] == 0) // the nearest one is the next
      {
        std::size_t place = waiting++;
        for (; place > first && stack[place - 1].Enter < at; --place)
        {
          stack[place] = stack[place - 1];
        }
        stack[place] = { node.First[k], at };
        continue;
      }
      for (std::uint32_t n = node.First[k]; n < node.First[k] + node.Count[k]; ++n)
      {
        double distance = 0.0;
        glm::dvec3 shares;
        if (this->Meets(this->Triangles[n], ray, distance, shares))
        {
          ray.Most = t = distance;
          weights = shares;
          found = n;
          if (any)
          {
            return found;
          }
        }
      }
    }
    end = found >= 0 ? getEnd() : end;
  }
  return found;
}

SurfaceTracer::SurfaceTracer()
  : Data(std::make_unique<Internals>())
{
}

SurfaceTracer::~SurfaceTracer() = default;

int SurfaceTracer::AddSurface(vtkPolyData* surface, const double* matrix16)
{
  return this->Data->Add(surface, matrix16);
}

void SurfaceTracer::Build()
{
  this->Data->Finish();
  this->Data->BuildTree();
}

bool SurfaceTracer::IsOccluded(
  const double origin[3], const double direction[3], double tMin, double tMax) const
{
  double t = 0.0;
  glm::dvec3 weights;
  return this->Data->Trace(origin, direction, tMin, tMax, true, t, weights) >= 0;
}

bool SurfaceTracer::Intersect(
  const double origin[3], const double direction[3], double tMin, double tMax, Hit& hit) const
{
  const Internals& set = *this->Data;
  glm::dvec3 weights;
  double t = 0.0;
  const std::int64_t found = set.Trace(origin, direction, tMin, tMax, false, t, weights);
  if (found < 0)
  {
    return false;
  }
  const Internals::Triangle& triangle = set.Triangles[static_cast<std::size_t>(found)];
  const auto after = std::upper_bound(set.Starts.begin(), set.Starts.end(), triangle.Corners[0],
    [](std::uint32_t corner, const Internals::Start& start) { return corner < start.Point; });
  const Internals::Start& start = *(after - 1);
  hit.T = t;
  hit.Surface = static_cast<int>(after - set.Starts.begin()) - 1;
  hit.Cell = static_cast<vtkIdType>(triangle.Cell - start.Cell);
  const glm::dvec3 normal = glm::normalize(set.GetNormal(triangle));
  for (int c = 0; c < 3; ++c)
  {
    hit.Points[c] = static_cast<vtkIdType>(triangle.Corners[c] - start.Point);
    hit.Barycentrics[c] = weights[c];
    hit.Normal[c] = normal[c];
  }
  return true;
}

void SurfaceTracer::GetCorners(const Hit& hit, glm::dvec3 corners[3]) const
{
  const Internals& set = *this->Data;
  const std::uint32_t start = set.Starts[static_cast<std::size_t>(hit.Surface)].Point;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 own = set.GetPoint(start + static_cast<std::uint32_t>(hit.Points[k]));
    corners[k] = set.Middle + own / set.Scale;
  }
}

void SurfaceTracer::OffsetOrigin(
  const double point[3], const double normal[3], const double direction[3], double origin[3]) const
{
  const glm::dvec3 n = glm::make_vec3(normal);
  const double side = std::copysign(this->GetOffset(), glm::dot(n, glm::make_vec3(direction)));
  for (int c = 0; c < 3; ++c)
  {
    origin[c] = point[c] + side * n[c];
  }
}

double SurfaceTracer::GetOffset() const { return this->Data->Offset; }

vtkIdType SurfaceTracer::GetNumberOfTriangles() const
{
  return static_cast<vtkIdType>(this->Data->Triangles.size());
}

vtkIdType SurfaceTracer::GetNumberOfSkippedTriangles() const { return this->Data->Skipped; }

std::size_t SurfaceTracer::GetBytes() const
{
  return this->Data->Points.capacity() * sizeof(glm::vec3) +
         this->Data->Triangles.capacity() * sizeof(Internals::Triangle) +
         this->Data->Nodes.capacity() * sizeof(Internals::Node);
}

bool SurfaceTracer::GetBounds(double bounds[6]) const
{
  const Internals& set = *this->Data;
  for (int c = 0; c < 3 && !set.Triangles.empty(); ++c)
  {
    bounds[2 * c] = set.Middle[c] + set.Low[c] / set.Scale;
    bounds[2 * c + 1] = set.Middle[c] + set.High[c] / set.Scale;
  }
  return !set.Triangles.empty();
}
} // namespace measuredbrdf
