// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Spectra, and their linear RGB under D65 by another program: colour-science 0.4.7, sd_to_XYZ with
 * its CIE 1931 color-matching functions in steps of 1 nm and its D65 ("Integration"), and the
 * inverse of IEC 61966-2-1's matrix.
 */

#ifndef SpectraForTests_h
#define SpectraForTests_h

#include <cmath>

namespace testio
{
struct TestSpectrum
{
  const char* Name;
  double (*Value)(double nanometers);
  double RGB[3];
};

/// Of white. Its tables have steps of 1 nm; linear between 5 nm they give 5e-4 less green of the
/// narrow one, and spectra that are linear between 3.3 nm another 2e-4.
constexpr double SpectrumTolerance = 1e-3;

inline const TestSpectrum TestSpectra[] = {
  { "ramp", [](double l) { return (l - 360.0) / 470.0; }, { 0.60103188, 0.3893721, 0.17191653 } },
  { "red", [](double l) { return 1.0 / (1.0 + std::exp(-(l - 600.0) / 12.0)); },
    { 0.82738007, 0.00381894, -0.01706065 } },
  { "green", [](double l) { return std::exp(-(l - 520.0) * (l - 520.0) / 324.0); },
    { -0.2516626, 0.38017733, -0.00539895 } },
};
} // namespace testio

#endif
