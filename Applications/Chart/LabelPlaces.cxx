// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LabelPlaces.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace
{
// What is worse: to hide a label or a dot, to cross a line for so many pixels, to be farther along
// the anchors.
constexpr double LabelCost = 1000.0;
constexpr double DotCost = 200.0;
constexpr double LineCost = 8.0;
constexpr double AnchorCost = 12.0;
constexpr double LineStep = 8.0;
}

namespace tool
{
//------------------------------------------------------------------------------
LabelPlaces::LabelPlaces(double left, double bottom, double right, double top)
  : Room{ left, bottom, right, top }
{
}

//------------------------------------------------------------------------------
void LabelPlaces::AvoidDot(double x, double y, double radius)
{
  this->Dots.push_back({ x - radius, y - radius, x + radius, y + radius });
}

//------------------------------------------------------------------------------
void LabelPlaces::AvoidLine(double x0, double y0, double x1, double y1)
{
  const int steps = 1 + static_cast<int>(std::hypot(x1 - x0, y1 - y0) / LineStep);
  for (int k = 0; k <= steps; ++k)
  {
    const double t = static_cast<double>(k) / steps;
    this->LinePoints.push_back({ x0 + t * (x1 - x0), y0 + t * (y1 - y0) });
  }
}

//------------------------------------------------------------------------------
double LabelPlaces::GetCost(const Box& box) const
{
  if (box.Left < this->Room.Left || box.Right > this->Room.Right ||
      box.Bottom < this->Room.Bottom || box.Top > this->Room.Top)
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto meets = [&box](const Box& other)
  {
    return box.Left < other.Right && other.Left < box.Right && box.Bottom < other.Top &&
           other.Bottom < box.Top;
  };
  double cost =
    LabelCost *
      static_cast<double>(std::count_if(this->Labels.begin(), this->Labels.end(), meets)) +
    DotCost * static_cast<double>(std::count_if(this->Dots.begin(), this->Dots.end(), meets));
  for (const std::array<double, 2>& point : this->LinePoints)
  {
    cost +=
      point[0] > box.Left && point[0] < box.Right && point[1] > box.Bottom && point[1] < box.Top
        ? LineCost
        : 0.0;
  }
  return cost;
}

//------------------------------------------------------------------------------
LabelPlace LabelPlaces::Put(const std::vector<std::array<double, 2>>& anchors, double distance,
  double width, double height, bool always)
{
  LabelPlace best{ anchors.front()[0] + distance, anchors.front()[1] - 0.5 * height, false };
  Box taken{ best.X, best.Y, best.X + width, best.Y + height };
  double least = std::numeric_limits<double>::infinity();
  double preference = 0.0;
  for (const std::array<double, 2>& anchor : anchors)
  {
    const double right = anchor[0] + distance;
    const double left = anchor[0] - distance - width;
    const double above = anchor[1] + distance;
    const double below = anchor[1] - distance - height;
    const double middle = anchor[0] - 0.5 * width;
    const double level = anchor[1] - 0.5 * height;
    for (const std::array<double, 2>& corner : std::initializer_list<std::array<double, 2>>{
           { right, level }, { right, above }, { right, below }, { middle, above },
           { middle, below }, { left, level }, { left, above }, { left, below } })
    {
      const Box box{ corner[0], corner[1], corner[0] + width, corner[1] + height };
      const double found = this->GetCost(box);
      if (found + preference < least)
      {
        least = found + preference;
        best = { corner[0], corner[1], found == 0.0 };
        taken = box;
      }
      preference += 0.1;
    }
    preference += AnchorCost;
  }
  if (best.Free || always)
  {
    this->Labels.push_back(taken);
  }
  return best;
}
} // namespace tool
