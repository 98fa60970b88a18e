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
/// where it says false, the table is not complete, and the result is false.
bool SynthesizeAnisotropic(const EnvironmentHarmonics& environment,
  const MaterialPrecomputation::AnisotropicKernels& knots, int degree,
  const std::function<bool(double)>& goOn, AnisotropicTable& table);

/// The profile over all views of a table whose radiance is there.
void MakeAnisotropicProfile(const AnisotropicViews& views,
  const MaterialPrecomputation::AnisotropicKernels& knots, AnisotropicTable& table);
} // namespace measuredbrdf

#endif
