// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobePanel.h"

#include "Controls.h"

#include "vtkActor.h"
#include "vtkBRDFLobeSource.h"
#include "vtkCamera.h"
#include "vtkInteractorStyleTerrain.h"
#include "vtkLineSource.h"
#include "vtkLookupTable.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRegularPolygonSource.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <QMouseEvent>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace explorer
{
namespace
{
constexpr double HandleRadius = 1.25; // of the sphere that the ball is on; lobes reach 1
constexpr double GrabDistance = 16.0; // pixels
constexpr int Fine = 128;             // points of the lobe
constexpr int Coarse = 48;            // while the light moves
}

//------------------------------------------------------------------------------
LobeView::LobeView(Session* session)
  : RenderView(tr("Lobe"))
  , Model(session)
{
  this->setMinimumSize(240, 200);
  this->setToolTip(
    tr("Drag the yellow ball: the light's direction. Drag elsewhere: turn the view"));
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.16, 0.165, 0.175);
  this->Renderer->UseFXAAOn();
  const auto add = [this](vtkAlgorithm* source, const glm::dvec3& rgb, float width)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(rgb.x, rgb.y, rgb.z);
    actor->GetProperty()->SetLineWidth(width);
    actor->GetProperty()->LightingOff();
    this->Renderer->AddActor(actor);
  };
  for (const double degrees : { 30.0, 60.0, 90.0 }) // circles of the unit hemisphere
  {
    const double theta = glm::radians(degrees);
    vtkNew<vtkRegularPolygonSource> circle;
    circle->GeneratePolygonOff();
    circle->SetNumberOfSides(96);
    circle->SetCenter(0.0, 0.0, std::cos(theta));
    circle->SetRadius(std::sin(theta));
    add(circle, { 0.45, 0.46, 0.48 }, degrees < 90.0 ? 1.0f : 2.0f);
  }
  const glm::dvec3 yellow(1.0, 0.82, 0.2);
  const glm::dvec3 white(0.9);
  vtkNew<vtkLineSource> normal, tangent;
  for (vtkLineSource* line :
    { normal.Get(), tangent.Get(), this->Ray.Get(), this->Mirror.Get(), this->Through.Get() })
  {
    line->SetPoint1(0.0, 0.0, 0.0); // not VTK's default
  }
  normal->SetPoint2(0.0, 0.0, 1.15);
  tangent->SetPoint2(1.15, 0.0, 0.0);
  this->Handle->SetRadius(0.05);
  this->Handle->SetThetaResolution(24);
  this->Handle->SetPhiResolution(16);
  add(normal, { 0.4, 0.6, 1.0 }, 2.0f);
  add(tangent, { 0.85, 0.35, 0.3 }, 2.0f);
  add(this->Ray, yellow, 2.0f);
  add(this->Mirror, white, 1.0f);
  add(this->Through, white, 1.0f);
  add(this->Handle, yellow, 1.0f);

  this->Source->NormalizeOn();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(this->Source->GetOutputPort());
  normals->SplittingOff();
  vtkNew<vtkLookupTable> colors; // of what is reflected, and transmitted
  colors->SetNumberOfTableValues(2);
  colors->SetTableValue(0, 0.56, 0.59, 0.64);
  colors->SetTableValue(1, 0.36, 0.66, 0.62);
  this->LobeMapper->SetInputConnection(normals->GetOutputPort());
  this->LobeMapper->SetLookupTable(colors);
  this->LobeMapper->SetScalarRange(0.0, 1.0);
  this->LobeMapper->SetScalarModeToUsePointFieldData();
  this->LobeMapper->SelectColorArray("Transmitted");
  this->LobeMapper->ScalarVisibilityOff();
  this->Lobe->SetMapper(this->LobeMapper);
  this->Lobe->GetProperty()->SetColor(0.56, 0.59, 0.64);
  this->Lobe->GetProperty()->SetSpecular(0.15);
  this->Lobe->GetProperty()->SetAmbient(0.15);
  this->Lobe->VisibilityOff(); // until there is a material
  this->Renderer->AddActor(this->Lobe);
  this->PlaceCamera();

  vtkNew<vtkInteractorStyleTerrain> style;
  style->LatLongLinesOff();
  this->interactor()->SetInteractorStyle(style);
  Follow(session, this, { &Session::materialChanged, &Session::lobeChanged },
    [this]() { this->Update(); });
}

//------------------------------------------------------------------------------
LobeView::~LobeView() = default;

//------------------------------------------------------------------------------
// On the upper half, or both.
void LobeView::PlaceCamera()
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetFocalPoint(0.0, 0.0, this->IsTransmitting ? 0.05 : 0.42);
  camera->SetPosition(0.6, this->IsTransmitting ? -5.0 : -4.2, this->IsTransmitting ? 1.4 : 2.2);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(32.0);
  camera->SetClippingRange(0.1, 20.0);
}

//------------------------------------------------------------------------------
void LobeView::Update()
{
  const tool::Material& material = this->Model->GetMaterial();
  if (!material.BRDF)
  {
    return;
  }
  const State& state = this->Model->GetState();
  const bool isTransmitting = material.Transmission != nullptr;
  if (this->IsTransmitting != isTransmitting)
  {
    this->IsTransmitting = isTransmitting;
    this->PlaceCamera();
  }
  this->LobeMapper->SetScalarVisibility(isTransmitting);
  const int resolution = this->IsDragging ? Coarse : Fine;
  this->Source->SetTransmission(material.Transmission);
  this->Source->SetBRDF(material.BRDF);
  this->Source->SetThetaI(state.LobeThetaI);
  this->Source->SetPhiI(state.LobePhiI);
  this->Source->SetScaling(
    state.LobeLogarithmic ? vtkBRDFLobeSource::LOGARITHMIC : vtkBRDFLobeSource::LINEAR);
  this->Source->SetRadialResolution(resolution);
  this->Source->SetCircularResolution(resolution);
  this->Lobe->VisibilityOn();
  const double theta = glm::radians(state.LobeThetaI);
  const double phi = glm::radians(state.LobePhiI);
  const glm::dvec3 light = HandleRadius * glm::dvec3(std::sin(theta) * std::cos(phi),
                                            std::sin(theta) * std::sin(phi), std::cos(theta));
  const double through = isTransmitting ? -1.0 : 0.0;
  this->Ray->SetPoint2(light.x, light.y, light.z);
  this->Mirror->SetPoint2(-light.x, -light.y, light.z);
  this->Through->SetPoint2(through * light.x, through * light.y, through * light.z);
  this->Handle->SetCenter(light.x, light.y, light.z);
  this->RequestRender();
}

//------------------------------------------------------------------------------
void LobeView::PrepareFrame()
{
  this->Renderer->ResetCameraClippingRange();
  this->Renderer->GetActiveCamera()->SetUseHorizontalViewAngle(
    this->width() < this->height()); // the smaller side holds all of it
}

//------------------------------------------------------------------------------
QPoint LobeView::GetHandlePosition()
{
  const double* center = this->Handle->GetCenter();
  this->Renderer->SetWorldPoint(center[0], center[1], center[2], 1.0);
  this->Renderer->WorldToDisplay();
  const double* display = this->Renderer->GetDisplayPoint();
  const double ratio = this->devicePixelRatioF();
  return QPointF(display[0] / ratio, this->height() - 1 - display[1] / ratio).toPoint();
}

//------------------------------------------------------------------------------
// Onto the ball's sphere where the mouse meets its front; beside it, onto its rim.
void LobeView::DragTo(const QPoint& place)
{
  const double ratio = this->devicePixelRatioF();
  glm::dvec3 ends[2];
  for (int k = 0; k < 2; ++k)
  {
    this->Renderer->SetDisplayPoint(ratio * place.x(), ratio * (this->height() - 1 - place.y()), k);
    this->Renderer->DisplayToWorld();
    const double* world = this->Renderer->GetWorldPoint();
    ends[k] = glm::dvec3(world[0], world[1], world[2]) / world[3];
  }
  const glm::dvec3 ray = glm::normalize(ends[1] - ends[0]);
  glm::dvec3 point = ends[0] - glm::dot(ends[0], ray) * ray; // the nearest to the center
  const double rest = HandleRadius * HandleRadius - glm::dot(point, point);
  point = glm::normalize(point - std::sqrt(std::max(rest, 0.0)) * ray);
  const double theta = glm::degrees(std::acos(std::clamp(point.z, -1.0, 1.0)));
  this->Model->SetLobe(std::min(theta, 89.0), glm::degrees(std::atan2(point.y, point.x)));
}

//------------------------------------------------------------------------------
bool LobeView::IsOverHandle(QMouseEvent* mouse)
{
  const QPoint distance = mouse->pos() - this->GetHandlePosition();
  return std::hypot(distance.x(), distance.y()) <= GrabDistance;
}

//------------------------------------------------------------------------------
QWidget* MakeLobePanel(Session* session)
{
  auto* panel = new QWidget;
  auto* theta =
    MakeField(0.0, 89.0, 1, 5.0, "°", QObject::tr("Angle between the light and the normal (blue)"));
  auto* phi =
    MakeField(0.0, 360.0, 1, 5.0, "°", QObject::tr("Azimuth of the light from the tangent (red)"));
  phi->setWrapping(true);
  auto* logarithmic = MakeBox(QObject::tr("Lo&garithmic"),
    QObject::tr("Lengths by ln(1 + 100 L), which shows the matte part beside a highlight"));
  const auto bind = [session](auto* control, auto value)
  { return Bind(control, session, &Session::lobeChanged, value); };
  auto* row = new QHBoxLayout;
  AddNamed(row, QObject::tr("θ&i"), bind(theta, &State::LobeThetaI));
  AddNamed(row, QObject::tr("&φi"), bind(phi, &State::LobePhiI));
  row->addWidget(bind(logarithmic, &State::LobeLogarithmic));
  row->addStretch(1);
  auto* note =
    new QLabel(QObject::tr("Above: reflected. Below, green: transmitted, on the same scale."));
  note->setObjectName("lobe note");
  note->setWordWrap(true);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(new LobeView(session), 1);
  layout->addWidget(note);
  Follow(session, panel, { &Session::materialChanged },
    [=]() { note->setVisible(session->GetMaterial().Transmission != nullptr); });
  return panel;
}
} // namespace explorer
