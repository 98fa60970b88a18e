// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobePanel.h"

#include "Controls.h"

#include "vtkActor.h"
#include "vtkArcSource.h"
#include "vtkBRDFLobeSource.h"
#include "vtkCamera.h"
#include "vtkInteractorStyleTerrain.h"
#include "vtkLight.h"
#include "vtkLineSource.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMouseEvent>

#include <algorithm>
#include <cmath>

namespace explorer
{
namespace
{
constexpr double HandleRadius = 1.25; // of the sphere that the ball is on; lobes reach 1
constexpr double GrabDistance = 16.0; // pixels
constexpr double LobeKeyStep = 5.0;   // degrees
constexpr int Fine = 128;             // points of the lobe
constexpr int Coarse = 48;            // while the light moves

//------------------------------------------------------------------------------
vtkSmartPointer<vtkActor> MakeActor(vtkAlgorithm* source, const double rgb[3], double width)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(rgb[0], rgb[1], rgb[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->LightingOff();
  return actor;
}

//------------------------------------------------------------------------------
// A circle about z at a polar angle of the unit hemisphere.
vtkSmartPointer<vtkArcSource> MakeCircle(double degrees)
{
  const double theta = vtkMath::RadiansFromDegrees(degrees);
  auto circle = vtkSmartPointer<vtkArcSource>::New();
  circle->UseNormalAndAngleOn();
  circle->SetCenter(0.0, 0.0, std::cos(theta));
  circle->SetPolarVector(std::sin(theta), 0.0, 0.0);
  circle->SetNormal(0.0, 0.0, 1.0);
  circle->SetAngle(360.0);
  circle->SetResolution(96);
  return circle;
}

//------------------------------------------------------------------------------
void ToDirection(double thetaDegrees, double phiDegrees, double direction[3])
{
  const double theta = vtkMath::RadiansFromDegrees(thetaDegrees);
  const double phi = vtkMath::RadiansFromDegrees(phiDegrees);
  direction[0] = std::sin(theta) * std::cos(phi);
  direction[1] = std::sin(theta) * std::sin(phi);
  direction[2] = std::cos(theta);
}
}

//------------------------------------------------------------------------------
LobeView::LobeView(Session* session, QWidget* parent)
  : RenderView(tr("Lobe"), parent)
  , Model(session)
{
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(240, 200);
  this->setToolTip(tr(
    "Drag the yellow ball: the light's direction. Drag elsewhere: turn the view. Arrow keys move "
    "the light"));
  this->Window->AddRenderer(this->Renderer);
  this->MakeScene();
  vtkNew<vtkInteractorStyleTerrain> style;
  style->LatLongLinesOff();
  this->interactor()->SetInteractorStyle(style);
  for (const auto signal : { &Session::materialChanged, &Session::lobeChanged })
  {
    connect(session, signal, this, &LobeView::Update);
  }
}

//------------------------------------------------------------------------------
LobeView::~LobeView() = default;

//------------------------------------------------------------------------------
void LobeView::MakeScene()
{
  const double pale[3] = { 0.45, 0.46, 0.48 };
  const double yellow[3] = { 1.0, 0.82, 0.2 };
  const double white[3] = { 0.9, 0.9, 0.9 };
  const double red[3] = { 0.85, 0.35, 0.3 };
  const double blue[3] = { 0.4, 0.6, 1.0 };
  this->Renderer->SetBackground(0.16, 0.165, 0.175);
  this->Renderer->UseFXAAOn();
  for (const double degrees : { 30.0, 60.0, 90.0 })
  {
    this->Renderer->AddActor(MakeActor(MakeCircle(degrees), pale, degrees < 90.0 ? 1.0 : 2.0));
  }
  vtkNew<vtkLineSource> normal;
  vtkNew<vtkLineSource> tangent;
  for (vtkLineSource* line :
    { normal.Get(), tangent.Get(), this->Ray.Get(), this->Mirror.Get(), this->Through.Get() })
  {
    line->SetPoint1(0.0, 0.0, 0.0); // not VTK's default
  }
  normal->SetPoint2(0.0, 0.0, 1.15);
  tangent->SetPoint2(1.15, 0.0, 0.0);
  this->Renderer->AddActor(MakeActor(normal, blue, 2.0));
  this->Renderer->AddActor(MakeActor(tangent, red, 2.0));
  this->Renderer->AddActor(MakeActor(this->Ray, yellow, 2.0));
  this->Renderer->AddActor(MakeActor(this->Mirror, white, 1.0));
  this->Renderer->AddActor(MakeActor(this->Through, white, 1.0));
  this->Handle->SetRadius(0.05);
  this->Handle->SetThetaResolution(24);
  this->Handle->SetPhiResolution(16);
  this->Renderer->AddActor(MakeActor(this->Handle, yellow, 1.0));
  this->MakeLobe();
  this->PlaceCamera();
}

//------------------------------------------------------------------------------
void LobeView::MakeLobe()
{
  this->Source->NormalizeOn();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(this->Source->GetOutputPort());
  normals->SplittingOff();
  this->LobeMapper->SetInputConnection(normals->GetOutputPort());
  vtkNew<vtkLookupTable> colors; // of what is reflected, and transmitted
  colors->SetNumberOfTableValues(2);
  colors->SetTableValue(0, 0.56, 0.59, 0.64);
  colors->SetTableValue(1, 0.36, 0.66, 0.62);
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
}

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
  vtkBRDF* brdf = this->Model->GetMaterial().BRDF;
  if (!brdf)
  {
    return;
  }
  const State& state = this->Model->GetState();
  vtkBTDF* transmission = this->Model->GetMaterial().Transmission;
  if (this->IsTransmitting != (transmission != nullptr))
  {
    this->IsTransmitting = !this->IsTransmitting;
    this->PlaceCamera();
  }
  this->Source->SetTransmission(transmission);
  this->LobeMapper->SetScalarVisibility(transmission != nullptr);
  this->Source->SetBRDF(brdf);
  this->Source->SetThetaI(state.LobeThetaI);
  this->Source->SetPhiI(state.LobePhiI);
  this->Source->SetScaling(
    state.LobeLogarithmic ? vtkBRDFLobeSource::LOGARITHMIC : vtkBRDFLobeSource::LINEAR);
  const int resolution = this->IsDragging ? Coarse : Fine;
  this->Source->SetRadialResolution(resolution);
  this->Source->SetCircularResolution(resolution);
  this->Lobe->VisibilityOn();
  double light[3];
  ToDirection(state.LobeThetaI, state.LobePhiI, light);
  double mirror[3] = { -light[0], -light[1], light[2] };
  vtkMath::MultiplyScalar(light, HandleRadius);
  vtkMath::MultiplyScalar(mirror, HandleRadius);
  this->Ray->SetPoint2(light);
  this->Mirror->SetPoint2(mirror);
  const double length = transmission ? -1.0 : 0.0;
  this->Through->SetPoint2(length * light[0], length * light[1], length * light[2]);
  this->Handle->SetCenter(light);
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
  return { static_cast<int>(std::lround(display[0] / ratio)),
    static_cast<int>(std::lround(this->height() - 1 - display[1] / ratio)) };
}

//------------------------------------------------------------------------------
// Onto the ball's sphere where the mouse meets its front; beside it, onto its rim.
void LobeView::DragTo(const QPoint& place)
{
  const double ratio = this->devicePixelRatioF();
  double ends[2][3];
  for (int k = 0; k < 2; ++k)
  {
    this->Renderer->SetDisplayPoint(
      ratio * place.x(), ratio * (this->height() - 1 - place.y()), k == 0 ? 0.0 : 1.0);
    this->Renderer->DisplayToWorld();
    const double* world = this->Renderer->GetWorldPoint();
    for (int c = 0; c < 3; ++c)
    {
      ends[k][c] = world[c] / world[3];
    }
  }
  double ray[3];
  vtkMath::Subtract(ends[1], ends[0], ray);
  vtkMath::Normalize(ray);
  const double along = -vtkMath::Dot(ends[0], ray); // to the nearest point to the center
  double point[3];
  for (int c = 0; c < 3; ++c)
  {
    point[c] = ends[0][c] + along * ray[c];
  }
  const double rest = HandleRadius * HandleRadius - vtkMath::Dot(point, point);
  for (int c = 0; c < 3 && rest > 0.0; ++c)
  {
    point[c] -= std::sqrt(rest) * ray[c];
  }
  vtkMath::Normalize(point);
  const double theta = vtkMath::DegreesFromRadians(std::acos(std::clamp(point[2], -1.0, 1.0)));
  const double phi = vtkMath::DegreesFromRadians(std::atan2(point[1], point[0]));
  this->Model->SetLobe(std::min(theta, 89.0), phi, this->Model->GetState().LobeLogarithmic);
}

//------------------------------------------------------------------------------
bool LobeView::IsOverHandle(QMouseEvent* mouse)
{
  const QPoint distance = mouse->pos() - this->GetHandlePosition();
  return std::hypot(distance.x(), distance.y()) <= GrabDistance;
}

//------------------------------------------------------------------------------
bool LobeView::ObeyKey(QKeyEvent* press)
{
  const int key = press->key();
  const double phi = key == Qt::Key_Left ? -LobeKeyStep : key == Qt::Key_Right ? LobeKeyStep : 0.0;
  const double theta = key == Qt::Key_Up ? -LobeKeyStep : key == Qt::Key_Down ? LobeKeyStep : 0.0;
  if (phi == 0.0 && theta == 0.0)
  {
    return false;
  }
  const State& state = this->Model->GetState();
  this->Model->SetLobe(state.LobeThetaI + theta, state.LobePhiI + phi, state.LobeLogarithmic);
  return true;
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
  auto* note =
    new QLabel(QObject::tr("Above: reflected. Below, green: transmitted, on the same scale."));
  note->setObjectName("lobe note");
  note->setWordWrap(true);
  auto* row = new QHBoxLayout;
  AddNamed(row, QObject::tr("θ&i"), theta);
  AddNamed(row, QObject::tr("&φi"), phi);
  row->addWidget(logarithmic);
  row->addStretch(1);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(new LobeView(session), 1);
  layout->addWidget(note);

  const auto set = [=]()
  { session->SetLobe(theta->value(), phi->value(), logarithmic->isChecked()); };
  OnChange(theta, set);
  OnChange(phi, set);
  OnChange(logarithmic, set);
  const auto update = [=]()
  {
    const State& state = session->GetState();
    note->setVisible(session->GetMaterial().Transmission != nullptr);
    Show(theta, state.LobeThetaI);
    Show(phi, state.LobePhiI);
    Show(logarithmic, state.LobeLogarithmic);
  };
  for (const auto signal : { &Session::lobeChanged, &Session::materialChanged })
  {
    QObject::connect(session, signal, panel, update);
  }
  update();
  return panel;
}
} // namespace explorer
