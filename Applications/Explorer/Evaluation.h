// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The exact picture of what is in view, and how far both sides are from it. No widgets.
 */

#ifndef Evaluation_h
#define Evaluation_h

#include "Inputs.h"
#include "Jobs.h"
#include "Session.h"
#include "Side.h"
#include "Surface.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <QObject>
#include <QTimer>

#include <array>
#include <memory>
#include <vector>

class vtkCamera;

namespace explorer
{
/// What was measured of a side.
struct SideFigures
{
  bool IsMeasured = false; // all but Error
  double Error = -1.0;     // relative L1 against the reference; negative: not known
  double Frame = 0.0;      // ms of a frame of the evaluation's size
};

/**
 * When nothing has changed for a moment, the visible surface is found, both sides are drawn at the
 * size of exact pictures, and a job makes the exact picture. A change stops that.
 */
class Evaluation : public QObject
{
  Q_OBJECT

public:
  Evaluation(
    Session* session, Jobs* jobs, std::array<Side*, 2> sides, vtkCamera* camera, QObject* parent);

  /// Width and height of what the camera sees.
  void SetAspect(double aspect);

  const tool::Size& GetSize() const { return this->Size; }
  const SideFigures& GetFigures(int side) const { return this->Figures[side]; }

  ///@{
  /// The exact picture as far as it is known: null before; whether it is all there.
  std::shared_ptr<const tool::Picture> GetReference() const { return this->Reference; }
  bool IsComplete() const { return this->Complete; }
  ///@}

  /// Radiance of a side (of the reference's: the exact one); null before.
  std::shared_ptr<const tool::Picture> GetPicture(int side) const;

  /// Mean over red, green and blue of |A - B|, relative to the mean of the reference, or of B
  /// before there is one; as colors, with its mean. Null before both pictures are there.
  vtkSmartPointer<vtkImageData> MakeDifference(double& mean) const;

  ///@{
  /// What was compared: 3 doubles a pixel; for reports.
  std::shared_ptr<const tool::Surface> GetSurface() const { return this->Visible; }
  std::vector<double> GetRadiance(int side) const;
  std::vector<double> GetReferenceRadiance() const { return this->Radiance; }
  ///@}

  /// Whether nothing is left to be done.
  bool IsSettled() const
  {
    return this->Failed ||
           (this->Complete && this->Figures[0].IsMeasured && this->Figures[1].IsMeasured);
  }

Q_SIGNALS:
  /// Any of the above is different.
  void changed();

private:
  void Restart();
  void RestartLight();
  void RestartSides();
  void Settle();
  void StartReference();
  void Capture();
  void TakeReference(const std::vector<double>& radiance, bool complete);
  void Measure();

  Session* Model;
  Jobs* Background;
  std::array<Side*, 2> Sides;
  vtkCamera* Camera;
  double Aspect = 1.0;
  QTimer Timer;
  tool::Size Size{ 1, 1 };
  std::shared_ptr<const tool::Surface> Visible;
  std::array<std::shared_ptr<const tool::Picture>, 2> Pictures;
  std::array<SideFigures, 2> Figures;
  std::shared_ptr<const tool::Picture> Reference;
  std::vector<double> Radiance;
  bool Complete = false;
  bool Failed = false; // not to be tried again before something changes
};
} // namespace explorer

#endif
