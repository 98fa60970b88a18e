// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the table of vtkTableRadianceIntegrator is made. Private to the module.
 */

#ifndef TableSynthesis_h
#define TableSynthesis_h

#include "EnvironmentHarmonics.h"
#include "MaterialPrecomputation.h"
#include "RadianceTable.h"

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace measuredbrdf
{
/// Degree of the harmonics that a map of irradiance needs: the cosine's fall as l^-2.5.
constexpr int IrradianceDegree = 128;

/// What a blur leaves of degree l; smoothing: vtkTableRadianceIntegrator::SetSmoothingDegree.
inline double GetSmoothed(int l, double smoothing)
{
  return smoothing > 0.0 ? std::exp(-0.5 * l * (l + 1.0) / (smoothing * smoothing)) : 1.0;
}

/// The table's radiance, of kernels at its view angles up to a harmonic degree. goOn gets the share
/// that is done; where it says false, the table is not complete, and the result is false.
bool SynthesizeRadiance(const EnvironmentHarmonics& environment,
  const MaterialPrecomputation::Kernels& knots, int degree, double smoothing,
  const std::function<bool(double)>& goOn, RadianceTable& table);

/// The profile over all view angles of a table whose radiance is there.
void MakeProfile(
  const LobeViews& views, const MaterialPrecomputation::Kernels& knots, RadianceTable& table);

/// A map of irradiance, RGB.
std::shared_ptr<const std::vector<float>> MakeIrradiance(const EnvironmentHarmonics& environment);
} // namespace measuredbrdf

#endif
