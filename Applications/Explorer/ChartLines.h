// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lines of a chart, and the scale on which their values are drawn.
 */

#ifndef ChartLines_h
#define ChartLines_h

#include "Curves.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

class vtkAxis;
class vtkChartXY;

namespace explorer
{
using Color = std::array<unsigned char, 3>;

struct ChartLine
{
  Color Rgb = {};
  std::vector<double> Degrees;
  std::vector<double> Values;
};

/// A curve's red, green and blue; or, of several materials, each one's luminance in its color.
std::vector<ChartLine> MakeLines(const std::vector<Curve>& curves);

/// The color of a material among several: the one that is shown has 0.
Color GetMaterialColor(std::size_t k);

/**
 * Where values are on an axis. Logarithms are drawn as such: VTK's own logarithmic axes refuse
 * zeros and label badly. Zero is drawn as a millionth of the largest value.
 */
class ChartScale
{
public:
  ChartScale(const std::vector<ChartLine>& lines, bool logarithmic);

  double Find(double value) const;

  ///@{
  /// The ends, and round values between them: where they are, and how they are written.
  double GetLeast() const { return this->Least; }
  double GetLargest() const { return this->Largest; }
  std::vector<std::pair<double, std::string>> GetTicks() const;
  ///@}

private:
  bool Logarithmic;
  double Floor = 0.0;
  double Least = 0.0;
  double Largest = 1.0;
  std::vector<double> Exponents;
};

/// Ticks at places of the axis, with their texts.
void SetTicks(vtkAxis* axis, const std::vector<std::pair<double, std::string>>& ticks);

/// Add a line to a chart. Lines of less than two points are left out.
void AddLine(vtkChartXY* chart, const std::vector<double>& x, const std::vector<double>& y,
  const Color& color, double width, bool dashed = false);
} // namespace explorer

#endif
