// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Charts of materials with the angles at which they cut: slices over theta_h, theta_d and phi_d,
 * and the albedo with the transmittance; or f in the plane of incidence of the lobe's light, on
 * both sides of the surface where the material transmits; and the image slice.
 */

#ifndef SlicePanel_h
#define SlicePanel_h

#include "Session.h"

#include "vtkBRDF.h"
#include "vtkBTDF.h"

#include <QColor>
#include <QWidget>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

class QPainter;

namespace explorer
{
/// Values over angles: linear RGB.
struct Curve
{
  std::vector<double> Degrees;
  std::vector<std::array<double, 3>> Values;
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

/// What tool::InspectMaterial has measured over the angle of view: the albedo, and what is seen of
/// a white sky on the other side; empty where there is none.
///@{
Curve GetAlbedo(const nlohmann::ordered_json& info);
Curve GetTransmittance(const nlohmann::ordered_json& info);
///@}

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
struct ChartScale
{
  ChartScale(const std::vector<ChartLine>& lines, bool logarithmic);

  double Find(double value) const;

  bool Logarithmic;
  double Floor;
  double Least = 0.0; // of the axis: values, or exponents of ten
  double Largest = 1.0;
  ChartTicks Ticks; // at round values
};

class SliceView : public QWidget
{
  Q_OBJECT

public:
  enum Chart
  {
    ThetaH,
    ThetaD,
    PhiD,
    Albedo,
    Plane, // of incidence, also as a polar chart
    NumberOfCharts
  };

  explicit SliceView(Session* session);

  /// The curves of a chart as they are drawn, of the session's charted materials; none of a chart
  /// that is not shown.
  const std::vector<Curve>& GetCurves(Chart chart) const { return this->Curves[chart]; }

  /// The dashed curves of the albedo's chart, of the same materials; empty where nothing goes
  /// through.
  const std::vector<Curve>& GetTransmittances() const { return this->Transmitted; }

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  void Update();
  Curve Sample(int chart, const ShownMaterial& material) const;
  void DrawChart(QPainter& painter, int chart, bool polar, const QRectF& area) const;
  bool IsAllAround() const;

  Session* Model;
  std::array<std::vector<Curve>, NumberOfCharts> Curves;
  std::vector<Curve> Transmitted;
};

/// The view with its fields. The label "slice legend" has the names of materials in the colors of
/// their curves, and is empty of one material; the box "polar" chooses the plane of incidence.
QWidget* MakeSlicePanel(Session* session);

/// The image slice: f over theta_h and theta_d as a picture.
QWidget* MakeImagePanel(Session* session, Jobs* jobs);
} // namespace explorer

#endif
