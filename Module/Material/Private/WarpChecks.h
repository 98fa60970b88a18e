// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is wrong with the tables that vtkAdaptiveWarpBRDF is given: texts, "" where nothing is.
 * Private to the module.
 */

#ifndef WarpChecks_h
#define WarpChecks_h

#include <string>
#include <vector>

namespace measuredbrdf
{
/// Repairs angles that were rounded onto or below the one before.
std::string CheckAxis(const char* name, std::vector<float>& axis);

/// prefix: the leading axes' sizes; then two sizes of at least 2.
std::string CheckTable(const char* name, const std::vector<int>& shape,
  const std::vector<float>& values, const std::vector<int>& prefix);

/// A whole turn, half of one or a quarter. One or two azimuths: it is isotropic.
std::string CheckSpan(const std::vector<float>& phi);

/// Of a table that passed CheckTable. Clears rounding noise below 0.
std::string CheckDensity(
  const char* name, const std::vector<int>& shape, std::vector<float>& values);
} // namespace measuredbrdf

#endif
