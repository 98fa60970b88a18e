// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The window's menus.
#include "Comparison.h"
#include "SamplePanel.h"
#include "Window.h"

#include <QAction>
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QUndoStack>

namespace explorer
{
//------------------------------------------------------------------------------
void Window::MakeMenus()
{
  this->MakeFileMenu();
  this->MakeEditMenu();
  this->MakeViewMenu();
  QMenu* help = this->menuBar()->addMenu(tr("&Help"));
  help->addAction(tr("&About"), this,
    [this]()
    {
      QMessageBox::about(this, tr("About"),
        tr("<b>vtkMeasuredBRDF explorer</b><p>Measured materials in VTK scenes in real time.</p>"
           "<p>Drag in the picture to turn the mesh, drag the line to compare both methods; drop "
           "files into the "
           "window to open them.</p>"));
    });
}

//------------------------------------------------------------------------------
void Window::MakeFileMenu()
{
  QMenu* file = this->menuBar()->addMenu(tr("&File"));
  QAction* open = file->addAction(tr("&Open…"), this, [this]() { this->OpenFiles(""); });
  open->setShortcut(QKeySequence::Open);
  file->addSeparator();
  QAction* state = file->addAction(tr("&Save state…"), this,
    [this]()
    {
      this->Ask(tr("Save state"), "explorer.json", tr("States (*.json)"),
        [this](const QString& path) { this->Model->Save(path.toStdString()); });
    });
  state->setShortcut(QKeySequence::Save);
  QAction* picture = file->addAction(tr("Save &picture…"), this,
    [this]()
    {
      this->Ask(tr("Save picture"), "explorer.png", tr("Pictures (*.png)"),
        [this](const QString& path) { this->SavePicture(path); });
    });
  picture->setShortcut(Qt::CTRL | Qt::SHIFT | Qt::Key_P);
  QAction* report = file->addAction(tr("Save &report…"), this,
    [this]()
    {
      this->Ask(tr("Save report"), "explorer.html", tr("Reports (*.html *.json)"),
        [this](const QString& path) { this->SaveReport(path); });
    });
  report->setShortcut(Qt::CTRL | Qt::Key_R);
  QAction* material =
    file->addAction(tr("Save &material…"), this, [this]() { this->AskForMaterial(); });
  material->setShortcut(Qt::CTRL | Qt::Key_M);
  file->addSeparator();
  QAction* quit = file->addAction(tr("&Quit"), this, &QWidget::close);
  quit->setShortcut(QKeySequence::Quit);
}

//------------------------------------------------------------------------------
// Of samples.
void Window::MakeEditMenu()
{
  QMenu* edit = this->menuBar()->addMenu(tr("&Edit"));
  QUndoStack* stack = this->Samples->GetUndoStack();
  QAction* undo = stack->createUndoAction(this, tr("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = stack->createRedoAction(this, tr("&Redo"));
  redo->setShortcut(QKeySequence::Redo);
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  edit->addAction(tr("Take back &all edits"), this, [this]() { this->Samples->Revert(); });
}

//------------------------------------------------------------------------------
void Window::MakeViewMenu()
{
  QMenu* view = this->menuBar()->addMenu(tr("&View"));
  QAction* reset =
    view->addAction(tr("&Reset camera"), this, [this]() { this->View->ResetCamera(); });
  reset->setShortcut(Qt::Key_Home);
  QAction* difference = view->addAction(tr("&Difference"));
  difference->setCheckable(true);
  difference->setShortcut(Qt::CTRL | Qt::Key_D);
  connect(difference, &QAction::triggered, this,
    [this](bool on) { this->Model->SetShown(on ? Shown::Difference : Shown::Split); });
  QAction* backdrop = view->addAction(tr("&Backdrop"));
  backdrop->setCheckable(true);
  backdrop->setShortcut(Qt::CTRL | Qt::Key_B);
  connect(backdrop, &QAction::triggered, this, [this](bool on) { this->Model->SetBackdrop(on); });
  connect(this->Model, &Session::pictureChanged, this,
    [this, difference, backdrop]()
    {
      difference->setChecked(this->Model->GetState().Show == Shown::Difference);
      backdrop->setChecked(this->Model->GetState().Backdrop);
    });
  QAction* compare = view->addAction(tr("&Compare this material"), this,
    [this]()
    {
      const std::string& file = this->Model->GetState().Material;
      this->Compared->SetCompared(file, !this->Compared->IsCompared(file));
    });
  compare->setShortcut(Qt::CTRL | Qt::Key_T);
  QMenu* heights = view->addMenu(tr("Exact &picture"));
  for (const int height : { 128, 256, 512, 1024 })
  {
    heights->addAction(tr("%1 pixels high").arg(height), this,
      [this, height]() { this->Model->SetReferenceHeight(height); });
  }
  view->addSeparator();
  for (QDockWidget* dock : this->findChildren<QDockWidget*>())
  {
    view->addAction(dock->toggleViewAction());
  }
}
} // namespace explorer
