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

#include "Curves.h"
#include "Session.h"

#include <QWidget>

#include <nlohmann/json.hpp>

#include <array>
#include <vector>

class QPainter;

namespace explorer
{
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

  /// What tool::InspectMaterial found.
  void SetInspection(const nlohmann::ordered_json& info);

  /// The curves of a chart as they are drawn, of GetMaterials; none of a chart that is not shown.
  const std::vector<Curve>& GetCurves(Chart chart) const { return this->Curves[chart]; }

  /// The dashed curves of the albedo's chart, of GetMaterials; empty where nothing goes through.
  const std::vector<Curve>& GetTransmittances() const { return this->Transmitted; }

  /// The material that is shown, then those that it is compared with.
  std::vector<ChartedMaterial> GetMaterials() const;

Q_SIGNALS:
  void updated();

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  void Update();
  Curve Sample(int chart, const ChartedMaterial& material) const;
  void DrawChart(QPainter& painter, int chart, const QRectF& area) const;
  void DrawPolar(QPainter& painter, const QRectF& area) const;
  bool IsAllAround() const;

  Session* Model;
  std::array<std::vector<Curve>, NumberOfCharts> Curves;
  Curve Albedos;        // of the material that is shown; empty until it was measured
  Curve Transmittances; // the same
  std::vector<Curve> Transmitted;
};

/// The view with its fields. The label "slice legend" has the names of materials in the colors of
/// their curves, and is empty of one material; the box "polar" chooses the plane of incidence.
QWidget* MakeSlicePanel(Session* session);

/// The image slice: f over theta_h and theta_d as a picture.
QWidget* MakeImagePanel(Session* session, Jobs* jobs);
} // namespace explorer

#endif
