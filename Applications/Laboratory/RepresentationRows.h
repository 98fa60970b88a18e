// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The table that `representations` makes: its rows, as CSV and for people.
 */

#ifndef RepresentationRows_h
#define RepresentationRows_h

#include <cstddef>
#include <string>
#include <vector>

namespace tool
{
/// A representation of a material, and what it costs.
struct RepresentationRow
{
  std::string Material;
  std::string Representation;
  int Functions = 0; // 0: no basis
  double Zone = 0.0;
  double Hemisphere = 0.0;
  double NegativeMass = 0.0;
  std::vector<double> Images; // per environment
  std::size_t Bytes = 0;
  double Seconds = 0.0;
  bool Recommended = false;
};

///@{
/// environments: their names, in the order of the rows' images.
std::string FormatCSV(
  const std::vector<RepresentationRow>& rows, const std::vector<std::string>& environments);
std::string FormatText(
  const std::vector<RepresentationRow>& rows, const std::vector<std::string>& environments);
///@}
} // namespace tool

#endif
