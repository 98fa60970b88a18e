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
#include <vector>

namespace measuredbrdf
{
namespace tracing // SurfaceTracer::Internals has members of these types
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

struct Box
{
  glm::vec3 Low = glm::vec3(Largest);
  glm::vec3 High = glm::vec3(-Largest);

  void Add(const Box& other)
  {
    this->Low = glm::min(this->Low, other.Low);
    this->High = glm::max(this->High, other.High);
  }
  void Add(const glm::vec3& point)
  {
    this->Low = glm::min(this->Low, point);
    this->High = glm::max(this->High, point);
  }
  double GetArea() const // half of it
  {
    const glm::dvec3 size = glm::dvec3(this->High) - glm::dvec3(this->Low);
    return size.x < 0.0 ? 0.0 : size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

/// 16 bytes. Corners count over all surfaces' points, cells over all surfaces' cells.
struct Triangle
{
  std::uint32_t Corners[3];
  std::uint32_t Cell;
};

/// A ray in own coordinates; t is as in those of the scene.
struct Ray
{
  glm::dvec3 Origin;
  glm::dvec3 Direction;
  double Least;
  double Most; // t, of the nearest hit so far
};

/// Four boxes, each with a node below it or a run of triangles. Absent children have boxes that no
/// ray meets.
struct Node
{
  float Bounds[2][3][Width]; // low and high of x, y, z
  std::uint32_t First[Width];
  std::uint32_t Count[Width]; // of triangles from First on; 0: First is a node
};

/// The triangles of several surfaces, in single precision about the middle of the scene.
struct TriangleSet
{
  /// Where a surface's points and cells begin in the counts over all surfaces.
  struct Start
  {
    std::uint32_t Point;
    std::uint32_t Cell;
  };
  std::vector<Start> Starts;
  std::vector<double> Positions; // until Finish
  std::vector<float> Points;     // x, y, z in own coordinates
  std::vector<Triangle> Triangles;
  std::uint64_t Cells = 0;
  vtkIdType Skipped = 0;

  /// Own coordinates: (position - Middle) * Scale, a power of two. All lie in [-1,1], whatever the
  /// unit of length, so products of single precision numbers neither overflow nor vanish.
  glm::dvec3 Middle = glm::dvec3(0.0);
  double Scale = 1.0;
  glm::dvec3 Low = glm::dvec3(0.0); // of all triangles
  glm::dvec3 High = glm::dvec3(0.0);
  double Offset = 0.0;

  glm::dvec3 GetPoint(std::uint32_t corner) const
  {
    const float* p = &this->Points[3 * static_cast<std::size_t>(corner)];
    return glm::dvec3(p[0], p[1], p[2]);
  }

  int Add(vtkPolyData* surface, const double* matrix16);
  void Finish();

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
};

int TriangleSet::Add(vtkPolyData* surface, const double* m)
{
  const std::uint64_t points = this->Positions.size() / 3;
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
    for (int c = 0; c < 3; ++c)
    {
      this->Positions.push_back(
        m ? m[4 * c] * p.x + m[4 * c + 1] * p.y + m[4 * c + 2] * p.z + m[4 * c + 3] : p[c]);
    }
  }
  this->Skipped += ForEachFace(surface, Faces::Triangles,
    [&](const vtkIdType* corners, vtkIdType, vtkIdType cell)
    {
      Triangle triangle;
      triangle.Cell = start.Cell + static_cast<std::uint32_t>(cell);
      bool isFinite = true;
      for (int c = 0; c < 3; ++c)
      {
        triangle.Corners[c] = start.Point + static_cast<std::uint32_t>(corners[c]);
        const double* p = &this->Positions[3 * static_cast<std::size_t>(triangle.Corners[c])];
        isFinite = isFinite && std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
      }
      if (isFinite)
      {
        this->Triangles.push_back(triangle);
      }
      else
      {
        ++this->Skipped;
      }
    });
  this->Cells += static_cast<std::uint64_t>(surface->GetNumberOfCells());
  return static_cast<int>(this->Starts.size()) - 1;
}

// After the last surface: to single precision about the middle, and without triangles of no area.
void TriangleSet::Finish()
{
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(-low);
  for (const Triangle& triangle : this->Triangles)
  {
    for (const std::uint32_t corner : triangle.Corners)
    {
      const glm::dvec3 p = glm::make_vec3(&this->Positions[3 * static_cast<std::size_t>(corner)]);
      low = glm::min(low, p);
      high = glm::max(high, p);
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
  this->Points.resize(this->Positions.size());
  for (std::size_t k = 0; k < this->Positions.size(); ++k)
  {
    const double value = (this->Positions[k] - this->Middle[static_cast<int>(k % 3)]) * this->Scale;
    // Points that no triangle uses may be anywhere.
    this->Points[k] = std::abs(value) <= 1.0 ? static_cast<float>(value) : 0.0f;
  }
  std::vector<double>().swap(this->Positions);

  const auto hasNoArea = [this](const Triangle& triangle)
  {
    const glm::dvec3 a = this->GetPoint(triangle.Corners[0]);
    const glm::dvec3 normal =
      glm::cross(this->GetPoint(triangle.Corners[1]) - a, this->GetPoint(triangle.Corners[2]) - a);
    const double area = glm::length(normal);
    return !(area > 0.0) || !std::isfinite(area);
  };
  const auto last = std::remove_if(this->Triangles.begin(), this->Triangles.end(), hasNoArea);
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
class TreeBuilder
{
public:
  TreeBuilder(TriangleSet& set, std::vector<Node>& nodes)
    : Set(set)
    , Triangles(set.Triangles)
    , Nodes(nodes)
  {
  }

  void Run()
  {
    this->Nodes.clear();
    if (this->Triangles.empty())
    {
      return;
    }
    struct Task
    {
      std::uint32_t Node;
      Part Whole;
    };
    this->Nodes.emplace_back();
    std::vector<Task> tasks = { { 0,
      this->MakePart(0, static_cast<std::uint32_t>(this->Triangles.size()), 0) } };
    while (!tasks.empty())
    {
      const Task task = tasks.back();
      tasks.pop_back();
      const std::vector<Part> parts = this->Divide(task.Whole);
      for (std::size_t k = 0; k < Width; ++k)
      {
        const Part part = k < parts.size() ? parts[k] : Part();
        Node& node = this->Nodes[task.Node];
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
          tasks.push_back({ node.First[k], part });
          this->Nodes.emplace_back();
        }
      }
    }
    this->Nodes.shrink_to_fit();
  }

private:
  struct Part
  {
    std::uint32_t Begin = 0;
    std::uint32_t End = 0;
    int Depth = 0; // how often the whole was cut for it
    Box Bounds;
    Box Centers;
    bool IsLeaf = true; // it is not to be cut
  };
  struct Split
  {
    int Axis = -1;
    int Bin = 0; // the last one on the left
    double Cost = std::numeric_limits<double>::max();
  };

  Box GetBox(const Triangle& triangle) const
  {
    Box box;
    for (const std::uint32_t corner : triangle.Corners)
    {
      box.Add(glm::make_vec3(&this->Set.Points[3 * static_cast<std::size_t>(corner)]));
    }
    return box;
  }
  static float GetCenter(const Box& box, int axis)
  {
    return 0.5f * box.Low[axis] + 0.5f * box.High[axis];
  }
  static int GetBin(float center, float low, float high)
  {
    return std::min(static_cast<int>(Bins * ((center - low) / (high - low))), Bins - 1);
  }
  auto At(std::uint32_t k) const
  {
    return this->Triangles.begin() + static_cast<std::ptrdiff_t>(k);
  }

  Part MakePart(std::uint32_t begin, std::uint32_t end, int depth) const
  {
    Part part{ begin, end, depth, {}, {}, end - begin <= FewInLeaf };
    for (std::uint32_t k = begin; k < end; ++k)
    {
      const Box box = this->GetBox(this->Triangles[k]);
      part.Bounds.Add(box);
      part.Centers.Add(glm::vec3(GetCenter(box, 0), GetCenter(box, 1), GetCenter(box, 2)));
    }
    return part;
  }

  Split FindSplit(const Part& part) const;
  std::uint32_t Cut(const Part& part) const;
  std::vector<Part> Divide(const Part& whole) const;

  TriangleSet& Set;
  std::vector<Triangle>& Triangles;
  std::vector<Node>& Nodes;
};

TreeBuilder::Split TreeBuilder::FindSplit(const Part& part) const
{
  std::array<std::array<Box, Bins>, 3> boxes;
  std::array<std::array<std::uint32_t, Bins>, 3> counts{};
  const Box& centers = part.Centers;
  for (std::uint32_t k = part.Begin; k < part.End; ++k)
  {
    const Box box = this->GetBox(this->Triangles[k]);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (centers.High[axis] > centers.Low[axis])
      {
        const auto bin = static_cast<std::size_t>(
          GetBin(GetCenter(box, axis), centers.Low[axis], centers.High[axis]));
        boxes[static_cast<std::size_t>(axis)][bin].Add(box);
        ++counts[static_cast<std::size_t>(axis)][bin];
      }
    }
  }
  const double area = std::max(part.Bounds.GetArea(), std::numeric_limits<double>::min());
  Split best;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::array<double, Bins> right{}; // cost of all bins from here on
    Box box;
    std::uint32_t count = 0;
    for (std::size_t bin = Bins; bin-- > 1;)
    {
      box.Add(boxes[axis][bin]);
      count += counts[axis][bin];
      right[bin] = count > 0 ? box.GetArea() * count : std::numeric_limits<double>::max();
    }
    box = Box();
    count = 0;
    for (std::size_t bin = 0; bin + 1 < Bins; ++bin)
    {
      box.Add(boxes[axis][bin]);
      count += counts[axis][bin];
      const double cost = TraversalCost + (box.GetArea() * count + right[bin + 1]) / area;
      if (count > 0 && cost < best.Cost)
      {
        best = { static_cast<int>(axis), static_cast<int>(bin), cost };
      }
    }
  }
  return best;
}

// Orders the part's triangles; returns where its second half begins, or its own begin where cutting
// it would make rays slower.
std::uint32_t TreeBuilder::Cut(const Part& part) const
{
  const std::uint32_t count = part.End - part.Begin;
  const Split split = part.Depth < DeepestByArea ? this->FindSplit(part) : Split();
  if (count <= MostInLeaf && (split.Axis < 0 || split.Cost >= static_cast<double>(count)))
  {
    return part.Begin;
  }
  if (split.Axis >= 0)
  {
    const float low = part.Centers.Low[split.Axis];
    const float high = part.Centers.High[split.Axis];
    const auto middle = std::partition(this->At(part.Begin), this->At(part.End),
      [&](const Triangle& triangle)
      { return GetBin(GetCenter(this->GetBox(triangle), split.Axis), low, high) <= split.Bin; });
    return static_cast<std::uint32_t>(middle - this->Triangles.begin());
  }
  // Too deep, or all centers in one place: as many triangles on either side.
  const glm::vec3 size = part.Centers.High - part.Centers.Low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = part.Begin + count / 2;
  std::nth_element(this->At(part.Begin), this->At(middle), this->At(part.End),
    [this, axis](const Triangle& a, const Triangle& b)
    { return GetCenter(this->GetBox(a), axis) < GetCenter(this->GetBox(b), axis); });
  return middle;
}

std::vector<TreeBuilder::Part> TreeBuilder::Divide(const Part& whole) const
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

/// A ray in single precision, for boxes. It begins near the scene, where that is precise enough.
struct NearRay
{
  bool Meets = false; // the scene's box
  double Shift = 0.0; // t where it begins
  double Length = 1.0;
  float Origin[3];
  float Inverse[3]; // of the unit direction
  int Side[3];      // which of a box's planes it meets first
  float Least;

  NearRay(const TriangleSet& set, const Ray& ray)
  {
    double near = ray.Least;
    double far = ray.Most;
    const double slack = set.Offset * set.Scale;
    this->Length = glm::length(ray.Direction);
    for (int c = 0; c < 3; ++c)
    {
      const double d = ray.Direction[c];
      const double inverse = 1.0 / std::copysign(std::max(std::abs(d), 1e-250), d);
      const double a = (set.Low[c] - slack - ray.Origin[c]) * inverse;
      const double b = (set.High[c] + slack - ray.Origin[c]) * inverse;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    this->Meets = near <= far;
    this->Shift = near > ray.Least ? near : 0.0;
    for (int c = 0; c < 3; ++c)
    {
      this->Origin[c] = static_cast<float>(ray.Origin[c] + this->Shift * ray.Direction[c]);
      // Never 1/0: 0 times infinity is no number.
      const auto d = static_cast<float>(ray.Direction[c] / this->Length);
      this->Inverse[c] = 1.0f / std::copysign(std::max(std::abs(d), 1e-20f), d);
      this->Side[c] = std::signbit(d) ? 1 : 0;
    }
    this->Least = static_cast<float>((ray.Least - this->Shift) * this->Length) / EndSlack;
  }

  float GetEnd(const Ray& ray) const
  {
    const double most = (ray.Most - this->Shift) * this->Length;
    return most < 0.5 * Largest ? static_cast<float>(most) * EndSlack + BoxSlack : Largest;
  }
};
} // namespace tracing

using namespace tracing;

struct SurfaceTracer::Internals : TriangleSet
{
  std::vector<Node> Nodes;

  // Whether the ray is one at all.
  bool MakeRay(
    const double origin[3], const double direction[3], double tMin, double tMax, Ray& ray) const
  {
    ray = { (glm::make_vec3(origin) - this->Middle) * this->Scale,
      glm::make_vec3(direction) * this->Scale, tMin, tMax };
    const double length = glm::dot(ray.Direction, ray.Direction);
    return std::isfinite(glm::dot(ray.Origin, ray.Origin)) && std::isfinite(length) &&
           length > 0.0 && tMin < tMax;
  }

  // The nearest hit, or with `any` the first one found; its triangle's index, or -1.
  std::int64_t Trace(Ray ray, bool any, double& t, glm::dvec3& weights) const;
};

std::int64_t SurfaceTracer::Internals::Trace(
  Ray ray, bool any, double& t, glm::dvec3& weights) const
{
  using Lanes = Eigen::Array<float, Width, 1>;
  using Load = Eigen::Map<const Lanes>;
  struct Waiting
  {
    std::uint32_t Node;
    float Enter;
  };
  const NearRay near(*this, ray);
  std::int64_t found = -1;
  if (this->Nodes.empty() || !near.Meets)
  {
    return found;
  }
  float end = near.GetEnd(ray);
  std::array<Waiting, StackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = { 0, near.Least };
  while (waiting > 0)
  {
    const Waiting next = stack[--waiting];
    if (next.Enter > end)
    {
      continue;
    }
    const Node& node = this->Nodes[next.Node];
    Lanes enter = Lanes::Constant(near.Least);
    Lanes leave = Lanes::Constant(end);
    for (int c = 0; c < 3; ++c)
    {
      const int side = near.Side[c];
      enter = enter.max((Load(node.Bounds[side][c]) - near.Origin[c]) * near.Inverse[c]);
      leave = leave.min((Load(node.Bounds[1 - side][c]) - near.Origin[c]) * near.Inverse[c]);
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
    end = found >= 0 ? near.GetEnd(ray) : end;
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
  TreeBuilder(*this->Data, this->Data->Nodes).Run();
}

bool SurfaceTracer::IsOccluded(
  const double origin[3], const double direction[3], double tMin, double tMax) const
{
  Ray ray;
  double t = 0.0;
  glm::dvec3 weights;
  return this->Data->MakeRay(origin, direction, tMin, tMax, ray) &&
         this->Data->Trace(ray, true, t, weights) >= 0;
}

bool SurfaceTracer::Intersect(
  const double origin[3], const double direction[3], double tMin, double tMax, Hit& hit) const
{
  const Internals& set = *this->Data;
  Ray ray;
  glm::dvec3 weights;
  double t = 0.0;
  const std::int64_t found =
    set.MakeRay(origin, direction, tMin, tMax, ray) ? set.Trace(ray, false, t, weights) : -1;
  if (found < 0)
  {
    return false;
  }
  const Triangle& triangle = set.Triangles[static_cast<std::size_t>(found)];
  const auto after = std::upper_bound(set.Starts.begin(), set.Starts.end(), triangle.Corners[0],
    [](std::uint32_t corner, const TriangleSet::Start& start) { return corner < start.Point; });
  const TriangleSet::Start& start = *(after - 1);
  hit.T = t;
  hit.Surface = static_cast<int>(after - set.Starts.begin()) - 1;
  hit.Cell = static_cast<vtkIdType>(triangle.Cell - start.Cell);
  const glm::dvec3 a = set.GetPoint(triangle.Corners[0]);
  const glm::dvec3 normal = glm::normalize(
    glm::cross(set.GetPoint(triangle.Corners[1]) - a, set.GetPoint(triangle.Corners[2]) - a));
  for (int c = 0; c < 3; ++c)
  {
    hit.Points[c] = static_cast<vtkIdType>(triangle.Corners[c] - start.Point);
    hit.Barycentrics[c] = weights[c];
    hit.Normal[c] = normal[c];
  }
  return true;
}

void SurfaceTracer::GetCorners(const Hit& hit, double corners[3][3]) const
{
  const Internals& set = *this->Data;
  const std::uint32_t start = set.Starts[static_cast<std::size_t>(hit.Surface)].Point;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 own = set.GetPoint(start + static_cast<std::uint32_t>(hit.Points[k]));
    for (int c = 0; c < 3; ++c)
    {
      corners[k][c] = set.Middle[c] + own[c] / set.Scale;
    }
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
  return this->Data->Points.capacity() * sizeof(float) +
         this->Data->Triangles.capacity() * sizeof(Triangle) +
         this->Data->Nodes.capacity() * sizeof(Node);
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
