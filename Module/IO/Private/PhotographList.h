// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which photographs there are, and how each was taken: from a list in JSON, or from the files'
 * names.
 */

#ifndef PhotographList_h
#define PhotographList_h

#include "FileBytes.h"

#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
struct ListedPhotograph
{
  std::string File; // as in the list: relative to its folder, or absolute
  double Light[3] = { 0.0, 0.0, 1.0 };
  double View[3] = { 0.0, 0.0, 1.0 };
  double Exposure = 1.0;
};

struct PhotographList
{
  std::vector<ListedPhotograph> Photographs;
  double Irradiance = 3.14159265358979323846;
  int Transfer = 0; // vtkPhotographSet's
  double Gamma = 2.2;
  double SaturationLevel = 1.0;
  double BlackLevel = 0.0;
  bool LevelsForFloats = false;
};

/// A list of at most this many bytes is read.
constexpr std::size_t MostListBytes = std::size_t(1) << 28;

/// Of a list in JSON. Throws FileError naming file and entry.
PhotographList ParsePhotographList(const FileBytes& file);

/**
 * Directions from a file's name by the convention of the Bonn and UTIA databases: tl, pl, tv and pv
 * before the polar angle and azimuth of light and view in degrees, as in
 * "00000 tl015 pl030 tv045 pv060.jpg". Returns whether the name has all four of them, each once.
 * Throws FileError for a direction that is not above the horizon.
 */
bool ParsePhotographName(const std::string& path, ListedPhotograph& photograph);

/// All files of such names in a folder and its folders, in the order of their paths. ignored: how
/// many other files there are. Throws FileError.
PhotographList ListPhotographFolder(const std::string& folder, std::size_t& ignored);
} // namespace measuredbrdf

#endif
