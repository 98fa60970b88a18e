// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sizes of radiance tables that a planner tries, for tables alone and within hybrids. Private
 * to the module.
 */

#ifndef TableCandidates_h
#define TableCandidates_h

#include "vtkRadianceIntegrator.h"
#include "vtkType.h"

#include <vector>

namespace measuredbrdf
{
/// Rows, view angles, azimuths.
std::vector<std::vector<int>> GetTableCandidates();

/// Rows, view angles, azimuths, maps.
std::vector<std::vector<int>> GetHybridCandidates();

/// Rows, view angles, azimuths, the view's azimuths.
std::vector<std::vector<int>> GetAnisotropicCandidates();

/// Of a table's textures.
vtkIdType GetTableBytes(int rows, int viewAngles, int azimuths);

/// vtkRadianceIntegrator::CanPrune for a table with these rows, view angles and azimuths, the first
/// three sizes of the attempts.
bool CanPruneTable(const std::vector<int>& sizes,
  const std::vector<vtkRadianceIntegrator::Attempt>& attempts, double tolerance);

/// The same for so many maps of the sharp part of so many rows. attempts: with maps, no more of
/// them; tables: without maps, beside the same lights. These show what more rows gain, and what
/// maps lack that is no matter of rows.
bool CanPruneMaps(int rows, int maps, const std::vector<vtkRadianceIntegrator::Attempt>& attempts,
  const std::vector<vtkRadianceIntegrator::Attempt>& tables, double tolerance);

/// The same for maps without lights, however many: true where a table of 257 x 8 x 8 can be pruned,
/// or is far from the tolerance and leaves too much of the error of 65 x 8 x 8.
bool CanPruneMapsAlone(const std::vector<vtkRadianceIntegrator::Attempt>& tables, double tolerance);
} // namespace measuredbrdf

#endif
