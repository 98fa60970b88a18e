// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Charts of materials with the angles at which they cut: slices over theta_h, theta_d and phi_d,
 * and the albedo with the transmittance; or f in the plane of incidence of the lobe's light, on
 * both sides of the surface where the material transmits.
 */

#ifndef SlicePanel_h
#define SlicePanel_h

#include "Comparison.h"
#include "Curves.h"
#include "RenderView.h"
#include "Session.h"

#include <nlohmann/json.hpp>

#include <array>
#include <memory>
#include <vector>

class vtkChartXY;
class vtkContextActor;
class vtkRenderer;

namespace explorer
{
class PolarChart;

class SliceView : public RenderView
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

  SliceView(Session* session, Comparison* comparison, QWidget* parent = nullptr);
  ~SliceView() override;

  /// What tool::InspectMaterial found.
  void SetInspection(const nlohmann::ordered_json& info);

  /// The curves of a chart as they are drawn, of GetMaterials; none of a chart that is not shown.
  const std::vector<Curve>& GetCurves(Chart chart) const { return this->Curves[chart]; }

  /// The dashed curves of the albedo's chart, of GetMaterials; empty where nothing goes through.
  const std::vector<Curve>& GetTransmittances() const { return this->Transmitted; }

  /// The material that is shown, then those that it is compared with.
  std::vector<ComparedMaterial> GetMaterials() const;

signals:
  void updated();

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  void Update();
  Curve Sample(int chart, const ComparedMaterial& material) const;
  void Draw(int chart);
  bool IsAllAround() const;
  void PlaceCharts();

  Session* Model;
  Comparison* Compared;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkContextActor> Scene;
  std::array<vtkNew<vtkChartXY>, NumberOfCharts> Charts;
  std::unique_ptr<PolarChart> Polar;
  std::array<std::vector<Curve>, NumberOfCharts> Curves;
  Curve Albedos;        // of the material that is shown; empty until it was measured
  Curve Transmittances; // the same
  std::vector<Curve> Transmitted;
};

/// The view with its fields. The label "slice legend" has the names of materials in the colors of
/// their curves, and is empty of one material; the box "polar" chooses the plane of incidence.
QWidget* MakeSlicePanel(Session* session, Comparison* comparison);
} // namespace explorer

#endif
