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
  /// Widens the range to a value; not to one that is not positive and finite.
  void Take(double value);

  /// Air around what was taken.
  void Widen();

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
