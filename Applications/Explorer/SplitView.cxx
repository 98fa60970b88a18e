// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SplitView.h"

#include "Display.h"
#include "Overlays.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty.h"
#include "vtkProperty2D.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"

#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QTimer>

#include <algorithm>
#include <cmath>

namespace
{
constexpr int GrabWidth = 7;        // pixels beside the line where it is taken
constexpr double LeastWidth = 3e-3; // of a side that is drawn, share of the window
constexpr double Fill = 0.9;        // as the tool's pictures
constexpr double Azimuth = 30.0;    // degrees
constexpr double Elevation = 20.0;  // degrees
}

namespace explorer
{
//------------------------------------------------------------------------------
SplitView::SplitView(Session* session, Jobs* jobs, std::array<Side*, 2> sides, QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , Model(session)
  , Background(jobs)
  , Sides(sides)
  , Light(session)
{
  this->setRenderWindow(this->Window);
  this->setAcceptDrops(false); // the window's
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(320, 240);
  this->setToolTip(QString());
  this->setAccessibleName(tr("Picture by method A and method B"));
  this->Window->SetMultiSamples(0);
  this->Window->SetNumberOfLayers(3);

  this->Behind->SetLayer(0);
  this->Behind->SetBackground(0.16, 0.165, 0.175);
  this->Behind->InteractiveOff();
  vtkNew<vtkPolyDataMapper> skyMapper;
  skyMapper->SetInputData(MakeSky());
  this->BackdropActor->SetMapper(skyMapper);
  this->BackdropActor->GetProperty()->LightingOff();
  this->BackdropActor->VisibilityOff();
  this->BackdropTexture->InterpolateOn();
  this->Behind->AddActor(this->BackdropActor);
  this->Window->AddRenderer(this->Behind);
  for (Side* side : this->Sides)
  {
    side->GetRenderer()->SetLayer(1);
    side->GetRenderer()->InteractiveOff();
    side->GetRenderer()->UseFXAAOn();
    this->Window->AddRenderer(side->GetRenderer());
    connect(side, &Side::changed, this, &SplitView::RequestRender);
  }
  this->Front->SetLayer(2);
  this->Window->AddRenderer(this->Front);
  this->Camera = this->Front->GetActiveCamera();
  for (int k = 0; k < 3; ++k)
  {
    this->Quads[static_cast<std::size_t>(k)] = std::make_unique<ImageQuad>(this->Front);
  }
  this->MakeLabels();

  vtkNew<vtkInteractorStyleTrackballCamera> style;
  style->AutoAdjustCameraClippingRangeOff(); // PlaceCameras does that
  style->AddObserver(vtkCommand::InteractionEvent, this, &SplitView::OnMoved);
  style->AddObserver(vtkCommand::EndInteractionEvent, this, &SplitView::OnMoved);
  this->interactor()->SetInteractorStyle(style);
  style->SetDefaultRenderer(this->Front);
  this->Window->AddObserver(vtkCommand::StartEvent, this, &SplitView::OnBegin);
  this->Window->AddObserver(vtkCommand::EndEvent, this, &SplitView::OnEnd);

  connect(session, &Session::pictureChanged, this, &SplitView::UpdatePicture);
  connect(session, &Session::rotationChanged, this, &SplitView::UpdatePicture);
  connect(session, &Session::environmentChanged, this, &SplitView::UpdateBackdrop);
  connect(session, &Session::lightChanged, this, &SplitView::RequestRender);
  connect(session, &Session::meshChanged, this, &SplitView::ResetCamera);
  connect(session, &Session::cameraReplaced, this, &SplitView::TakeCamera);
  this->UpdatePicture();
}

//------------------------------------------------------------------------------
SplitView::~SplitView() = default;

//------------------------------------------------------------------------------
void SplitView::MakeLabels()
{
  vtkNew<vtkCellArray> cells;
  const vtkIdType ends[2] = { 0, 1 };
  cells->InsertNextCell(2, ends);
  this->LinePoints->SetNumberOfPoints(2);
  vtkNew<vtkPolyData> line;
  line->SetPoints(this->LinePoints);
  line->SetLines(cells);
  this->Line->SetMapper(MakeViewportMapper(line));
  this->Line->GetProperty()->SetColor(1.0, 1.0, 1.0);
  this->Line->GetProperty()->SetLineWidth(2.0f);
  this->Line->SetLayerNumber(1);
  this->Front->AddViewProp(this->Line);
  for (int k = 0; k < 2; ++k)
  {
    vtkTextActor* label = this->Labels[static_cast<std::size_t>(k)];
    vtkTextProperty* text = label->GetTextProperty();
    text->SetFontSize(15);
    text->SetColor(1.0, 1.0, 1.0);
    text->SetBackgroundColor(0.1, 0.1, 0.11);
    text->SetBackgroundOpacity(0.7);
    text->SetVerticalJustificationToTop();
    k == 0 ? text->SetJustificationToLeft() : text->SetJustificationToRight();
    label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    label->SetPosition(k == 0 ? 0.01 : 0.99, 0.985); // B's line is below A's: PlaceCameras
    label->SetLayerNumber(2);
    this->Front->AddViewProp(label);
  }
  this->Legend = MakeErrorLegend();
  this->Legend->VisibilityOff();
  this->Front->AddViewProp(this->Legend);
}

//------------------------------------------------------------------------------
bool SplitView::IsDifference() const
{
  return this->Model->GetState().Show == Shown::Difference &&
         this->Quads[DifferenceQuad]->HasImage();
}

//------------------------------------------------------------------------------
void SplitView::SetPicture(int side, std::shared_ptr<const tool::Picture> radiance)
{
  const auto k = static_cast<std::size_t>(side);
  if (radiance == this->Pictures[k])
  {
    return;
  }
  this->Pictures[k] = radiance;
  this->Quads[k]->SetImage(radiance ? MakeImage(*radiance, this->Factor).Get() : nullptr);
  this->UpdatePicture();
}

//------------------------------------------------------------------------------
void SplitView::SetDifference(vtkImageData* colors)
{
  this->Quads[DifferenceQuad]->SetImage(colors);
  this->UpdatePicture();
}

//------------------------------------------------------------------------------
void SplitView::SetLabel(int side, const QString& text)
{
  const std::string words = (" " + text + " ").toStdString();
  vtkTextActor* label = this->Labels[static_cast<std::size_t>(side)];
  if (!label->GetInput() || words != label->GetInput())
  {
    label->SetInput(words.c_str());
    this->RequestRender();
  }
}

//------------------------------------------------------------------------------
void SplitView::UpdateExposure()
{
  const double factor =
    FindExposure(this->Model->GetEnvironment(), this->Model->GetState().Exposure);
  if (factor == this->Factor)
  {
    return;
  }
  this->Factor = factor;
  for (std::size_t k = 0; k < 2; ++k)
  {
    this->Sides[k]->SetExposure(factor);
    if (this->Pictures[k])
    {
      this->Quads[k]->SetImage(MakeImage(*this->Pictures[k], factor));
    }
  }
  this->ShowBackdrop();
}

//------------------------------------------------------------------------------
void SplitView::ShowBackdrop()
{
  if (this->BackdropPicture)
  {
    this->BackdropTexture->SetInputData(MakeImage(*this->BackdropPicture, this->Factor));
    this->BackdropActor->SetTexture(this->BackdropTexture);
  }
}

//------------------------------------------------------------------------------
void SplitView::UpdatePicture()
{
  const State& state = this->Model->GetState();
  const bool difference = this->IsDifference();
  const double split = state.Split;
  const double ends[3][2] = { { 0.0, split }, { split, 1.0 }, { 0.0, 1.0 } };
  for (int k = 0; k < 3; ++k)
  {
    ImageQuad& quad = *this->Quads[static_cast<std::size_t>(k)];
    quad.SetSpan(ends[k][0], ends[k][1]);
    quad.SetVisible(difference == (k == DifferenceQuad));
  }
  for (std::size_t k = 0; k < 2; ++k)
  {
    // Never nothing: a side that is not seen is drawn, and so planned for, too.
    this->Sides[k]->GetRenderer()->SetViewport(
      std::min(ends[k][0], 1.0 - LeastWidth), 0.0, std::max(ends[k][1], LeastWidth), 1.0);
    this->Sides[k]->SetVisible(!this->Quads[k]->HasImage());
    this->Labels[k]->SetVisibility(!difference);
  }
  this->LinePoints->SetPoint(0, split, 0.0, 0.0);
  this->LinePoints->SetPoint(1, split, 1.0, 0.0);
  this->LinePoints->Modified();
  this->Line->SetVisibility(!difference);
  this->Legend->SetVisibility(difference);
  this->BackdropActor->SetOrientation(0.0, state.Rotation, 0.0);
  this->BackdropActor->SetVisibility(state.Backdrop && this->BackdropPicture && !difference);
  this->UpdateExposure();
  this->RequestRender();
}

//------------------------------------------------------------------------------
void SplitView::UpdateBackdrop()
{
  if (!this->Model->GetEnvironment()) // there is nothing behind a directional light
  {
    this->Background->Stop("backdrop");
    this->BackdropPicture.reset();
    this->UpdatePicture();
    return;
  }
  const auto environment =
    vtkSmartPointer<vtkEnvironment>::Take(this->Model->GetEnvironment()->NewSnapshot());
  this->Background->Start(
    "backdrop", tr("drawing the backdrop"),
    [this, environment](JobThread& thread)
    {
      auto picture = std::make_shared<const tool::Picture>(MakeBackdropPicture(environment));
      thread.Post(
        [this, picture]()
        {
          this->BackdropPicture = picture;
          this->ShowBackdrop();
          this->UpdatePicture();
        });
    },
    [this](const QString& text) { this->Model->Say(text, true); });
  this->UpdatePicture();
}

//------------------------------------------------------------------------------
void SplitView::ResetCamera()
{
  vtkPolyData* mesh = this->Model->GetMesh();
  double bounds[6];
  mesh->GetBounds(bounds);
  const double center[3] = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
    0.5 * (bounds[4] + bounds[5]) };
  double radius = 0.0;
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
  {
    radius = std::max(radius, vtkMath::Distance2BetweenPoints(mesh->GetPoint(k), center));
  }
  radius = radius > 0.0 ? std::sqrt(radius) : 1.0;
  CameraState camera;
  const double aspect = static_cast<double>(this->width()) / std::max(1, this->height());
  const double share =
    Fill * std::min(1.0, aspect) * std::tan(vtkMath::RadiansFromDegrees(0.5 * camera.ViewAngle));
  const double distance = radius * std::sqrt(1.0 + 1.0 / (share * share));
  const double azimuth = vtkMath::RadiansFromDegrees(Azimuth);
  const double elevation = vtkMath::RadiansFromDegrees(Elevation);
  const double direction[3] = { std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth) };
  for (std::size_t c = 0; c < 3; ++c)
  {
    camera.FocalPoint[c] = center[c];
    camera.Position[c] = center[c] + distance * direction[c];
  }
  this->Model->SetCamera(camera);
  this->TakeCamera();
}

//------------------------------------------------------------------------------
void SplitView::TakeCamera()
{
  const CameraState& camera = this->Model->GetState().Camera;
  this->Camera->SetPosition(camera.Position.data());
  this->Camera->SetFocalPoint(camera.FocalPoint.data());
  this->Camera->SetViewUp(camera.ViewUp.data());
  this->Camera->SetViewAngle(camera.ViewAngle);
  this->RequestRender();
}

//------------------------------------------------------------------------------
void SplitView::OnMoved()
{
  CameraState camera;
  this->Camera->GetPosition(camera.Position.data());
  this->Camera->GetFocalPoint(camera.FocalPoint.data());
  this->Camera->GetViewUp(camera.ViewUp.data());
  camera.ViewAngle = this->Camera->GetViewAngle();
  this->Model->SetCamera(camera);
}

//------------------------------------------------------------------------------
// In a window of width W a part from x0 to x1 has the width w = x1 - x0. Its camera has the same
// vertical angle; VTK's window center shifts its picture so that it continues the other part's.
void SplitView::PlaceCameras()
{
  vtkPolyData* mesh = this->Model->GetMesh();
  vtkRenderer* renderers[3] = { this->Sides[0]->GetRenderer(), this->Sides[1]->GetRenderer(),
    this->Behind.Get() };
  for (int k = 0; k < 3; ++k)
  {
    vtkCamera* camera = renderers[k]->GetActiveCamera();
    camera->SetPosition(this->Camera->GetPosition());
    camera->SetFocalPoint(this->Camera->GetFocalPoint());
    camera->SetViewUp(this->Camera->GetViewUp());
    camera->SetViewAngle(this->Camera->GetViewAngle());
    const double* part = renderers[k]->GetViewport();
    camera->SetWindowCenter((part[0] + part[2] - 1.0) / (part[2] - part[0]), 0.0);
    if (k < 2 && mesh)
    {
      renderers[k]->ResetCameraClippingRange(mesh->GetBounds());
    }
  }
  constexpr double line = 26.0; // pixels
  this->Labels[1]->SetPosition(0.99, 0.985 - line / std::max(1, this->height()));
  // Behind everything there are only directions.
  double forward[3];
  this->Camera->GetDirectionOfProjection(forward);
  vtkCamera* behind = this->Behind->GetActiveCamera();
  behind->SetPosition(0.0, 0.0, 0.0);
  behind->SetFocalPoint(forward);
  behind->SetClippingRange(0.01, 2.0);
}

//------------------------------------------------------------------------------
void SplitView::OnBegin()
{
  this->PlaceCameras();
  this->Begin = std::chrono::steady_clock::now();
}

//------------------------------------------------------------------------------
void SplitView::OnEnd()
{
  this->Window->WaitForCompletion();
  emit this->framed(
    std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - this->Begin)
      .count());
}

//------------------------------------------------------------------------------
void SplitView::RequestRender()
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
// A frame that is not shown is drawn to the end.
QImage SplitView::Grab()
{
  for (const bool shows : { false, true })
  {
    this->Window->SetSwapBuffers(shows);
    this->Window->Render();
  }
  return this->grabFramebuffer();
}

//------------------------------------------------------------------------------
int SplitView::GetLinePosition() const
{
  return static_cast<int>(std::lround(this->Model->GetState().Split * this->width()));
}

//------------------------------------------------------------------------------
bool SplitView::DragLine(QEvent* event)
{
  auto* mouse = static_cast<QMouseEvent*>(event);
  const bool near =
    std::abs(mouse->pos().x() - this->GetLinePosition()) <= GrabWidth && !this->IsDifference();
  switch (event->type())
  {
    case QEvent::MouseButtonPress:
      this->IsDragging = near && mouse->button() == Qt::LeftButton;
      break;
    case QEvent::MouseMove:
      if (this->IsDragging)
      {
        this->Model->SetSplit(static_cast<double>(mouse->pos().x()) / std::max(1, this->width()));
      }
      else if (mouse->buttons() == Qt::NoButton)
      {
        near ? this->setCursor(Qt::SplitHCursor) : this->unsetCursor();
      }
      break;
    case QEvent::MouseButtonRelease:
      if (this->IsDragging)
      {
        this->IsDragging = false;
        return true;
      }
      break;
    default:
      break;
  }
  return this->IsDragging;
}

//------------------------------------------------------------------------------
bool SplitView::event(QEvent* event)
{
  if (this->Light.Handle(event, this->Camera))
  {
    event->accept();
    return true;
  }
  switch (event->type())
  {
    case QEvent::MouseButtonPress:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
      if (this->DragLine(event))
      {
        event->accept();
        return true;
      }
      break;
    case QEvent::KeyPress:
    {
      const int key = static_cast<QKeyEvent*>(event)->key();
      if (key == Qt::Key_Left || key == Qt::Key_Right)
      {
        this->Model->SetSplit(this->Model->GetState().Split + (key == Qt::Key_Left ? -0.01 : 0.01));
        return true;
      }
      return QOpenGLWidget::event(event); // VTK's own keys would close the program
    }
    case QEvent::KeyRelease:
      return QOpenGLWidget::event(event);
    default:
      break;
  }
  return QVTKOpenGLNativeWidget::event(event);
}
} // namespace explorer
