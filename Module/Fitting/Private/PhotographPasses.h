// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Passes over all photographs of a set, one picture in memory at a time, as linear values with what
 * each pixel is good for.
 */

#ifndef PhotographPasses_h
#define PhotographPasses_h

#include <array>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

class vtkPhotographSet;

namespace measuredbrdf
{
enum class PixelState : std::uint8_t
{
  Valid,
  Saturated,
  Black,
  Invalid // not finite
};

struct PhotographPixels
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Values;      // RGB, linear, row 0 at the bottom; 0 where a pixel is not valid
  std::vector<PixelState> States; // of each pixel
};

/// The user stopped the fit.
struct MapFitStopped
{
};

class PhotographPasses
{
public:
  /// Reads the first photograph, for the size. report: with the share done; false: stop.
  PhotographPasses(vtkPhotographSet* set, std::function<bool(double)> report);

  /// use(number, pixels) for each photograph in turn, while progress goes from one share to the
  /// other. Throws MapFitStopped, and std::runtime_error for a photograph that cannot be used, with
  /// its name.
  void Run(double from, double to, const std::function<void(int, const PhotographPixels&)>& use);

  /// Report progress. Throws MapFitStopped.
  void Proceed(double share) const;

  int Width = 0;
  int Height = 0;
  /// Pixels of each PixelState in all photographs, as the last pass found them.
  std::array<std::uint64_t, 4> PixelCounts{};

private:
  PhotographPixels Read(int index) const;

  vtkPhotographSet* Set;
  std::function<bool(double)> Report;
};
} // namespace measuredbrdf

#endif
