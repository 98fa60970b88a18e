// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What commands report: a JSON object, for programs as it is, for people as lines and tables.
 */

#ifndef JsonReport_h
#define JsonReport_h

#include <nlohmann/json.hpp>

#include <string>

namespace tool
{
/// For people: a line for each key, objects below it, and rows of objects with the same keys as
/// tables.
std::string FormatReport(const nlohmann::ordered_json& report);

/// As JSON, or for people, on stdout. Bytes of names that are no UTF-8 are replaced. Throws Error.
void PrintReport(const nlohmann::ordered_json& report, bool asJson);

/// As JSON in a file, whole or not at all; nothing where path is empty. Throws Error.
void WriteReport(const std::string& path, const nlohmann::ordered_json& report);
} // namespace tool

#endif
