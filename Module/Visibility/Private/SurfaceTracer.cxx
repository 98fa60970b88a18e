// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceTracer.h"

#include "SurfacePoints.h"
#include "vtkPolyData.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr std::uint64_t MostElements = std::numeric_limits<std::uint32_t>::max() - 1u;

// SurfaceTracer::GetOffset states the rule.
constexpr double OffsetOfExtent = 0x1p-20;
constexpr double OffsetOfPosition = 0x1p-48;

constexpr int Bins = 16;
constexpr std::uint32_t MostInLeaf = 8;
constexpr std::uint32_t FewInLeaf = 2; // these stay together whatever it costs
constexpr double TraversalCost = 1.0;  // of a node, in triangle tests
// Below this depth parts are halved by number, so the whole tree is less deep than the stack.
constexpr int DeepestByArea = 60;

// Boxes are entered and left in single precision. Coordinates are at most about 1, so planes that
// are this far outside of the triangles, and ends this much later, miss no box whose triangle the
// ray meets.
constexpr float BoxSlack = 0x1p-21f;
constexpr float EndSlack = 1.0f + 0x1p-21f;

constexpr float LargestFloat = std::numeric_limits<float>::max();

bool IsWithinRange(const glm::dvec3& v) { return std::isfinite(glm::dot(v, v)); }

double GetLargest(const glm::dvec3& v) { return std::max({ v.x, v.y, v.z }); }
}

/**
 * Builds the tree from the root on. A part of the triangles is cut in two where the surface area
 * heuristic says that rays then meet the fewest boxes and triangles, over bins along the longest
 * extent of their centers (Wald 2007, "On fast Construction of SAH-based Bounding Volume
 * Hierarchies"). A node's children come of cutting its part, then the largest of what results,
 * until there are four.
 */
class SurfaceTracer::Builder
{
public:
  explicit Builder(SurfaceTracer& tracer)
    : Points(tracer.Points)
    , Triangles(tracer.Triangles)
  {
    std::vector<Node>& nodes = tracer.Nodes;
    nodes.emplace_back();
    std::vector<std::pair<std::size_t, Part>> tasks = { { 0,
      this->MakePart(0, static_cast<std::uint32_t>(this->Triangles.size()), 0) } };
    while (!tasks.empty())
    {
      const auto [number, whole] = tasks.back();
      tasks.pop_back();
      const std::vector<Part> parts = this->Divide(whole);
      for (std::size_t k = 0; k < Width; ++k)
      {
        const Part part = k < parts.size() ? parts[k] : Part();
        const float slack = k < parts.size() ? BoxSlack : 0.0f;
        Node& node = nodes[number];
        for (int c = 0; c < 3; ++c)
        {
          node.Bounds[0][c][k] = part.Bounds.Low[c] - slack;
          node.Bounds[1][c][k] = part.Bounds.High[c] + slack;
        }
        node.First[k] = part.IsLeaf ? part.Begin : static_cast<std::uint32_t>(nodes.size());
        node.Count[k] = part.IsLeaf ? part.End - part.Begin : 0;
        if (!part.IsLeaf)
        {
          tasks.emplace_back(nodes.size(), part);
          nodes.emplace_back();
        }
      }
    }
    nodes.shrink_to_fit();
  }

private:
  struct Box
  {
    glm::vec3 Low = glm::vec3(LargestFloat);
    glm::vec3 High = glm::vec3(-LargestFloat);

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

  /// Some of the triangles.
  struct Part
  {
    std::uint32_t Begin = 0;
    std::uint32_t End = 0;
    int Depth = 0; // how often the whole was cut for it
    Box Bounds;
    Box Centers;
    bool IsLeaf = true; // it is not to be cut
  };

  Box GetBox(const Triangle& triangle) const
  {
    Box box;
    for (const std::uint32_t corner : triangle.Corners)
    {
      box.Add({ this->Points[corner], this->Points[corner] });
    }
    return box;
  }

  Part MakePart(std::uint32_t begin, std::uint32_t end, int depth) const
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

  // Orders the part's triangles; returns where its second half begins, or its own begin where
  // cutting it would make rays slower.
  std::uint32_t Cut(const Part& part)
  {
    const std::uint32_t count = part.End - part.Begin;
    const auto begin = this->Triangles.begin() + part.Begin;
    const auto end = this->Triangles.begin() + part.End;
    const glm::vec3 size = part.Centers.High - part.Centers.Low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto getPlace = [&](const Triangle& triangle)
    { return this->GetBox(triangle).GetCenter()[axis] - part.Centers.Low[axis]; };
    if (part.Depth >= DeepestByArea || !(size[axis] > 0.0f))
    {
      // Too deep, or all centers in one place: as many triangles on either side.
      const std::uint32_t half = count > MostInLeaf ? count / 2 : 0;
      std::nth_element(begin, begin + half, end,
        [&](const Triangle& a, const Triangle& b) { return getPlace(a) < getPlace(b); });
      return part.Begin + half;
    }
    const auto getBin = [&](const Triangle& triangle)
    { return std::min(static_cast<int>(Bins * (getPlace(triangle) / size[axis])), Bins - 1); };
    std::array<Box, Bins> boxes;
    std::array<std::uint32_t, Bins> counts{};
    for (auto triangle = begin; triangle != end; ++triangle)
    {
      boxes[getBin(*triangle)].Add(this->GetBox(*triangle));
      ++counts[getBin(*triangle)];
    }
    std::array<double, Bins> right{}; // cost of all bins from here on
    Box box;
    std::uint32_t sum = 0;
    for (int bin = Bins; bin-- > 1;)
    {
      box.Add(boxes[bin]);
      sum += counts[bin];
      right[bin] = sum > 0 ? box.GetArea() * sum : HUGE_VAL;
    }
    box = Box();
    sum = 0;
    const double area = std::max(part.Bounds.GetArea(), std::numeric_limits<double>::min());
    double least = HUGE_VAL;
    int last = 0; // of the first half
    for (int bin = 0; bin + 1 < Bins; ++bin)
    {
      box.Add(boxes[bin]);
      sum += counts[bin];
      const double cost = TraversalCost + (box.GetArea() * sum + right[bin + 1]) / area;
      if (sum > 0 && cost < least)
      {
        least = cost;
        last = bin;
      }
    }
    if (count <= MostInLeaf && least >= count)
    {
      return part.Begin;
    }
    const auto middle = std::partition(
      begin, end, [&](const Triangle& triangle) { return getBin(triangle) <= last; });
    return static_cast<std::uint32_t>(middle - this->Triangles.begin());
  }

  std::vector<Part> Divide(const Part& whole)
  {
    const auto getSize = [](const Part& part)
    { return part.IsLeaf ? -1.0 : part.Bounds.GetArea(); };
    std::vector<Part> parts = { whole };
    while (parts.size() < Width)
    {
      const auto largest = std::max_element(parts.begin(), parts.end(),
        [&](const Part& a, const Part& b) { return getSize(a) < getSize(b); });
      if (largest->IsLeaf)
      {
        break;
      }
      const Part part = *largest;
      const std::uint32_t middle = this->Cut(part);
      largest->IsLeaf = middle == part.Begin;
      if (!largest->IsLeaf)
      {
        *largest = this->MakePart(part.Begin, middle, part.Depth + 1);
        parts.push_back(this->MakePart(middle, part.End, part.Depth + 1));
      }
    }
    return parts;
  }

  const std::vector<glm::vec3>& Points;
  std::vector<Triangle>& Triangles;
};

glm::dvec3 SurfaceTracer::GetNormal(const Triangle& triangle) const
{
  const glm::dvec3 a = this->GetPoint(triangle.Corners[0]);
  return glm::cross(
    this->GetPoint(triangle.Corners[1]) - a, this->GetPoint(triangle.Corners[2]) - a);
}

int SurfaceTracer::AddSurface(vtkPolyData* surface, const double* m)
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

// To single precision about the middle, and without triangles of no area.
void SurfaceTracer::Build()
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
  const double longest = GetLargest(half);
  int exponent = 0;
  std::frexp(longest, &exponent);
  this->Scale = longest > 0.0 ? std::ldexp(1.0, -exponent) : 1.0;
  this->Points.reserve(this->Positions.size());
  for (const glm::dvec3& position : this->Positions)
  {
    const glm::dvec3 own = (position - this->Middle) * this->Scale;
    // Points that no triangle uses may be anywhere.
    this->Points.push_back(GetLargest(glm::abs(own)) <= 1.0 ? glm::vec3(own) : glm::vec3(0.0f));
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
  this->Offset =
    OffsetOfExtent * longest + OffsetOfPosition * GetLargest(glm::abs(this->Middle) + half);
  if (!this->Triangles.empty())
  {
    Builder(*this);
  }
}

// Whether the ray meets the triangle before its nearest hit, which that then is. By edge functions
// (Pluecker coordinates): exactly opposite for the two triangles at an edge, so that no ray passes
// between them. In double precision.
bool SurfaceTracer::Meets(const Triangle& triangle, Ray& ray) const
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
  const double t = glm::dot(normal, a) / slope;
  if (sum == 0.0 || slope == 0.0 || !(t > 0.0 && t < ray.Most))
  {
    return false;
  }
  ray.Most = t;
  ray.Shares = glm::dvec3(u, v, w) / sum;
  return true;
}

// The triangle of the nearest hit, or with `any` of the first one found; null: none. ray: has the
// farthest t, and becomes the ray at the hit.
const SurfaceTracer::Triangle* SurfaceTracer::Trace(
  const glm::dvec3& origin, const glm::dvec3& direction, bool any, Ray& ray) const
{
  using Lanes = Eigen::Array<float, Width, 1>;
  using Load = Eigen::Map<const Lanes>;
  struct Waiting
  {
    std::uint32_t Node;
    float Enter;
  };
  ray.Origin = (origin - this->Middle) * this->Scale;
  ray.Direction = direction * this->Scale;
  const double length = glm::length(ray.Direction);
  if (!IsWithinRange(ray.Origin) || !IsWithinRange(ray.Direction) || !(length > 0.0) ||
      !(ray.Most > 0.0) || this->Nodes.empty())
  {
    return nullptr;
  }
  // For boxes, in single precision: the ray from where it enters the scene's box on, which is
  // precise enough there.
  const double slack = this->Offset * this->Scale;
  double near = 0.0, far = ray.Most;
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
    return nullptr;
  }
  float from[3], inverse[3]; // of the unit direction
  int side[3];               // which of a box's planes it meets first
  for (int c = 0; c < 3; ++c)
  {
    from[c] = static_cast<float>(ray.Origin[c] + near * ray.Direction[c]);
    // Never 1/0: 0 times infinity is no number.
    const auto d = static_cast<float>(ray.Direction[c] / length);
    inverse[c] = 1.0f / std::copysign(std::max(std::abs(d), 1e-20f), d);
    side[c] = std::signbit(d) ? 1 : 0;
  }
  const float least = static_cast<float>(-near * length) / EndSlack;
  const auto getEnd = [&]()
  {
    const double most = (ray.Most - near) * length;
    return most < 0.5 * LargestFloat ? static_cast<float>(most) * EndSlack + BoxSlack
                                     : LargestFloat;
  };

  const Triangle* found = nullptr;
  float end = getEnd();
  std::array<Waiting, (Width - 1) * (DeepestByArea + 34) + Width> stack;
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
      }
      for (std::uint32_t n = node.First[k]; n < node.First[k] + node.Count[k]; ++n)
      {
        found = this->Meets(this->Triangles[n], ray) ? &this->Triangles[n] : found;
        if (found && any)
        {
          return found;
        }
      }
    }
    end = found ? getEnd() : end;
  }
  return found;
}

bool SurfaceTracer::IsOccluded(
  const glm::dvec3& origin, const glm::dvec3& direction, double farthest) const
{
  Ray ray = { {}, {}, farthest };
  return this->Trace(origin, direction, true, ray) != nullptr;
}

std::optional<SurfaceTracer::Hit> SurfaceTracer::Intersect(
  const glm::dvec3& origin, const glm::dvec3& direction, double farthest) const
{
  Ray ray = { {}, {}, farthest };
  const Triangle* triangle = this->Trace(origin, direction, false, ray);
  if (!triangle)
  {
    return std::nullopt;
  }
  const auto after =
    std::upper_bound(this->Starts.begin(), this->Starts.end(), triangle->Corners[0],
      [](std::uint32_t corner, const Start& start) { return corner < start.Point; });
  const Start& start = *(after - 1);
  Hit hit;
  hit.T = ray.Most;
  hit.Surface = static_cast<int>(after - this->Starts.begin()) - 1;
  hit.Cell = static_cast<vtkIdType>(triangle->Cell - start.Cell);
  hit.Barycentrics = ray.Shares;
  hit.Normal = glm::normalize(this->GetNormal(*triangle));
  for (int c = 0; c < 3; ++c)
  {
    hit.Points[c] = static_cast<vtkIdType>(triangle->Corners[c] - start.Point);
    hit.Corners[c] = this->Middle + this->GetPoint(triangle->Corners[c]) / this->Scale;
  }
  return hit;
}

bool SurfaceTracer::GetBounds(double bounds[6]) const
{
  for (int c = 0; c < 3 && !this->Triangles.empty(); ++c)
  {
    bounds[2 * c] = this->Middle[c] + this->Low[c] / this->Scale;
    bounds[2 * c + 1] = this->Middle[c] + this->High[c] / this->Scale;
  }
  return !this->Triangles.empty();
}
} // namespace measuredbrdf
