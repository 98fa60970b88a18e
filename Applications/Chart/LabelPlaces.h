// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where labels go in a crowded chart.
 */

#ifndef LabelPlaces_h
#define LabelPlaces_h

#include <array>
#include <vector>

namespace tool
{
/// Lower left corner of a label.
struct LabelPlace
{
  double X;
  double Y;
  bool Free; // nothing else is there
};

/// Greedy: each label takes the best place that those before it left. All in pixels.
class LabelPlaces
{
public:
  /// Labels stay within.
  LabelPlaces(double left, double bottom, double right, double top);

  ///@{
  /// Keep labels off: a line may be crossed where there is no better place, a dot rather not.
  void AvoidDot(double x, double y, double radius);
  void AvoidLine(double x0, double y0, double x1, double y1);
  ///@}

  /**
   * A place for a label of this width and height at that distance of one of the anchors, the first
   * of which is preferred. Unless always, a place that is not free is not taken.
   */
  LabelPlace Put(const std::vector<std::array<double, 2>>& anchors, double distance, double width,
    double height, bool always);

private:
  struct Box
  {
    double Left, Bottom, Right, Top;
  };

  double GetCost(const Box& box) const;

  Box Room;
  std::vector<Box> Dots;
  std::vector<Box> Labels;
  std::vector<std::array<double, 2>> LinePoints;
};
} // namespace tool

#endif
