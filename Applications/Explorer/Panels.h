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

#include <nlohmann/json.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace explorer
{
class SplitView;

/// Above the picture: what each side is drawn by ("method A", "method B"), and how it is shown.
QWidget* MakePictureBar(Session* session);

/// The lists of materials, environments and meshes. open: shows a dialog for files of a kind,
/// "materials", "environments" or "meshes". The box that takes a material into the charts is called
/// "compare " and its name or file.
QWidget* MakeListPanel(Session* session, const std::function<void(const QString&)>& open);

/// The tolerance ("tolerance"), what is planned for it, and what was measured of both sides.
QWidget* MakePlanPanel(
  Session* session, std::array<Side*, 2> sides, Evaluation* evaluation, SplitView* view);

/// The parameters of a model by sliders, fields and choices, called by the parameter's key and,
/// where it is a color, 0, 1 or 2; the list of models is called "models". save: asks for a file.
QWidget* MakeModelPanel(Session* session, const std::function<void()>& save);

/// What is remarkable in what `info` measures of a material.
struct Finding
{
  bool IsGood;
  std::string Name; // "Reciprocity"
  std::string Text; // one sentence with the figures
};

/// Of tool::InspectMaterial: reciprocity, albedo and energy, negative and invalid values,
/// transmission where there is any.
std::vector<Finding> FindFindings(const nlohmann::ordered_json& info);

/// The same as a table in HTML.
QString MakeFindingsTable(const nlohmann::ordered_json& info);

/// What `info` says of the material, with what is remarkable first (the label "findings").
QWidget* MakeFindingsPanel(Session* session);
} // namespace explorer

#endif
