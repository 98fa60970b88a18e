// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTensorTreeBRDF.h"

#include "HalfVector.h"
#include "Refusal.h"
#include "vtkBRDFExchange.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkTensorTreeBRDF);

namespace
{
using Tree = vtkTensorTreeBRDF::Tree;
constexpr int LargestSide = 1 << 10;
constexpr int DeepestTree = 64;

// From the unit disc to [0,1]^2.
void ToUnitSquare(double x, double y, double square[2])
{
  const glm::dvec2 p = 0.5 * (DiscToSquare({ x, y }) + 1.0);
  square[0] = p.x;
  square[1] = p.y;
}

// Where a pair lies, each coordinate in [0, 1).
std::array<double, 4> GetPlace(const Tree& tree, const double i[3], const double o[3])
{
  std::array<double, 4> place{};
  if (tree.Dimensions == 4)
  {
    ToUnitSquare(-o[0], -o[1], &place[0]);
    ToUnitSquare(i[0], i[1], &place[2]);
  }
  else
  {
    const double radius = std::hypot(o[0], o[1]);
    const double c = radius > 1e-12 ? -o[0] / radius : 1.0;
    const double s = radius > 1e-12 ? -o[1] / radius : 0.0;
    place[0] = std::min(0.5 - 0.5 * radius, 0.5 - 1e-9); // trees hold nothing beyond
    ToUnitSquare(c * i[0] + s * i[1], c * i[1] - s * i[0], &place[1]);
  }
  for (double& coordinate : place)
  {
    coordinate = std::clamp(coordinate, 0.0, 1.0 - 1e-12);
  }
  return place;
}

float Find(const Tree& tree, std::array<double, 4> place)
{
  const std::size_t axes = static_cast<std::size_t>(tree.Dimensions);
  std::size_t node = tree.Nodes.size() - 1;
  while (tree.Nodes[node].Side == 0)
  {
    std::size_t child = static_cast<std::size_t>(tree.Nodes[node].First);
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      place[axis] *= 2.0;
      if (place[axis] >= 1.0)
      {
        child += std::size_t(1) << axis;
        place[axis] -= 1.0;
      }
    }
    node = static_cast<std::size_t>(tree.Children[child]);
  }
  const Tree::Node& leaf = tree.Nodes[node];
  int cell = 0;
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    cell = cell * leaf.Side + std::min(static_cast<int>(place[axis] * leaf.Side), leaf.Side - 1);
  }
  return tree.Values[static_cast<std::size_t>(leaf.First + cell)];
}

// Checks a node whose children were checked. Returns how many nodes stand above each other up to
// it.
int CheckNode(const Tree& tree, std::size_t index, const std::vector<int>& depths)
{
  const Tree::Node& node = tree.Nodes[index];
  const std::string name = "node " + std::to_string(index) + ": ";
  Require(node.Side >= 0 && node.Side <= LargestSide && (node.Side & (node.Side - 1)) == 0,
    name + "found a side of " + std::to_string(node.Side) +
      ", expected 0 for a branch or a power of two");
  const bool branch = node.Side == 0;
  const double count = std::pow(branch ? 2 : node.Side, tree.Dimensions);
  const std::size_t size = branch ? tree.Children.size() : tree.Values.size();
  Require(node.First >= 0 && node.First + count <= static_cast<double>(size),
    name + "its " + (branch ? "children" : "values") + " are not there");
  int depth = 0;
  for (int k = 0; branch && k < static_cast<int>(count); ++k)
  {
    const int child = tree.Children[static_cast<std::size_t>(node.First + k)];
    Require(child >= 0 && static_cast<std::size_t>(child) < index,
      name + "expected children before their parents");
    depth = std::max(depth, depths[static_cast<std::size_t>(child)]);
  }
  return depth + 1;
}

void CheckTree(const Tree& tree)
{
  const std::size_t most = vtkTensorTreeBRDF::MaximumSize;
  Require(tree.Dimensions == 3 || tree.Dimensions == 4,
    "found " + std::to_string(tree.Dimensions) + " dimensions, expected 3 or 4");
  Require(!tree.Nodes.empty() && tree.Nodes.size() <= most && tree.Children.size() <= most &&
            tree.Values.size() <= most,
    "expected 1 to " + std::to_string(most) + " nodes, and as many children and values");
  std::vector<int> depths;
  for (std::size_t index = 0; index < tree.Nodes.size(); ++index)
  {
    depths.push_back(CheckNode(tree, index, depths));
  }
  Require(depths.back() <= DeepestTree,
    "expected at most " + std::to_string(DeepestTree) + " nodes above each other");
  RequireFinite(tree.Values, "values");
}

// As they are stored with other arrays; what is no whole number becomes -1, which is refused.
std::vector<float> ToFloats(const std::vector<int>& numbers)
{
  return std::vector<float>(numbers.begin(), numbers.end());
}

std::vector<int> ToNumbers(const std::vector<float>& values)
{
  std::vector<int> numbers;
  for (const float value : values)
  {
    const bool whole = value >= 0.0f && value <= float(int(vtkTensorTreeBRDF::MaximumSize));
    numbers.push_back(whole ? static_cast<int>(value) : -1);
  }
  return numbers;
}
}

//------------------------------------------------------------------------------
std::string vtkTensorTreeBRDF::SetTree(Tree tree)
{
  return FindProblemOf(
    [&]()
    {
      CheckTree(tree);
      this->Data = std::move(tree);
      this->ResetRenderable();
      this->Modified();
    });
}

//------------------------------------------------------------------------------
void vtkTensorTreeBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (!this->Data.Nodes.empty())
  {
    std::fill_n(f, 3, Find(this->Data, GetPlace(this->Data, i, o)));
  }
}

//------------------------------------------------------------------------------
void vtkTensorTreeBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  int dimensions = this->Data.Dimensions - 3;
  exchange.Option("dimensions", { "3", "4" }, dimensions, [&](int value) { dimensions = value; });
  if (!exchange.IsLoading())
  {
    std::vector<int> nodes;
    for (const Tree::Node& node : this->Data.Nodes)
    {
      nodes.insert(nodes.end(), { node.Side, node.First });
    }
    exchange.SaveArray(
      "nodes", { static_cast<int>(this->Data.Nodes.size()), 2 }, 1, ToFloats(nodes));
    // One that is not used, where the root is a leaf: files hold no empty arrays.
    std::vector<int> children = this->Data.Children;
    children.resize(std::max<std::size_t>(children.size(), 1), 0);
    exchange.SaveArray("children", { static_cast<int>(children.size()) }, 1, ToFloats(children));
    exchange.SaveArray(
      "values", { static_cast<int>(this->Data.Values.size()) }, 1, this->Data.Values);
    return;
  }
  Tree tree;
  tree.Dimensions = dimensions + 3;
  const std::vector<int> nodes = ToNumbers(exchange.LoadArray("nodes", 2, 1).Values);
  for (std::size_t k = 0; k + 1 < nodes.size(); k += 2)
  {
    tree.Nodes.push_back({ nodes[k], nodes[k + 1] });
  }
  tree.Children = ToNumbers(exchange.LoadArray("children", 1, 1).Values);
  tree.Values = exchange.LoadArray("values", 1, 1).Values;
  exchange.Check(this->SetTree(std::move(tree)));
}

//------------------------------------------------------------------------------
vtkBRDF* vtkTensorTreeBRDF::NewCopy()
{
  vtkTensorTreeBRDF* copy = vtkTensorTreeBRDF::New();
  copy->Data = this->Data;
  copy->ShareRenderable(this);
  return copy;
}
