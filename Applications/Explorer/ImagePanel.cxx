// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePanel.h"

#include "Display.h"

#include "vtkBRDFImageSource.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

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
  return explorer::MakeQImage(picture);
}
}

namespace explorer
{
//------------------------------------------------------------------------------
ImageSlice::ImageSlice(QWidget* parent)
  : QWidget(parent)
{
  this->setMinimumSize(200, 200);
  this->setAccessibleName(tr("Image slice"));
  this->setToolTip(
    tr("f over theta_h and theta_d (Burley 2012): the left edge is the highlight, the top its "
       "Fresnel reflection, the right edge grazing retroreflection"));
}

//------------------------------------------------------------------------------
void ImageSlice::SetImage(const QImage& image, bool isSquared)
{
  this->Image = image;
  this->IsSquared = isSquared;
  this->update();
}

//------------------------------------------------------------------------------
void ImageSlice::paintEvent(QPaintEvent*)
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
    painter.drawText(this->rect(), Qt::AlignCenter, tr("Being drawn …"));
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
    tr("θh in degrees"));
  painter.translate(0, frame.center().y());
  painter.rotate(-90.0);
  painter.drawText(QRect(-size / 2, 0, size, line), Qt::AlignCenter, tr("θd in degrees"));
}

//------------------------------------------------------------------------------
ImagePanel::ImagePanel(Session* session, Jobs* jobs, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Background(jobs)
  , Slice(new ImageSlice)
  , PhiD(new QDoubleSpinBox)
  , Stops(new QDoubleSpinBox)
  , Squared(new QCheckBox(tr("√θ&h")))
{
  this->PhiD->setRange(0.0, 180.0);
  this->PhiD->setValue(90.0);
  this->PhiD->setDecimals(1);
  this->PhiD->setSingleStep(15.0);
  this->PhiD->setSuffix("°");
  this->PhiD->setKeyboardTracking(false);
  this->PhiD->setToolTip(tr("Azimuth of the difference at which the image is cut"));
  this->Stops->setRange(-10.0, 10.0);
  this->Stops->setDecimals(1);
  this->Stops->setSuffix(tr(" stops"));
  this->Stops->setToolTip(tr("Exposure; at 0 a perfectly white matte surface is white"));
  this->Squared->setToolTip(tr("Stretch small theta_h, as MERL's files do"));
  auto* row = new QHBoxLayout;
  const std::pair<QString, QWidget*> parts[] = { { tr("&φd"), this->PhiD },
    { tr("E&xposure"), this->Stops } };
  for (const auto& [text, widget] : parts)
  {
    auto* label = new QLabel(text);
    label->setBuddy(widget);
    row->addWidget(label);
    row->addWidget(widget);
  }
  row->addWidget(this->Squared);
  row->addStretch(1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addLayout(row);
  layout->addWidget(this->Slice, 1);
  for (QDoubleSpinBox* box : { this->PhiD, this->Stops })
  {
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &ImagePanel::Start);
  }
  connect(this->Squared, &QCheckBox::toggled, this, &ImagePanel::Start);
  connect(session, &Session::materialChanged, this, &ImagePanel::Start);
}

//------------------------------------------------------------------------------
void ImagePanel::Start()
{
  vtkSmartPointer<vtkBRDF> brdf = this->Model->GetMaterial().BRDF;
  if (!brdf)
  {
    return;
  }
  if (auto copy = vtkSmartPointer<vtkBRDF>::Take(brdf->NewSnapshot()))
  {
    brdf = copy;
  }
  const double phiD = this->PhiD->value();
  const double stops = this->Stops->value();
  const bool isSquared = this->Squared->isChecked();
  this->Background->Start(
    "image slice", tr("drawing the image slice"),
    [this, brdf, phiD, stops, isSquared](JobThread& thread)
    {
      const QImage image = DrawSlice(brdf, phiD, stops, isSquared);
      thread.Post([this, image, isSquared]() { this->Slice->SetImage(image, isSquared); });
    },
    [this](const QString& text) { this->Model->Say(text, true); });
}
} // namespace explorer
