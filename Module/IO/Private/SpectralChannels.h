// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which of a file's wavelengths make the material, and with what weights. Private to the IO room.
 */

#ifndef SpectralChannels_h
#define SpectralChannels_h

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// "905nm", as in `path#905nm`.
std::string GetWavelengthName(double nanometers);

struct SpectralChannels
{
  std::vector<std::size_t> Chosen;            // of the wavelengths
  std::vector<std::array<double, 3>> Weights; // RGB = sum of weights * value, of each chosen one
  std::string Note;

  /**
   * The visible wavelengths, as SpectralColor.h sums them; fewer than two of them: the first
   * wavelength alone, gray. name: empty, or which wavelength, gray. Returns an empty string, or
   * that there is no such one. wavelengths: nm, ascending, at least one.
   */
  std::string Choose(const std::vector<double>& wavelengths, const std::string& name);
};
} // namespace measuredbrdf

#endif
