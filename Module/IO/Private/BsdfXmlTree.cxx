// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BsdfXmlTree.h"

#include "NumberText.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t DeepestBrace = 32;

using Tree = vtkTensorTreeBRDF::Tree;

// What stands between a pair of braces, so far.
struct Group
{
  std::vector<int> Children;
  std::vector<float> Values;
};

// The power of two whose power of `dimensions` is count, or 0.
int FindSide(std::size_t count, int dimensions)
{
  for (int side = 1; side <= 1024; side *= 2)
  {
    if (static_cast<std::size_t>(std::llround(std::pow(side, dimensions))) == count)
    {
      return side;
    }
  }
  return 0;
}

// The group as the tree's last node.
void Close(const Group& group, Tree& tree)
{
  if (!group.Children.empty())
  {
    if (!group.Values.empty() || group.Children.size() != std::size_t(1) << tree.Dimensions)
    {
      throw std::runtime_error("a branch has " + std::to_string(group.Children.size()) +
                               " children and " + std::to_string(group.Values.size()) +
                               " values, expected " + std::to_string(1 << tree.Dimensions) +
                               " children");
    }
    tree.Nodes.push_back({ 0, static_cast<int>(tree.Children.size()) });
    tree.Children.insert(tree.Children.end(), group.Children.begin(), group.Children.end());
    return;
  }
  const int side = FindSide(group.Values.size(), tree.Dimensions);
  if (side == 0)
  {
    throw std::runtime_error("a leaf has " + std::to_string(group.Values.size()) +
                             " values, expected a power of two along each of " +
                             std::to_string(tree.Dimensions) + " axes");
  }
  tree.Nodes.push_back({ side, static_cast<int>(tree.Values.size()) });
  tree.Values.insert(tree.Values.end(), group.Values.begin(), group.Values.end());
}
}

std::string_view TakeBsdfWord(std::string_view& text)
{
  constexpr std::string_view between = " \t\r\n,";
  constexpr std::string_view end = " \t\r\n,{}";
  text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
  const bool brace = !text.empty() && (text.front() == '{' || text.front() == '}');
  const std::size_t length = brace ? 1 : std::min(text.find_first_of(end), text.size());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

bool ToBsdfNumber(std::string_view word, double& number)
{
  return ParseNumber(word, number) && std::abs(number) < 1e30;
}

std::string FindDecimalComma(std::string_view text)
{
  constexpr std::string_view digits = "0123456789";
  const auto isDigit = [&](std::size_t at)
  { return at < text.size() && digits.find(text[at]) != std::string_view::npos; };
  for (std::size_t at = text.find(','); at != std::string_view::npos; at = text.find(',', at + 1))
  {
    if (at > 0 && isDigit(at - 1) && isDigit(at + 1))
    {
      const std::size_t before = text.find_last_not_of(digits, at - 1);
      const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
      const std::size_t last = std::min(text.find_first_not_of(digits, at + 1), text.size());
      const bool hasPoint = (first > 0 && text[first - 1] == '.') ||
                            (last < text.size() && (text[last] == '.' || text[last] == ','));
      if (!hasPoint)
      {
        return std::string(text.substr(first, std::min<std::size_t>(last - first, 40)));
      }
    }
  }
  return "";
}

Tree ParseBsdfTree(std::string_view text, int dimensions)
{
  Tree tree;
  tree.Dimensions = dimensions;
  std::vector<Group> open;
  bool closed = false;
  for (std::string_view word = TakeBsdfWord(text); !word.empty(); word = TakeBsdfWord(text))
  {
    if (closed)
    {
      throw std::runtime_error("more follows the tree");
    }
    if (word == "{")
    {
      if (open.size() == DeepestBrace)
      {
        throw std::runtime_error("braces are nested too deeply");
      }
      open.emplace_back();
      continue;
    }
    double number = 0.0;
    if (open.empty() || (word != "}" && !ToBsdfNumber(word, number)))
    {
      throw std::runtime_error(
        "found '" + std::string(word.substr(0, 40)) + "', expected a brace or a number in braces");
    }
    if (word != "}")
    {
      open.back().Values.push_back(static_cast<float>(number));
      continue;
    }
    Close(open.back(), tree);
    open.pop_back();
    closed = open.empty();
    if (!closed)
    {
      open.back().Children.push_back(static_cast<int>(tree.Nodes.size()) - 1);
    }
  }
  if (!closed)
  {
    throw std::runtime_error("found " + std::to_string(open.size()) + " braces open at the end");
  }
  return tree;
}
} // namespace measuredbrdf
