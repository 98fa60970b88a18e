// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SliceView.h"

#include "LogAxis.h"

#include "vtkAxis.h"
#include "vtkBRDFSliceSource.h"
#include "vtkChartXY.h"
#include "vtkContextActor.h"
#include "vtkContextScene.h"
#include "vtkDoubleArray.h"
#include "vtkPen.h"
#include "vtkPlot.h"
#include "vtkRect.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"

#include <QEvent>
#include <QTimer>

#include <algorithm>
#include <cmath>

namespace
{
constexpr int ThetaH = 0;
constexpr int ThetaD = 1;
constexpr int PhiD = 2;
constexpr int Albedo = 3;
const char* const ChartNames[4] = { "theta_h", "theta_d", "phi_d", "albedo" };
const char* const Channels[3] = { "red", "green", "blue" };
constexpr unsigned char Colors[3][3] = { { 214, 64, 54 }, { 46, 140, 62 }, { 52, 98, 204 } };
constexpr int FontSize = 12; // the window's resolution counts, too

//------------------------------------------------------------------------------
void SetTicks(vtkAxis* axis, const std::vector<double>& exponents)
{
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (const double exponent : exponents)
  {
    positions->InsertNextValue(exponent);
    labels->InsertNextValue(tool::FormatTick(std::pow(10.0, exponent), tool::Unit::Number));
  }
  axis->SetCustomTickPositions(positions, labels);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> AddColumn(vtkTable* table, const char* name)
{
  auto column = vtkSmartPointer<vtkDoubleArray>::New();
  column->SetName(name);
  table->AddColumn(column);
  return column;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
SliceView::SliceView(Session* session, QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , Model(session)
{
  this->setRenderWindow(this->Window);
  this->setAcceptDrops(false);
  this->setMinimumSize(260, 260);
  this->setAccessibleName(tr("Slices and albedo"));
  this->Window->SetMultiSamples(0);
  this->Window->SetLineSmoothing(true);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.97, 0.97, 0.97);
  this->Renderer->AddActor(this->Scene);
  this->Scene->GetScene()->SetRenderer(this->Renderer);
  for (const auto& chart : this->Charts)
  {
    chart->SetAutoSize(false);
    chart->SetShowLegend(false);
    this->Scene->GetScene()->AddItem(chart);
  }
  connect(session, &Session::materialChanged, this,
    [this]()
    {
      this->Info = nullptr;
      this->Update();
    });
  connect(session, &Session::slicesChanged, this, &SliceView::Update);
}

//------------------------------------------------------------------------------
SliceView::~SliceView() = default;

//------------------------------------------------------------------------------
void SliceView::SetInspection(const nlohmann::ordered_json& info)
{
  this->Info = info;
  this->UpdateAlbedo();
  this->RequestRender();
}

//------------------------------------------------------------------------------
void SliceView::Update()
{
  if (!this->Model->GetMaterial().BRDF)
  {
    return;
  }
  this->Source->SetBRDF(this->Model->GetMaterial().BRDF);
  for (const int chart : { ThetaH, ThetaD, PhiD })
  {
    this->UpdateSlice(chart);
  }
  this->UpdateAlbedo();
  this->PlaceCharts();
  this->RequestRender();
}

//------------------------------------------------------------------------------
void SliceView::UpdateSlice(int chart)
{
  const State& state = this->Model->GetState();
  const double at[3] = { state.SliceThetaH, state.SliceThetaD, state.SlicePhiD };
  const double ends[3] = { 90.0, 90.0, 180.0 };
  const auto range = [&](int angle, double values[2])
  {
    values[0] = angle == chart ? 0.0 : at[angle];
    values[1] = angle == chart ? ends[angle] : at[angle];
  };
  double values[2];
  range(ThetaH, values);
  this->Source->SetThetaHRange(values);
  range(ThetaD, values);
  this->Source->SetThetaDRange(values);
  range(PhiD, values);
  this->Source->SetPhiDRange(values);
  constexpr int samples = 361;
  this->Source->SetNumberOfThetaH(chart == ThetaH ? samples : 1);
  this->Source->SetNumberOfThetaD(chart == ThetaD ? samples : 1);
  this->Source->SetNumberOfPhiD(chart == PhiD ? samples : 1);
  this->Source->SetUseThetaHSquared(true);
  this->Source->Update();

  vtkTable* slice = this->Source->GetOutput();
  const bool logarithmic = state.SliceLogarithmic;
  vtkNew<vtkTable> table;
  const auto angles = AddColumn(table, ChartNames[chart]);
  vtkSmartPointer<vtkDoubleArray> columns[3];
  for (int c = 0; c < 3; ++c)
  {
    columns[c] = AddColumn(table, Channels[c]);
  }
  for (vtkIdType row = 0; row < slice->GetNumberOfRows(); ++row)
  {
    if (slice->GetValueByName(row, "vtkValidPointMask").ToInt() == 0)
    {
      continue;
    }
    angles->InsertNextValue(slice->GetValueByName(row, ChartNames[chart]).ToDouble());
    for (int c = 0; c < 3; ++c)
    {
      columns[c]->InsertNextValue(slice->GetValueByName(row, Channels[c]).ToDouble());
    }
  }
  this->Tables[static_cast<std::size_t>(chart)]->ShallowCopy(table);
  this->Draw(chart, table, logarithmic);
}

//------------------------------------------------------------------------------
void SliceView::UpdateAlbedo()
{
  vtkNew<vtkTable> table;
  const auto angles = AddColumn(table, "degrees");
  vtkSmartPointer<vtkDoubleArray> columns[3];
  for (int c = 0; c < 3; ++c)
  {
    columns[c] = AddColumn(table, Channels[c]);
  }
  if (this->Info.is_object())
  {
    for (const auto& row : this->Info["albedo"])
    {
      angles->InsertNextValue(row["degrees"]);
      for (int c = 0; c < 3; ++c)
      {
        columns[c]->InsertNextValue(row["rgb"][static_cast<std::size_t>(c)]);
      }
    }
  }
  this->Tables[Albedo]->ShallowCopy(table);
  this->Draw(Albedo, table, false);
}

//------------------------------------------------------------------------------
// Logarithms are drawn as such: VTK's own logarithmic axes refuse zeros and label badly.
void SliceView::Draw(int chart, vtkTable* table, bool logarithmic)
{
  vtkChartXY* drawn = this->Charts[static_cast<std::size_t>(chart)];
  drawn->ClearPlots();
  tool::LogAxis scale;
  double largest = 0.0;
  double peak = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    auto* values = vtkDoubleArray::SafeDownCast(table->GetColumnByName(Channels[c]));
    for (vtkIdType k = 0; k < values->GetNumberOfValues(); ++k)
    {
      peak = std::max(peak, values->GetValue(k));
    }
  }
  const double floor = 1e-6 * peak; // a zero is drawn as this
  for (int c = 0; c < 3; ++c)
  {
    auto* values = vtkDoubleArray::SafeDownCast(table->GetColumnByName(Channels[c]));
    vtkNew<vtkDoubleArray> y;
    y->SetName(Channels[c]);
    for (vtkIdType k = 0; k < values->GetNumberOfValues(); ++k)
    {
      const double value = values->GetValue(k);
      largest = std::max(largest, value);
      scale.Take(std::max(value, floor));
      y->InsertNextValue(
        !logarithmic ? value : std::log10(std::max(value, std::max(floor, 1e-300))));
    }
    if (table->GetNumberOfRows() < 2)
    {
      continue;
    }
    vtkNew<vtkTable> line;
    line->AddColumn(table->GetColumn(0));
    line->AddColumn(y);
    vtkPlot* plot = drawn->AddPlot(vtkChart::LINE);
    plot->SetInputData(line, 0, 1);
    plot->SetColor(Colors[c][0], Colors[c][1], Colors[c][2], 255);
    plot->SetWidth(2.0f * static_cast<float>(this->devicePixelRatioF()));
  }
  const char* const titles[4] = { "f (1/sr) over theta_h", "f (1/sr) over theta_d",
    "f (1/sr) over phi_d", "albedo over theta_o" };
  drawn->SetTitle(titles[chart]);
  drawn->GetTitleProperties()->SetFontSize(FontSize + 1);
  for (const int which : { vtkAxis::LEFT, vtkAxis::BOTTOM })
  {
    vtkAxis* axis = drawn->GetAxis(which);
    axis->GetLabelProperties()->SetFontSize(FontSize);
    axis->SetTitle("");
    axis->GetGridPen()->SetColor(225, 225, 225);
    axis->SetBehavior(vtkAxis::FIXED);
  }
  vtkAxis* bottom = drawn->GetAxis(vtkAxis::BOTTOM);
  bottom->SetRange(0.0, chart == PhiD ? 180.0 : 90.0);
  vtkNew<vtkDoubleArray> degrees;
  vtkNew<vtkStringArray> words;
  for (int k = 0; k <= 3; ++k)
  {
    degrees->InsertNextValue((chart == PhiD ? 60.0 : 30.0) * k);
    words->InsertNextValue(std::to_string((chart == PhiD ? 60 : 30) * k));
  }
  bottom->SetCustomTickPositions(degrees, words);
  vtkAxis* left = drawn->GetAxis(vtkAxis::LEFT);
  if (logarithmic)
  {
    scale.Widen();
    const std::vector<double> ticks = scale.GetTicks();
    SetTicks(left, ticks);
    left->SetRange(scale.GetLeast(), scale.GetLargest());
  }
  else
  {
    left->SetCustomTickPositions(nullptr, nullptr);
    left->SetRange(0.0, largest > 0.0 ? 1.05 * largest : 1.0);
  }
  drawn->RecalculateBounds();
}

//------------------------------------------------------------------------------
// Two by two, the first in the upper left.
void SliceView::PlaceCharts()
{
  const auto ratio = static_cast<float>(this->devicePixelRatioF());
  const float width = ratio * static_cast<float>(this->width()) / 2.0f;
  const float height = ratio * static_cast<float>(this->height()) / 2.0f;
  for (int k = 0; k < 4; ++k)
  {
    const float gap = 4.0f * ratio;
    this->Charts[static_cast<std::size_t>(k)]->SetSize(
      vtkRectf(static_cast<float>(k % 2) * width + gap,
        static_cast<float>(1 - k / 2) * height + gap, width - 2.0f * gap, height - 2.0f * gap));
  }
}

//------------------------------------------------------------------------------
void SliceView::resizeEvent(QResizeEvent* event)
{
  QVTKOpenGLNativeWidget::resizeEvent(event);
  this->PlaceCharts();
}

//------------------------------------------------------------------------------
void SliceView::RequestRender()
{
  if (this->IsRequested)
  {
    return;
  }
  this->IsRequested = true;
  QTimer::singleShot(0, this,
    [this]()
    {
      this->IsRequested = false;
      if (this->isVisible())
      {
        this->Window->Render();
      }
    });
}

//------------------------------------------------------------------------------
// Nothing of VTK's: its keys would close the program.
bool SliceView::event(QEvent* event)
{
  switch (event->type())
  {
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::MouseButtonPress:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
    case QEvent::Wheel:
      return QOpenGLWidget::event(event);
    default:
      return QVTKOpenGLNativeWidget::event(event);
  }
}
} // namespace explorer
