// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MessageBar.h"

#include "vtkBRDFReader.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace
{
constexpr int NoteTime = 10000; // ms
constexpr int MostCharacters = 600;
}

namespace explorer
{
//------------------------------------------------------------------------------
MessageBar::MessageBar(QWidget* parent)
  : QFrame(parent)
  , Text(new QLabel)
{
  this->setFrameShape(QFrame::StyledPanel);
  this->setAutoFillBackground(true);
  this->Text->setWordWrap(true);
  this->Text->setTextFormat(Qt::PlainText);
  this->Text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setText("×");
  close->setAutoRaise(true);
  close->setToolTip(tr("Hide this message"));
  close->setAccessibleName(tr("Hide this message"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(8, 4, 4, 4);
  layout->addWidget(this->Text, 1);
  layout->addWidget(close, 0, Qt::AlignTop);
  this->Timer.setSingleShot(true);
  connect(&this->Timer, &QTimer::timeout, this, &QWidget::hide);
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  this->hide();
}

//------------------------------------------------------------------------------
void MessageBar::Show(const QString& text, bool isError)
{
  if (text.isEmpty() || (!isError && this->isVisible() && !this->Timer.isActive()))
  {
    return; // a note does not hide an error
  }
  const QString printable = QString::fromStdString(vtkBRDFReader::GetPrintable(text.toStdString()));
  this->Text->setText(
    printable.size() > MostCharacters ? printable.left(MostCharacters) + "…" : printable);
  this->Text->setToolTip(printable.size() > MostCharacters ? printable : QString());
  QPalette colors = this->palette();
  colors.setColor(QPalette::Window, isError ? QColor(0x7a, 0x25, 0x1f) : QColor(0x2d, 0x4a, 0x66));
  colors.setColor(QPalette::WindowText, Qt::white);
  colors.setColor(QPalette::ButtonText, Qt::white);
  this->setPalette(colors);
  isError ? this->Timer.stop() : this->Timer.start(NoteTime);
  this->show();
}

//------------------------------------------------------------------------------
QString MessageBar::GetText() const { return this->isHidden() ? QString() : this->Text->text(); }
} // namespace explorer
