// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the charts of a material show: f along lines of directions and its albedo, as lines on a
 * scale.
 */

#ifndef Curves_h
#define Curves_h

#include "State.h"

#include "vtkBRDF.h"
#include "vtkBTDF.h"
#include "vtkSmartPointer.h"

#include <QColor>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace explorer
{
/// Values over angles: linear RGB.
struct Curve
{
  std::vector<double> Degrees;
  std::vector<std::array<double, 3>> Values;
};

/// A material in the charts, read and prepared.
struct ChartedMaterial
{
  std::string File;
  std::string Name;
  vtkSmartPointer<vtkBRDF> BRDF;
  Curve Albedo;
  ModelValues Values = {};                         // of a model
  vtkSmartPointer<vtkBTDF> Transmission = nullptr; // null: none
  Curve Transmittance = {};                        // empty: none
};

/// f in 1/sr over theta_h, theta_d or phi_d (which: 0, 1, 2) through the angles at (degrees), the
/// directions above the horizon (Rusinkiewicz 1998).
Curve SampleSlice(vtkBRDF* brdf, int which, const std::array<double, 3>& at);

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

/// What is seen of a white sky on the other side, over the same angles.
Curve SampleTransmittance(vtkBTDF* transmission);

struct ChartLine
{
  QColor Color;
  std::vector<double> Degrees;
  std::vector<double> Values;
};

/// A curve's red, green and blue; or, of several materials, each one's luminance in its color.
std::vector<ChartLine> MakeLines(const std::vector<Curve>& curves);

/// The color of a material among several: the one that is shown has 0.
QColor GetMaterialColor(std::size_t k);

/// Where on an axis, as a share of it, there is which text.
using ChartTicks = std::vector<std::pair<double, std::string>>;

/// Where values are on an axis, as shares of it. On a logarithmic one zero is drawn as a millionth
/// of the largest value.
class ChartScale
{
public:
  ChartScale(const std::vector<ChartLine>& lines, bool logarithmic);

  double Find(double value) const;

  /// Round values.
  const ChartTicks& GetTicks() const { return this->Ticks; }

private:
  bool Logarithmic;
  double Floor = 0.0;
  double Least = 0.0; // of the axis: values, or exponents of ten
  double Largest = 1.0;
  ChartTicks Ticks;
};
} // namespace explorer

#endif
