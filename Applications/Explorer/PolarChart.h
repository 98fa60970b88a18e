// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A polar chart of f in the plane of incidence.
 */

#ifndef PolarChart_h
#define PolarChart_h

#include "ChartLines.h"

#include "vtkNew.h"

#include <vector>

class vtkChartXY;
class vtkContextScene;

namespace explorer
{
class PolarLabels;

/**
 * Upwards is the normal, the mirror's side is right; below the surface is what is transmitted,
 * where the chart goes all around. The distance from the origin is the value:
 * from 0, or from the least value where it is logarithmic. Circles have constant values.
 */
class PolarChart
{
public:
  static constexpr Color LightColor = { 240, 170, 0 };

  explicit PolarChart(vtkContextScene* scene);
  ~PolarChart();

  /// Lines over the angle from the normal, negative on the light's side. thetaI: of the light, in
  /// degrees; ratio: of the screen's pixels.
  void Draw(const std::vector<ChartLine>& lines, double thetaI, bool logarithmic, double ratio);

  /// Whether it has directions below the surface, too; default: no.
  void SetAllAround(bool allAround) { this->AllAround = allAround; }
  bool IsAllAround() const { return this->AllAround; }

  /// Into a rectangle of the scene, in pixels; it takes half its width in height, or all of it
  /// where it goes all around, and two lines of text.
  void Place(double left, double bottom, double width, double ratio);
  double GetHeight(double width, double ratio) const;

  void SetVisible(bool visible);

private:
  vtkNew<vtkChartXY> Chart;
  vtkNew<PolarLabels> Labels;
  bool AllAround = false;
};
} // namespace explorer

#endif
