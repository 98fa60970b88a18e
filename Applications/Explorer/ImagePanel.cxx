// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Controls.h"
#include "Display.h"
#include "Panels.h"

#include "vtkBRDFImageSource.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <QHBoxLayout>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace explorer
{
namespace
{
constexpr int Resolution = 256;

//------------------------------------------------------------------------------
// A perfectly white matte surface, f = 1/pi, is white.
QImage DrawSlice(vtkBRDF* brdf, double phiD, double stops, bool isSquared)
{
  vtkNew<vtkBRDFImageSource> source;
  source->SetBRDF(brdf);
  source->SetResolution(Resolution);
  source->SetPhiD(phiD);
  source->SetUseThetaHSquared(isSquared);
  source->Update();
  vtkImageData* slice = source->GetOutput();
  const double factor = vtkMath::Pi() * std::exp2(stops);
  tool::Picture picture(Resolution, Resolution);
  for (int y = 0; y < Resolution; ++y)
  {
    for (int x = 0; x < Resolution; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        picture.At(x, y)[c] =
          static_cast<float>(tool::RollOff(factor * slice->GetScalarComponentAsDouble(x, y, 0, c)));
      }
    }
  }
  return MakeQImage(picture);
}

/// The picture with its axes.
class ImageSlice : public QWidget
{
public:
  ImageSlice()
  {
    this->setMinimumSize(200, 200);
    this->setAccessibleName(QObject::tr("Image slice"));
    this->setToolTip(QObject::tr(
      "f over theta_h and theta_d (Burley 2012): the left edge is the highlight, the top its "
      "Fresnel reflection, the right edge grazing retroreflection"));
  }

  void SetImage(const QImage& image, bool isSquared)
  {
    this->Image = image;
    this->IsSquared = isSquared;
    this->update();
  }

protected:
  void paintEvent(QPaintEvent*) override
  {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const int line = this->fontMetrics().height();
    const int left = this->fontMetrics().horizontalAdvance("90 ") + line + 4;
    const int bottom = 2 * line + 6;
    const int size = std::min(this->width() - left - line, this->height() - bottom - line / 2);
    const QRect frame(left, line / 2, size, size);
    if (this->Image.isNull())
    {
      painter.drawText(this->rect(), Qt::AlignCenter, QObject::tr("Being drawn …"));
      return;
    }
    painter.drawImage(frame, this->Image);
    painter.drawRect(frame.adjusted(0, 0, -1, -1));
    for (const int degrees : { 0, 30, 60, 90 })
    {
      const double share = degrees / 90.0;
      const int x = frame.left() + static_cast<int>(std::lround(
                                     size * (this->IsSquared ? std::sqrt(share) : share)));
      const int y = frame.bottom() - static_cast<int>(std::lround(size * share));
      const QString text = QString::number(degrees);
      painter.drawLine(x, frame.bottom() + 1, x, frame.bottom() + 4);
      painter.drawText(QRect(x - left, frame.bottom() + 4, 2 * left, line), Qt::AlignHCenter, text);
      painter.drawLine(frame.left() - 4, y, frame.left() - 1, y);
      painter.drawText(
        QRect(line, y - line / 2, left - line - 6, line), Qt::AlignRight | Qt::AlignVCenter, text);
    }
    painter.drawText(QRect(frame.left(), frame.bottom() + 4 + line, size, line), Qt::AlignCenter,
      QObject::tr("θh in degrees"));
    painter.translate(0, frame.center().y());
    painter.rotate(-90.0);
    painter.drawText(
      QRect(-size / 2, 0, size, line), Qt::AlignCenter, QObject::tr("θd in degrees"));
  }

private:
  QImage Image;
  bool IsSquared = false;
};
}

//------------------------------------------------------------------------------
QWidget* MakeImagePanel(Session* session, Jobs* jobs)
{
  auto* panel = new QWidget;
  auto* slice = new ImageSlice;
  auto* phiD = MakeField(
    0.0, 180.0, 1, 15.0, "°", QObject::tr("Azimuth of the difference at which the image is cut"));
  phiD->setValue(90.0);
  auto* stops = MakeField(-10.0, 10.0, 1, 1.0, QObject::tr(" stops"),
    QObject::tr("Exposure; at 0 a perfectly white matte surface is white"));
  stops->setKeyboardTracking(true);
  auto* squared =
    MakeBox(QObject::tr("√θ&h"), QObject::tr("Stretch small theta_h, as MERL's files do"));
  auto* row = new QHBoxLayout;
  AddNamed(row, QObject::tr("&φd"), phiD);
  AddNamed(row, QObject::tr("E&xposure"), stops);
  row->addWidget(squared);
  row->addStretch(1);
  auto* layout = MakeColumn(panel);
  layout->addLayout(row);
  layout->addWidget(slice, 1);

  const auto draw = [=]()
  {
    if (!session->GetMaterial().BRDF)
    {
      return;
    }
    const bool isSquared = squared->isChecked();
    jobs->Compute(
      "image slice", QObject::tr("drawing the image slice"),
      [material = MakeSnapshot(session->GetMaterial()), angle = phiD->value(),
        exposure = stops->value(), isSquared]()
      { return DrawSlice(material.BRDF, angle, exposure, isSquared); },
      [=](const QImage& image) { slice->SetImage(image, isSquared); });
  };
  OnChange(phiD, draw);
  OnChange(stops, draw);
  OnChange(squared, draw);
  QObject::connect(session, &Session::materialChanged, panel, draw);
  return panel;
}
} // namespace explorer
