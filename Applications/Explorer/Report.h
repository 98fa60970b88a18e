// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What was explored, for others: a page (.html, one file with its pictures) or figures (.json).
 */

#ifndef Report_h
#define Report_h

#include "Inputs.h"
#include "State.h"
#include "Surface.h"

#include <QImage>
#include <QString>

#include <nlohmann/json.hpp>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace explorer
{
struct ReportSide
{
  std::string Description;
  bool IsReference = false;
  double PredictedError = -1.0; // negative: none
  double Frame = 0.0;           // ms
  std::vector<double> Radiance; // 3 doubles a pixel of the surface
};

/// All that a report is made of, so that a thread can make it.
struct ReportData
{
  State Explored;
  std::string Material;
  std::string Plan;
  nlohmann::ordered_json Inspection; // may be null
  tool::Size Size{ 1, 1 };
  std::shared_ptr<const tool::Surface> Visible;
  std::vector<double> Reference;
  std::array<ReportSide, 2> Sides;
  std::vector<std::pair<QString, QImage>> Pictures; // with titles
};

/// The figures: methods, errors by every metric of `compare`, times, the state. Throws tool::Error.
nlohmann::ordered_json MakeReport(const ReportData& data);

/// As the path's ending says, .html or .json; whole or not at all. Throws tool::Error.
void WriteReport(const ReportData& data, const std::string& path);
} // namespace explorer

#endif
