// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the table of vtkAnisotropicTableRadianceIntegrator is made. Private to the module.
 */

#ifndef AnisotropicSynthesis_h
#define AnisotropicSynthesis_h

#include "AnisotropicTable.h"
#include "EnvironmentHarmonics.h"
#include "MaterialPrecomputation.h"

#include <functional>

namespace measuredbrdf
{
/// The table's radiance, of its kernels up to a harmonic degree. goOn gets the share that is done;
/// where it says false, the table is not complete, and the result is 0. Else it is what undoes the
/// radiance's scaling.
double SynthesizeAnisotropic(const EnvironmentHarmonics& environment,
  const MaterialPrecomputation::AnisotropicKernels& knots, int degree,
  const std::function<bool(double)>& goOn, AnisotropicTable& table);

/// A table's profile over all views; scale: what undoes its radiance's scaling.
void MakeAnisotropicProfile(const AnisotropicViews& views,
  const MaterialPrecomputation::AnisotropicKernels& knots, double scale, AnisotropicTable& table);
} // namespace measuredbrdf

#endif
