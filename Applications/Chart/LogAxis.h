// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A logarithmic axis of a chart: its range, its ticks, and how these are written.
 */

#ifndef LogAxis_h
#define LogAxis_h

#include <limits>
#include <string>
#include <vector>

namespace tool
{
/// What an axis counts, and how its ticks are written.
enum class Unit
{
  Milliseconds,
  Bytes,
  Share, // in percent
  Number
};

std::string FormatTick(double value, Unit unit);

class LogAxis
{
public:
  /// Air around all values but those that are not positive and finite.
  explicit LogAxis(const std::vector<double>& values = {});

  ///@{
  /// The ends, as exponents of ten.
  double GetLeast() const { return this->Least; }
  double GetLargest() const { return this->Largest; }
  ///@}

  /// Where a value is, as a share of the axis.
  double Find(double value) const;

  /// Exponents of ten: powers of ten; with twice and five times where there would be few.
  std::vector<double> GetTicks() const;

private:
  double Least = std::numeric_limits<double>::infinity();
  double Largest = -std::numeric_limits<double>::infinity();
};
} // namespace tool

#endif
