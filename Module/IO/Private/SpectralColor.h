// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Spectra of f as linear RGB (Rec. 709): what an observer sees of the material in daylight.
 *
 *   X_j = sum f(l) D65(l) c_j(l) / sum D65(l) c_j(l),  RGB = M (X_j times X_j of D65)
 *
 * Both sums are over l = 380, 381, ..., 780 nm. c_j are the CIE 1931 color-matching functions (2
 * degrees), D65 is CIE's standard illuminant, both from their tables in steps of 5 nm (ISO/CIE
 * 11664-1 and -2), linear between these; M is sRGB's matrix from XYZ. f is linear between the
 * file's wavelengths, and constant beyond the first and the last.
 *
 * D65, because it is the white of the RGB that the module draws in: a material whose f is the same
 * at all wavelengths gets R = G = B = f exactly. A color outside the RGB gamut has a negative
 * component, as in the RGL database's own RGB files.
 */

#ifndef SpectralColor_h
#define SpectralColor_h

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace measuredbrdf
{
constexpr double FirstVisible = 380.0; // nm
constexpr double LastVisible = 780.0;

/// RGB = sum over k of weights[k] f(wavelengths[k]); wavelengths: nm, ascending, at least one. The
/// weights of each component add up to 1.
std::vector<glm::dvec3> GetSpectralWeights(const std::vector<double>& wavelengths);

///@{
/// "905nm", as in `path#905nm`.
std::string GetWavelengthName(double nanometers);
std::vector<std::string> GetWavelengthNames(const std::vector<double>& wavelengths);
///@}

/// Which of a file's wavelengths become RGB, and how.
struct SpectralChannels
{
  std::vector<std::size_t> Chosen;
  std::vector<glm::dvec3> Weights; // RGB = sum of weights * value, of each chosen one
  std::string Note;
};

/**
 * The visible wavelengths, as GetSpectralWeights sums them; fewer than two of them: the first
 * wavelength alone, gray. name: empty, or which wavelength, gray. Throws FileError, "WHERE, name:
 * ...", where there is no such one. wavelengths: nm, ascending, at least one.
 */
SpectralChannels ChooseChannels(
  const std::vector<double>& wavelengths, const std::string& name, const std::string& where);
} // namespace measuredbrdf

#endif
