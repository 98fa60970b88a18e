// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the charts of a material show: f along lines of directions and its albedo, as lines on a
 * scale. Without Qt.
 */

#ifndef Curves_h
#define Curves_h

#include "vtkBRDF.h"
#include "vtkBTDF.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

class vtkAxis;
class vtkChartXY;

namespace explorer
{
/// Values over angles: linear RGB.
struct Curve
{
  std::vector<double> Degrees;
  std::vector<std::array<double, 3>> Values;
};

///@{
/// f in 1/sr over theta_h, theta_d or phi_d (which: 0, 1, 2) through the angles at (degrees), the
/// directions above the horizon (Rusinkiewicz 1998).
Curve SampleSlice(vtkBRDF* brdf, int which, const std::array<double, 3>& at);
///@}

/**
 * f in 1/sr in the plane of incidence of light from theta_i, phi_i (degrees): over the angle from
 * the normal, which is negative on the light's side. Densest about the mirror direction, theta_i.
 * With transmission it goes on below the surface, from 90 to 180 and from -180 to -90, densest
 * where light goes straight on, at 180 - theta_i.
 */
Curve SamplePlaneOfIncidence(
  vtkBRDF* brdf, double thetaI, double phiI, vtkBTDF* transmission = nullptr);

/// The albedo over the angle of view, as tool::InspectMaterial measures it. Takes a while. Throws
/// tool::Error.
Curve SampleAlbedo(vtkBRDF* brdf);

/// What is seen of a white sky on the other side, over the angle of view: tool::InspectMaterial's
/// angles.
Curve SampleTransmittance(vtkBTDF* transmission);

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
