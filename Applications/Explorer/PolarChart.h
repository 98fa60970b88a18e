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
 * Upwards is the normal, the mirror's side is right. The distance from the origin is the value:
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

  /// Into a rectangle of the scene, in pixels; it takes half its width in height and two lines of
  /// text.
  void Place(double left, double bottom, double width, double ratio);
  static double GetHeight(double width, double ratio);

  void SetVisible(bool visible);

private:
  vtkNew<vtkChartXY> Chart;
  vtkNew<PolarLabels> Labels;
};
} // namespace explorer

#endif
