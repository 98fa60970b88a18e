// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SplitView.h"

#include "Display.h"
#include "Scenes.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCoordinate.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkLineSource.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
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
#include "vtkTexturedActor2D.h"
#include "vtkTrivialProducer.h"

#include <QKeyEvent>
#include <QMouseEvent>

#include <algorithm>
#include <cmath>

namespace explorer
{
namespace
{
constexpr int GrabWidth = 7;        // pixels beside the line where it is taken
constexpr double LeastWidth = 3e-3; // of a side that is drawn, share of the window
constexpr double Fill = 0.9;        // as the tool's pictures
constexpr double Azimuth = 30.0;    // degrees
constexpr double Elevation = 20.0;  // degrees

//------------------------------------------------------------------------------
// Points of the data are shares of the view's width and height.
vtkSmartPointer<vtkPolyDataMapper2D> MakeViewportMapper(vtkAlgorithm* data)
{
  vtkNew<vtkCoordinate> coordinate;
  coordinate->SetCoordinateSystemToNormalizedViewport();
  auto mapper = vtkSmartPointer<vtkPolyDataMapper2D>::New();
  mapper->SetInputConnection(data->GetOutputPort());
  mapper->SetTransformCoordinate(coordinate);
  return mapper;
}

//------------------------------------------------------------------------------
// Of tool::MakeErrorColors, in percent, at the bottom of the view.
vtkSmartPointer<vtkScalarBarActor> MakeErrorLegend()
{
  auto legend = vtkSmartPointer<vtkScalarBarActor>::New();
  vtkNew<vtkLookupTable> table;
  const auto colors = tool::MakeErrorColors();
  constexpr int entries = 256;
  table->SetNumberOfTableValues(entries);
  table->SetScaleToLog10();
  table->SetTableRange(std::pow(10.0, tool::LowestError + 2.0), 100.0); // percent
  for (int k = 0; k < entries; ++k)
  {
    double rgb[3];
    colors->GetColor(
      tool::LowestError + (tool::HighestError - tool::LowestError) * (k + 0.5) / entries, rgb);
    table->SetTableValue(k, rgb[0], rgb[1], rgb[2]);
  }
  legend->SetLookupTable(table);
  legend->SetTitle("error, % of mean");
  legend->SetNumberOfLabels(4);
  legend->SetLabelFormat("%g");
  legend->SetUnconstrainedFontSize(true);
  for (vtkTextProperty* text : { legend->GetLabelTextProperty(), legend->GetTitleTextProperty() })
  {
    text->SetFontSize(14);
    text->ItalicOff();
    text->BoldOff();
  }
  legend->SetOrientationToHorizontal();
  legend->SetTextPositionToPrecedeScalarBar(); // the labels below the bar, the title below them
  legend->SetPosition(0.25, 0.02);
  legend->SetPosition2(0.5, 0.12);
  legend->DrawBackgroundOn();
  legend->GetBackgroundProperty()->SetColor(0.16, 0.165, 0.175);
  legend->GetBackgroundProperty()->SetOpacity(0.8);
  return legend;
}

//------------------------------------------------------------------------------
// The sphere of all directions of an environment, with its texture coordinates.
vtkSmartPointer<vtkPolyData> MakeSky()
{
  vtkNew<vtkPlaneSource> plane; // u and v in [0, 1], and the same as texture coordinates
  plane->SetOrigin(0.0, 0.0, 0.0);
  plane->SetPoint1(1.0, 0.0, 0.0);
  plane->SetPoint2(0.0, 1.0, 0.0);
  plane->SetResolution(96, 48);
  plane->Update();
  vtkSmartPointer<vtkPolyData> sky = plane->GetOutput();
  for (vtkIdType k = 0; k < sky->GetNumberOfPoints(); ++k)
  {
    double place[3];
    double direction[3];
    sky->GetPoint(k, place);
    vtkEnvironment::GetDirection(place[0], place[1], direction);
    sky->GetPoints()->SetPoint(k, direction);
  }
  return sky;
}
}

/// An image of the whole view, of which a vertical strip is shown.
class ImageQuad
{
public:
  explicit ImageQuad(vtkRenderer* renderer)
  {
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, 2, 3 });
    this->Points->SetNumberOfPoints(4);
    this->Coordinates->SetNumberOfComponents(2);
    this->Coordinates->SetNumberOfTuples(4);
    this->Quad->SetPoints(this->Points);
    this->Quad->SetPolys(cells);
    this->Quad->GetPointData()->SetTCoords(this->Coordinates);
    vtkNew<vtkTrivialProducer> producer;
    producer->SetOutput(this->Quad);
    this->Texture->SetColorModeToDirectScalars();
    this->Texture->InterpolateOn();
    this->Actor->SetMapper(MakeViewportMapper(producer));
    this->Actor->SetTexture(this->Texture);
    this->Actor->SetLayerNumber(0);
    this->Actor->VisibilityOff();
    renderer->AddViewProp(this->Actor);
  }

  /// RGBA of unsigned char, any size; null: none.
  void SetImage(vtkImageData* image)
  {
    this->HasImage = image != nullptr;
    if (image)
    {
      this->Texture->SetInputData(image);
    }
  }

  /// The strip's ends, shares of the view's width; and whether the image, where there is one, is
  /// shown.
  void Show(double begin, double end, bool visible)
  {
    const double corners[4][3] = { { begin, 0.0 }, { end, 0.0 }, { end, 1.0 }, { begin, 1.0 } };
    for (int k = 0; k < 4; ++k)
    {
      this->Points->SetPoint(k, corners[k]);
      this->Coordinates->SetTuple(k, corners[k]);
    }
    this->Points->Modified();
    this->Coordinates->Modified();
    this->Actor->SetVisibility(visible && this->HasImage);
  }

  bool HasImage = false;

private:
  vtkNew<vtkPoints> Points;
  vtkNew<vtkFloatArray> Coordinates;
  vtkNew<vtkPolyData> Quad;
  vtkNew<vtkTexture> Texture;
  vtkNew<vtkTexturedActor2D> Actor;
};

//------------------------------------------------------------------------------
SplitView::SplitView(Session* session, Jobs* jobs, std::array<Side*, 2> sides, QWidget* parent)
  : RenderView(tr("Picture by method A and method B"), parent)
  , Model(session)
  , Background(jobs)
  , Sides(sides)
{
  this->HandleCursor = Qt::SplitHCursor;
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(320, 240);
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
  for (auto& quad : this->Quads)
  {
    quad = std::make_unique<ImageQuad>(this->Front);
  }
  this->MakeLabels();

  vtkNew<vtkInteractorStyleTrackballCamera> style;
  style->AutoAdjustCameraClippingRangeOff(); // PlaceCameras does that
  style->AddObserver(vtkCommand::InteractionEvent, this, &SplitView::OnMoved);
  style->AddObserver(vtkCommand::EndInteractionEvent, this, &SplitView::OnMoved);
  this->interactor()->SetInteractorStyle(style);
  style->SetDefaultRenderer(this->Front);
  this->Window->AddObserver(vtkCommand::StartEvent, this, &SplitView::PlaceCameras);

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
  this->Line->SetMapper(MakeViewportMapper(this->LineSource));
  this->Line->GetProperty()->SetColor(1.0, 1.0, 1.0);
  this->Line->GetProperty()->SetLineWidth(2.0f);
  this->Line->SetLayerNumber(1);
  this->Front->AddViewProp(this->Line);
  for (int k = 0; k < 2; ++k)
  {
    vtkTextActor* label = this->Labels[k];
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
  return this->Model->GetState().Show == Shown::Difference && this->Quads[DifferenceQuad]->HasImage;
}

//------------------------------------------------------------------------------
void SplitView::SetPicture(int side, std::shared_ptr<const tool::Picture> radiance)
{
  if (radiance != this->Pictures[side])
  {
    this->Pictures[side] = radiance;
    this->Quads[side]->SetImage(radiance ? MakeImage(*radiance, this->Factor).Get() : nullptr);
    this->UpdatePicture();
  }
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
  vtkTextActor* label = this->Labels[side];
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
    this->Quads[k]->Show(ends[k][0], ends[k][1], difference == (k == DifferenceQuad));
  }
  for (std::size_t k = 0; k < 2; ++k)
  {
    // Never nothing: a side that is not seen is drawn, and so planned for, too.
    this->Sides[k]->GetRenderer()->SetViewport(
      std::min(ends[k][0], 1.0 - LeastWidth), 0.0, std::max(ends[k][1], LeastWidth), 1.0);
    this->Sides[k]->SetVisible(!this->Quads[k]->HasImage);
    this->Labels[k]->SetVisibility(!difference);
  }
  this->LineSource->SetPoint1(split, 0.0, 0.0);
  this->LineSource->SetPoint2(split, 1.0, 0.0);
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
  this->Background->Compute(
    "backdrop", tr("drawing the backdrop"),
    [environment]() { return MakeBackdropPicture(environment); },
    [this](const tool::Picture& picture)
    {
      this->BackdropPicture = std::make_shared<const tool::Picture>(picture);
      this->ShowBackdrop();
      this->UpdatePicture();
    });
  this->UpdatePicture();
}

//------------------------------------------------------------------------------
void SplitView::ResetCamera()
{
  tool::PlaceCamera(this->Camera, this->Model->GetMesh(), { Azimuth, Elevation }, Fill,
    static_cast<double>(this->width()) / std::max(1, this->height()));
  this->OnMoved();
  this->RequestRender();
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
  this->Model->Edit(&Session::cameraChanged,
    [this](State& state)
    {
      this->Camera->GetPosition(state.Camera.Position.data());
      this->Camera->GetFocalPoint(state.Camera.FocalPoint.data());
      this->Camera->GetViewUp(state.Camera.ViewUp.data());
      state.Camera.ViewAngle = this->Camera->GetViewAngle();
    });
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
bool SplitView::IsOverHandle(QMouseEvent* mouse)
{
  return std::abs(mouse->pos().x() - this->GetLinePosition()) <= GrabWidth && !this->IsDifference();
}

//------------------------------------------------------------------------------
void SplitView::DragTo(const QPoint& place)
{
  this->Model->SetSplit(static_cast<double>(place.x()) / std::max(1, this->width()));
}

//------------------------------------------------------------------------------
void SplitView::keyPressEvent(QKeyEvent* event)
{
  const int right = (event->key() == Qt::Key_Right) - (event->key() == Qt::Key_Left);
  this->Model->SetSplit(this->Model->GetState().Split + 0.01 * right);
  event->setAccepted(right != 0);
}
} // namespace explorer
