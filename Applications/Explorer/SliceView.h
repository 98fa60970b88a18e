// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Charts of a material: slices over theta_h, theta_d and phi_d, and its albedo.
 */

#ifndef SliceView_h
#define SliceView_h

#include "Session.h"

#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <QVTKOpenGLNativeWidget.h>

#include <nlohmann/json.hpp>

#include <array>

class vtkBRDFSliceSource;
class vtkChartXY;
class vtkContextActor;
class vtkRenderer;

namespace explorer
{
class SliceView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  explicit SliceView(Session* session, QWidget* parent = nullptr);
  ~SliceView() override;

  /// What tool::InspectMaterial found; null: nothing yet.
  void SetInspection(const nlohmann::ordered_json& info);

  void RequestRender();

  /// Rows of a chart (theta_h, theta_d, phi_d, albedo) as they are drawn.
  vtkTable* GetTable(int chart) const { return this->Tables[static_cast<std::size_t>(chart)]; }

protected:
  bool event(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

private:
  void Update();
  void UpdateSlice(int chart);
  void UpdateAlbedo();
  void Draw(int chart, vtkTable* table, bool logarithmic);
  void PlaceCharts();

  Session* Model;
  vtkNew<vtkGenericOpenGLRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkContextActor> Scene;
  std::array<vtkNew<vtkChartXY>, 4> Charts;
  std::array<vtkNew<vtkTable>, 4> Tables;
  vtkNew<vtkBRDFSliceSource> Source;
  nlohmann::ordered_json Info;
  bool IsRequested = false;
};
} // namespace explorer

#endif
