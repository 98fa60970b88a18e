// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the commands that make basis materials share: names of bases, and the figures they print.
 */

#ifndef Bases_h
#define Bases_h

#include "vtkBRDF.h"
#include "vtkBasisBRDF.h"

#include <string>

namespace tool
{
/// Names of the options: spherical-harmonics, hemispherical, zonal, legendre-fourier; in the order
/// of vtkBasisBRDF's types.
extern const char* const BasisNames[4];

/// The type of a name among them.
int FindBasis(const std::string& name);

/// "label: 3.21 %\n"
std::string FormatShare(const std::string& label, double share);

/// Relative L2 distance from a reference over light and views in a zone (degrees), as a share.
double GetZoneError(vtkBRDF* reference, vtkBRDF* brdf, const double zone[2]);

/// Share of negative values before the clamp, over the whole hemisphere.
double GetNegativeMass(vtkBasisBRDF* brdf);
} // namespace tool

#endif
