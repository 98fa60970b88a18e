// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The picture: two methods side by side in one view, divided by a line that can be dragged.
 */

#ifndef SplitView_h
#define SplitView_h

#include "Picture.h"
#include "RenderView.h"
#include "Session.h"
#include "Side.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <array>
#include <memory>

class vtkActor;
class vtkActor2D;
class vtkLineSource;
class vtkRenderer;
class vtkScalarBarActor;
class vtkTextActor;
class vtkTexture;

namespace explorer
{
class ImageQuad;

/**
 * Left of the line is side A, right of it side B. Each has a viewport and a camera that looks
 * through its part of the window, so that no pixel is drawn twice. Pictures that the CPU made lie
 * over their side.
 */
class SplitView : public RenderView
{
  Q_OBJECT

public:
  SplitView(Session* session, Jobs* jobs, std::array<Side*, 2> sides, QWidget* parent = nullptr);
  ~SplitView() override;

  /// Radiance that lies over a side; null: none.
  void SetPicture(int side, std::shared_ptr<const tool::Picture> radiance);

  /// Colors that lie over everything where State::Show asks for the difference; null: none.
  void SetDifference(vtkImageData* colors);

  /// The line of text at the top of a side.
  void SetLabel(int side, const QString& text);

  /// What is seen through the whole window.
  vtkCamera* GetCamera() const { return this->Camera; }

  /// Look at the whole mesh from where the tool's pictures are seen.
  void ResetCamera();

  /// What is shown, once all samples are drawn.
  QImage Grab();

  /// Where the line is, in the widget's pixels.
  int GetLinePosition() const;

protected:
  bool IsOverHandle(QMouseEvent* mouse) override;
  void DragTo(const QPoint& place) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  void UpdatePicture();
  void UpdateExposure();
  void ShowBackdrop();
  void UpdateBackdrop();
  void MakeLabels();
  void PlaceCameras();
  void OnMoved();
  void TakeCamera();
  bool IsDifference() const;

  static constexpr int DifferenceQuad = 2; // over everything; the others over their sides

  Session* Model;
  Jobs* Background;
  std::array<Side*, 2> Sides;
  vtkNew<vtkRenderer> Behind;
  vtkNew<vtkRenderer> Front;
  vtkSmartPointer<vtkCamera> Camera;
  vtkNew<vtkActor> BackdropActor;
  vtkNew<vtkTexture> BackdropTexture;
  std::shared_ptr<const tool::Picture> BackdropPicture;
  std::array<std::unique_ptr<ImageQuad>, 3> Quads;
  std::array<std::shared_ptr<const tool::Picture>, 2> Pictures;
  vtkNew<vtkLineSource> LineSource;
  vtkNew<vtkActor2D> Line;
  std::array<vtkNew<vtkTextActor>, 2> Labels;
  vtkSmartPointer<vtkScalarBarActor> Legend;
  double Factor = 1.0; // of radiance
};
} // namespace explorer

#endif
