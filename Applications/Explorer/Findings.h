// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is remarkable in what `info` measures of a material. Without Qt.
 */

#ifndef Findings_h
#define Findings_h

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace explorer
{
struct Finding
{
  bool IsGood;
  std::string Name; // "Reciprocity"
  std::string Text; // one sentence with the figures
};

/// Of tool::InspectMaterial: reciprocity, albedo and energy, negative and invalid values,
/// transmission where there is any.
std::vector<Finding> FindFindings(const nlohmann::ordered_json& info);
} // namespace explorer

#endif
