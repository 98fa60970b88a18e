// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What was explored, for others: a page (.html, one file with its pictures) or figures (.json).
 */

#ifndef Report_h
#define Report_h

#include "Inputs.h"
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
/// All that a report is made of, so that a thread can make it.
struct ReportData
{
  nlohmann::ordered_json Figures; // all but the errors of its "sides"
  tool::Size Size{ 1, 1 };
  std::shared_ptr<const tool::Surface> Visible;
  std::vector<double> Reference;
  std::array<std::vector<double>, 2> Radiance; // of the sides, 3 doubles a pixel of the surface
  std::vector<std::pair<QString, QImage>> Pictures; // with titles
};

/// As the path's ending says, .html or .json; whole or not at all: the figures with the sides'
/// errors by every metric of `compare`, and the page with its pictures. Throws tool::Error.
void WriteReport(const ReportData& data, const std::string& path);
} // namespace explorer

#endif
