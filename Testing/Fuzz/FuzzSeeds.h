// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Small valid inputs of the fuzz targets, made when they are needed.
 */

#ifndef FuzzSeeds_h
#define FuzzSeeds_h

#include "MaterialArchive.h"

#include <string>
#include <vector>

namespace fuzz
{
/// One archive of each representation.
std::vector<measuredbrdf::MaterialArchive> MakeArchives();

/// The seeds of a target ("Merl"); none for an unknown name.
std::vector<std::string> MakeSeeds(const std::string& target);
} // namespace fuzz

#endif
