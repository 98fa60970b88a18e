// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Small valid inputs of the fuzz targets, made when they are needed.
 */

#ifndef FuzzSeeds_h
#define FuzzSeeds_h

#include "vtkBRDFData.h"

#include <string>
#include <vector>

namespace fuzz
{
/// The data of one material of each model.
std::vector<vtkBRDFData> MakeData();

/// The seeds of a target ("Merl"); none for an unknown name.
std::vector<std::string> MakeSeeds(const std::string& target);
} // namespace fuzz

#endif
