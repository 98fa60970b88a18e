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
#include <string>
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

  std::array<std::uint64_t, 4> CountStates() const;
};

/// Make a photograph's picture and decode it. Returns "", or what is wrong, without its name.
std::string ReadPhotograph(vtkPhotographSet* set, int index, PhotographPixels& pixels);

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
} // namespace measuredbrdf

#endif
