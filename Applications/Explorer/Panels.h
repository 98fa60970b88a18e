// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Panels that are made of Qt's own widgets: each shows what the session says, and tells it what
 * people set. Tests find their widgets by name.
 */

#ifndef Panels_h
#define Panels_h

#include "Evaluation.h"
#include "Session.h"
#include "Side.h"

#include <QWidget>

#include <array>

namespace explorer
{
/// Above the picture: what each side is drawn by ("method A", "method B"), and how it is shown.
QWidget* MakePictureBar(Session* session);

/// The lists of materials, environments and meshes. The box that takes a material into the charts
/// is called "compare " and its name or file.
QWidget* MakeListPanel(Session* session);

/// The tolerance ("tolerance"), what is planned for it, and what was measured of both sides.
QWidget* MakePlanPanel(Session* session, std::array<Side*, 2> sides, Evaluation* evaluation);

/// The parameters of a model by sliders and fields, called by the parameter's key and,
/// where it is a color, 0, 1 or 2.
QWidget* MakeModelPanel(Session* session);

/// What `info` says of the material.
QWidget* MakeFindingsPanel(Session* session);
} // namespace explorer

#endif
