// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `info` and the explorer say of a material.
 */

#ifndef Inspection_h
#define Inspection_h

#include "Inputs.h"

#include <nlohmann/json.hpp>

#include <string>

namespace tool
{
/// Model, range, albedo by angle, reciprocity, negative values, transmission and more, measured:
/// what `info --json` prints. Takes about a second, transmission a few more. Throws Error.
nlohmann::ordered_json InspectMaterial(const Material& material);

/// The same for people: what `info` prints.
std::string FormatInspection(const nlohmann::ordered_json& info);
} // namespace tool

#endif
