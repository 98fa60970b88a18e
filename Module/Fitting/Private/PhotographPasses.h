// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Passes over all photographs of a set, one picture in memory at a time; and what materials look
 * like in them.
 */

#ifndef PhotographPasses_h
#define PhotographPasses_h

#include "MapFitData.h"
#include "PhotographPixels.h"
#include "TexelSums.h"

#include <array>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// A photograph cannot be used; names it.
struct PhotographError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

class PhotographPasses
{
public:
  PhotographPasses(vtkPhotographSet* set, std::function<bool(double)> proceed);

  /// Learn the size. Throws PhotographError, here and in Run.
  void Open();
  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }

  /// use(number, pixels) for each photograph in turn, while progress goes from one share to the
  /// other. Returns false if it was stopped.
  bool Run(double from, double to, const std::function<void(int, const PhotographPixels&)>& use);

  /// Report progress; false, then and from then on, if the work has to stop.
  bool Proceed(double share);
  bool IsStopped() const { return this->Stopped; }

  /// Pixels of each PixelState in all photographs.
  const std::array<std::uint64_t, 4>& GetPixelCounts() const { return this->PixelCounts; }
  int GetNumberOfPasses() const { return this->NumberOfPasses; }

private:
  void Read(int index, PhotographPixels& pixels) const;

  vtkPhotographSet* Set;
  std::function<bool(double)> Report;
  int Width = 0;
  int Height = 0;
  int NumberOfPasses = 0;
  bool Stopped = false;
  std::array<std::uint64_t, 4> PixelCounts{};
};

/**
 * Materials' linear values in the photographs, over each photograph's unit of error. scales: these
 * units; empty: made from the materials, as their geometric mean plus NoiseFloor.
 */
MaterialValues EvaluateMaterials(vtkPhotographSet* set, const std::vector<NamedMaterial>& materials,
  const std::vector<double>& scales);

/// A photograph's unit of error is what it shows on the average plus this, as a linear value (1:
/// full scale): photographs count alike, but for those too dark to say much.
constexpr double NoiseFloor = 0.01;
} // namespace measuredbrdf

#endif
