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
#include "MaterialFormat.h"

#include "SRGB.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace measuredbrdf
{
namespace
{
constexpr double TableStep = 5.0; // nm

// Each 5 nm from 380 nm: the color-matching functions x, y, z (ISO/CIE 11664-1), D65 (ISO/CIE
// 11664-2).
constexpr double Table[81][4] = { { 0.001368, 3.9e-05, 0.006450001, 49.9755 },
  { 0.002236, 6.4e-05, 0.01054999, 52.3118 }, { 0.004243, 0.00012, 0.02005001, 54.6482 },
  { 0.00765, 0.000217, 0.03621, 68.7015 }, { 0.01431, 0.000396, 0.06785001, 82.7549 },
  { 0.02319, 0.00064, 0.1102, 87.1204 }, { 0.04351, 0.00121, 0.2074, 91.486 },
  { 0.07763, 0.00218, 0.3713, 92.4589 }, { 0.13438, 0.004, 0.6456, 93.4318 },
  { 0.21477, 0.0073, 1.0390501, 90.057 }, { 0.2839, 0.0116, 1.3856, 86.6823 },
  { 0.3285, 0.01684, 1.62296, 95.7736 }, { 0.34828, 0.023, 1.74706, 104.865 },
  { 0.34806, 0.0298, 1.7826, 110.936 }, { 0.3362, 0.038, 1.77211, 117.008 },
  { 0.3187, 0.048, 1.7441, 117.41 }, { 0.2908, 0.06, 1.6692, 117.812 },
  { 0.2511, 0.0739, 1.5281, 116.336 }, { 0.19536, 0.09098, 1.28764, 114.861 },
  { 0.1421, 0.1126, 1.0419, 115.392 }, { 0.09564, 0.13902, 0.8129501, 115.923 },
  { 0.05795001, 0.1693, 0.6162, 112.367 }, { 0.03201, 0.20802, 0.46518, 108.811 },
  { 0.0147, 0.2586, 0.3533, 109.082 }, { 0.0049, 0.323, 0.272, 109.354 },
  { 0.0024, 0.4073, 0.2123, 108.578 }, { 0.0093, 0.503, 0.1582, 107.802 },
  { 0.0291, 0.6082, 0.1117, 106.296 }, { 0.06327, 0.71, 0.07824999, 104.79 },
  { 0.1096, 0.7932, 0.05725001, 106.239 }, { 0.1655, 0.862, 0.04216, 107.689 },
  { 0.2257499, 0.9148501, 0.02984, 106.047 }, { 0.2904, 0.954, 0.0203, 104.405 },
  { 0.3597, 0.9803, 0.0134, 104.225 }, { 0.4334499, 0.9949501, 0.008749999, 104.046 },
  { 0.5120501, 1, 0.005749999, 102.023 }, { 0.5945, 0.995, 0.0039, 100 },
  { 0.6784, 0.9786, 0.002749999, 98.1671 }, { 0.7621, 0.952, 0.0021, 96.3342 },
  { 0.8425, 0.9154, 0.0018, 96.0611 }, { 0.9163, 0.87, 0.001650001, 95.788 },
  { 0.9786, 0.8163, 0.0014, 92.2368 }, { 1.0263, 0.757, 0.0011, 88.6856 },
  { 1.0567, 0.6949, 0.001, 89.3459 }, { 1.0622, 0.631, 0.0008, 90.0062 },
  { 1.0456, 0.5668, 0.0006, 89.8026 }, { 1.0026, 0.503, 0.00034, 89.5991 },
  { 0.9384, 0.4412, 0.00024, 88.6489 }, { 0.8544499, 0.381, 0.00019, 87.6987 },
  { 0.7514, 0.321, 0.0001, 85.4936 }, { 0.6424, 0.265, 4.999999e-05, 83.2886 },
  { 0.5419, 0.217, 3e-05, 83.4939 }, { 0.4479, 0.175, 2e-05, 83.6992 },
  { 0.3608, 0.1382, 1e-05, 81.863 }, { 0.2835, 0.107, -1.90582413132e-21, 80.0268 },
  { 0.2187, 0.0816, 0, 80.1207 }, { 0.1649, 0.061, 0, 80.2146 }, { 0.1212, 0.04458, 0, 81.2462 },
  { 0.0874, 0.032, 0, 82.2778 }, { 0.0636, 0.0232, 0, 80.281 }, { 0.04677, 0.017, 0, 78.2842 },
  { 0.0329, 0.01192, 0, 74.0027 }, { 0.0227, 0.00821, 0, 69.7213 },
  { 0.01584, 0.005723, 0, 70.6652 }, { 0.01135916, 0.004102, 0, 71.6091 },
  { 0.008110916, 0.002929, 0, 72.979 }, { 0.005790346, 0.002091, 0, 74.349 },
  { 0.004109457, 0.001484, 0, 67.9765 }, { 0.002899327, 0.001047, 0, 61.604 },
  { 0.00204919, 0.00074, 0, 65.7448 }, { 0.001439971, 0.00052, 0, 69.8856 },
  { 0.0009999493, 0.0003611, 0, 72.4863 }, { 0.0006900786, 0.0002492, 0, 75.087 },
  { 0.0004760213, 0.0001719, 0, 69.3398 }, { 0.0003323011, 0.00012, 0, 63.5927 },
  { 0.0002348261, 8.48e-05, 0, 55.0054 }, { 0.0001661505, 6e-05, 0, 46.4182 },
  { 0.000117413, 4.24e-05, 0, 56.6118 }, { 8.307527e-05, 3e-05, 0, 66.8054 },
  { 5.870652e-05, 2.12e-05, 0, 65.0941 }, { 4.150994e-05, 1.499e-05, 0, 63.3828 } };

// What the table's columns are at a wavelength.
glm::dvec4 GetEntry(double wavelength)
{
  const double place = (wavelength - FirstVisible) / TableStep;
  const auto low = std::min(static_cast<std::size_t>(place), std::size(Table) - 2);
  const double t = place - static_cast<double>(low);
  return glm::mix(glm::make_vec4(Table[low]), glm::make_vec4(Table[low + 1]), t);
}

bool IsVisible(double wavelength)
{
  return wavelength > FirstVisible - 0.5 && wavelength < LastVisible + 0.5;
}
}

//------------------------------------------------------------------------------
std::vector<glm::dvec3> GetSpectralWeights(const std::vector<double>& wavelengths)
{
  std::vector<glm::dvec3> weights(wavelengths.size(), glm::dvec3(0.0)); // of X, Y, Z at first
  glm::dvec3 sums(0.0);
  const std::size_t last = wavelengths.size() - 1;
  std::size_t low = 0;
  for (double l = FirstVisible; l <= LastVisible; l += 1.0)
  {
    while (low + 1 < last && wavelengths[low + 1] <= l)
    {
      ++low;
    }
    const std::size_t high = std::min(low + 1, last);
    const double t =
      high > low
        ? std::clamp((l - wavelengths[low]) / (wavelengths[high] - wavelengths[low]), 0.0, 1.0)
        : 0.0;
    const glm::dvec4 entry = GetEntry(l);
    const glm::dvec3 light = entry.w * glm::dvec3(entry);
    weights[low] += (1.0 - t) * light;
    weights[high] += t * light;
    sums += light;
  }
  // The matrices are lists of rows, glm's of columns.
  const glm::dmat3 toXyz = glm::transpose(glm::make_mat3(&RGBToXYZ[0][0]));
  const glm::dmat3 toRgb = glm::transpose(glm::make_mat3(&XYZToRGB[0][0]));
  const glm::dvec3 white = toXyz * glm::dvec3(1.0);
  for (glm::dvec3& weight : weights)
  {
    weight = toRgb * (weight / sums * white);
  }
  return weights;
}

//------------------------------------------------------------------------------
std::string GetWavelengthName(double nanometers) { return NumberText(nanometers) + "nm"; }

//------------------------------------------------------------------------------
std::vector<std::string> GetWavelengthNames(const std::vector<double>& wavelengths)
{
  std::vector<std::string> names;
  for (const double wavelength : wavelengths)
  {
    names.push_back(GetWavelengthName(wavelength));
  }
  return names;
}

//------------------------------------------------------------------------------
SpectralChannels ChooseChannels(
  const std::vector<double>& wavelengths, const std::string& name, const std::string& where)
{
  SpectralChannels channels;
  std::vector<double> chosen;
  for (std::size_t k = 0; k < wavelengths.size(); ++k)
  {
    if (name.empty() ? IsVisible(wavelengths[k]) : GetWavelengthName(wavelengths[k]) == name)
    {
      channels.Chosen.push_back(k);
      chosen.push_back(wavelengths[k]);
    }
  }
  if (!name.empty() && chosen.empty())
  {
    constexpr std::size_t most = 8;
    std::string some;
    for (std::size_t k = 0; k < wavelengths.size() && k < most; ++k)
    {
      some += (k > 0 ? ", " : "") + GetWavelengthName(wavelengths[k]);
    }
    throw FileError(where + ", name: there is no wavelength " + Quote(name) + ", only " + some +
                    (wavelengths.size() > most ? ", ..." : ""));
  }
  if (name.empty() && chosen.size() > 1)
  {
    channels.Weights = GetSpectralWeights(chosen);
    channels.Note = std::to_string(chosen.size()) + " of " + std::to_string(wavelengths.size()) +
                    " wavelengths, " + GetWavelengthName(chosen.front()) + " to " +
                    GetWavelengthName(chosen.back()) +
                    ": summed over the CIE 1931 color-matching functions under D65.";
    return channels;
  }
  channels.Chosen.assign(1, name.empty() ? 0 : channels.Chosen.front());
  channels.Weights = { glm::dvec3(1.0) };
  channels.Note = "Gray, of the wavelength " +
                  GetWavelengthName(wavelengths[channels.Chosen.front()]) +
                  (name.empty() && wavelengths.size() > 1
                      ? "; FILE#" + GetWavelengthName(wavelengths.back()) + " picks another one."
                      : ".");
  return channels;
}
} // namespace measuredbrdf
