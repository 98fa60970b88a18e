// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace measuredbrdf
{
namespace
{
constexpr int Bins = 16;
constexpr std::uint32_t MostInLeaf = 8;
constexpr std::uint32_t FewInLeaf = 2; // these stay together whatever it costs
constexpr double TraversalCost = 1.0;  // of a node, in triangle tests
// Below this depth nodes are halved by number, so the whole tree is less deep than the stack.
constexpr int DeepestByArea = 60;
constexpr int StackSize = DeepestByArea + 34;
// Rounding of a slab's distance, so that no box is missed whose triangle is met (Ize 2013).
constexpr double SlabSlack = 1.0 + 0x1p-48;

struct Box
{
  glm::vec3 Low = glm::vec3(std::numeric_limits<float>::max());
  glm::vec3 High = glm::vec3(-std::numeric_limits<float>::max());

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
} // namespace

//------------------------------------------------------------------------------
class TriangleTree::Builder
{
public:
  Builder(TriangleSet& set, std::vector<Node>& nodes)
    : Set(set)
    , Triangles(set.GetTriangles())
    , Nodes(nodes)
  {
  }
  void Run();

private:
  using Iterator = std::vector<TriangleSet::Triangle>::iterator;
  struct Task
  {
    std::uint32_t Node;
    std::uint32_t Begin;
    std::uint32_t End;
    int Depth;
  };
  struct Split
  {
    int Axis = -1;
    int Bin = 0; // the last one on the left
    double Cost = std::numeric_limits<double>::max();
  };

  Box GetBox(const TriangleSet::Triangle& triangle) const
  {
    Box box;
    for (const std::uint32_t corner : triangle.Corners)
    {
      box.Add(glm::vec3(this->Set.GetPoint(corner)));
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
  Split FindSplit(const Task& task, const Box& centers, double area) const;
  std::uint32_t Divide(const Task& task, const Box& centers, const Box& box);
  std::uint32_t Halve(const Task& task, const Box& centers);

  TriangleSet& Set;
  std::vector<TriangleSet::Triangle>& Triangles;
  std::vector<Node>& Nodes;
};

//------------------------------------------------------------------------------
TriangleTree::Builder::Split TriangleTree::Builder::FindSplit(
  const Task& task, const Box& centers, double area) const
{
  std::array<std::array<Box, Bins>, 3> boxes;
  std::array<std::array<std::uint32_t, Bins>, 3> counts{};
  for (std::uint32_t k = task.Begin; k < task.End; ++k)
  {
    const Box box = this->GetBox(this->Triangles[k]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int a = static_cast<int>(axis);
      if (centers.High[a] > centers.Low[a])
      {
        const auto bin =
          static_cast<std::size_t>(GetBin(GetCenter(box, a), centers.Low[a], centers.High[a]));
        boxes[axis][bin].Add(box);
        ++counts[axis][bin];
      }
    }
  }
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

//------------------------------------------------------------------------------
std::uint32_t TriangleTree::Builder::Halve(const Task& task, const Box& centers)
{
  const glm::vec3 size = centers.High - centers.Low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = task.Begin + (task.End - task.Begin) / 2;
  const auto at = [this](std::uint32_t k)
  { return this->Triangles.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(task.Begin), at(middle), at(task.End),
    [this, axis](const TriangleSet::Triangle& a, const TriangleSet::Triangle& b)
    { return GetCenter(this->GetBox(a), axis) < GetCenter(this->GetBox(b), axis); });
  return middle;
}

//------------------------------------------------------------------------------
// Where the right part begins; task.Begin: this is a leaf.
std::uint32_t TriangleTree::Builder::Divide(const Task& task, const Box& centers, const Box& box)
{
  const std::uint32_t count = task.End - task.Begin;
  if (count <= FewInLeaf)
  {
    return task.Begin;
  }
  const double area = std::max(box.GetArea(), std::numeric_limits<double>::min());
  const Split split = task.Depth < DeepestByArea ? this->FindSplit(task, centers, area) : Split();
  if (count <= MostInLeaf && (split.Axis < 0 || split.Cost >= static_cast<double>(count)))
  {
    return task.Begin;
  }
  if (split.Axis < 0) // too deep, or all centers in one place
  {
    return this->Halve(task, centers);
  }
  const float low = centers.Low[split.Axis];
  const float high = centers.High[split.Axis];
  const auto at = [this](std::uint32_t k)
  { return this->Triangles.begin() + static_cast<std::ptrdiff_t>(k); };
  const Iterator middle = std::partition(at(task.Begin), at(task.End),
    [&](const TriangleSet::Triangle& triangle)
    { return GetBin(GetCenter(this->GetBox(triangle), split.Axis), low, high) <= split.Bin; });
  return static_cast<std::uint32_t>(middle - this->Triangles.begin());
}

//------------------------------------------------------------------------------
void TriangleTree::Builder::Run()
{
  this->Nodes.clear();
  if (this->Triangles.empty())
  {
    return;
  }
  this->Nodes.emplace_back();
  std::vector<Task> tasks = { { 0, 0, static_cast<std::uint32_t>(this->Triangles.size()), 0 } };
  while (!tasks.empty())
  {
    const Task task = tasks.back();
    tasks.pop_back();
    Box box;
    Box centers;
    for (std::uint32_t k = task.Begin; k < task.End; ++k)
    {
      const Box own = this->GetBox(this->Triangles[k]);
      box.Add(own);
      centers.Add(glm::vec3(GetCenter(own, 0), GetCenter(own, 1), GetCenter(own, 2)));
    }
    const std::uint32_t middle = this->Divide(task, centers, box);
    const auto children = static_cast<std::uint32_t>(this->Nodes.size());
    Node& node = this->Nodes[task.Node];
    for (int c = 0; c < 3; ++c)
    {
      node.Low[c] = box.Low[c];
      node.High[c] = box.High[c];
    }
    const bool leaf = middle == task.Begin;
    node.First = leaf ? task.Begin : children;
    node.Count = leaf ? task.End - task.Begin : 0;
    if (!leaf)
    {
      this->Nodes.resize(this->Nodes.size() + 2);
      tasks.push_back({ children, task.Begin, middle, task.Depth + 1 });
      tasks.push_back({ children + 1, middle, task.End, task.Depth + 1 });
    }
  }
  this->Nodes.shrink_to_fit();
}

//------------------------------------------------------------------------------
void TriangleTree::Build(TriangleSet& triangles)
{
  this->Triangles = &triangles;
  Builder(triangles, this->Nodes).Run();
}

//------------------------------------------------------------------------------
/// A ray ready for boxes.
struct TriangleTree::Slabs
{
  explicit Slabs(const TriangleSet::Ray& ray)
    : Origin(ray.Origin)
  {
    for (int c = 0; c < 3; ++c)
    {
      // Never 1/0: 0 times infinity is no number.
      const double d = ray.Direction[c];
      this->Inverse[c] = 1.0 / std::copysign(std::max(std::abs(d), 1e-250), d);
    }
  }

  /// Where the ray enters the box, or infinity where it misses it.
  double Enter(const Node& node, const TriangleSet::Ray& ray) const
  {
    double near = ray.Least;
    double far = ray.Most;
    for (int c = 0; c < 3; ++c)
    {
      const double a = (node.Low[c] - this->Origin[c]) * this->Inverse[c];
      const double b = (node.High[c] - this->Origin[c]) * this->Inverse[c];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far + (SlabSlack - 1.0) * (std::abs(near) + 1e-300)
             ? near
             : std::numeric_limits<double>::infinity();
  }

  glm::dvec3 Origin;
  glm::dvec3 Inverse;
};

//------------------------------------------------------------------------------
std::int64_t TriangleTree::Trace(
  TriangleSet::Ray ray, bool any, double& t, glm::dvec3& weights) const
{
  constexpr double Miss = std::numeric_limits<double>::infinity();
  struct Waiting
  {
    std::uint32_t Node;
    double Enter;
  };
  const Slabs slabs(ray);
  std::int64_t found = -1;
  if (this->Nodes.empty() || slabs.Enter(this->Nodes[0], ray) == Miss)
  {
    return found;
  }
  std::array<Waiting, StackSize> stack;
  std::size_t waiting = 0;
  stack[waiting++] = { 0, ray.Least };
  while (waiting > 0)
  {
    const Waiting next = stack[--waiting];
    if (next.Enter > ray.Most)
    {
      continue;
    }
    const Node& node = this->Nodes[next.Node];
    for (std::uint32_t k = node.First; k < node.First + node.Count; ++k)
    {
      double at = 0.0;
      glm::dvec3 shares;
      if (this->Triangles->Meets(this->Triangles->GetTriangles()[k], ray, at, shares))
      {
        ray.Most = t = at;
        weights = shares;
        found = k;
        if (any)
        {
          return found;
        }
      }
    }
    if (node.Count == 0)
    {
      const double left = slabs.Enter(this->Nodes[node.First], ray);
      const double right = slabs.Enter(this->Nodes[node.First + 1], ray);
      const bool leftFirst = left <= right;
      const Waiting later =
        leftFirst ? Waiting{ node.First + 1, right } : Waiting{ node.First, left };
      const Waiting sooner =
        leftFirst ? Waiting{ node.First, left } : Waiting{ node.First + 1, right };
      if (later.Enter != Miss)
      {
        stack[waiting++] = later;
      }
      if (sooner.Enter != Miss)
      {
        stack[waiting++] = sooner;
      }
    }
  }
  return found;
}
} // namespace measuredbrdf
