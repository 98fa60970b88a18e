// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A simulation of the measuring device of Ghosh et al. 2007, and what continues its result beyond
 * the directions that it reaches.
 */

#ifndef Acquisition_h
#define Acquisition_h

#include "vtkBasisBRDF.h"
#include "vtkSmartPointer.h"

#include <functional>

class vtkBRDF;

namespace laboratory
{
/// Gets the share done; may throw to stop.
using Progress = std::function<void(double)>;

struct AcquisitionOptions
{
  int Basis = vtkBasisBRDF::ZONAL; // or hemispherical, or Legendre x Fourier
  int Order = 6;
  double Zone[2] = { 9.0, 57.0 }; // degrees that projector and camera reach
  double Noise = 0.0;             // standard deviation, as a share of the brightest pixel
  int Bits = 0;                   // of the camera's pixels; 0: no rounding
  unsigned int Seed = 1;          // of the noise: the same one gives the same bits
  int NumberOfTheta = 48;         // of the camera's pixels
  int NumberOfPhi = 32;
};

struct Acquisition
{
  vtkSmartPointer<vtkBasisBRDF> Stack;
  int NumberOfPhotographs = 0;
};

/**
 * A projector lights the sample from all directions of a zone at once with the basis functions B_k,
 * one after the other. Each is shown as two patterns, max(B_k, 0) and max(-B_k, 0), the second only
 * where there is one. A camera sees every direction o of the same zone in one image. The difference
 * of the two photographs is
 *
 *   C_k(o) = integral over the zone of f(i,o) cos(theta_i) B_k(i) di,
 *
 * one slice of the coefficient stack: vtkBasisBRDF with IncidentCosine on, because the projector's
 * light includes the cosine. Each pair of photographs is exposed so that its brightest pixel is 1;
 * then noise is added, and values are clipped to [0, 1] and rounded. For isotropic materials the
 * camera's azimuths are averaged after the coefficients are rotated, which also averages the noise.
 *
 * The papers' figures (zone, orders, pixels, noise) could not be checked; the defaults are this
 * project's. Throws std::runtime_error where the coefficients are too large for floats.
 */
Acquisition Acquire(
  vtkBRDF* sample, const AcquisitionOptions& options, const Progress& show = [](double) {});

struct ExtrapolationOptions
{
  int Order = 0; // of the harmonics; 0: the input's
  // Largest accepted residual; 0: 0.10 for zonal inputs, most of whose residual comes from the
  // zone's edges, and 0.03 for others.
  double MaximumResidual = 0.0;
  double MaximumNegativeMass = 0.05; // largest accepted one
};

struct Extrapolation
{
  vtkSmartPointer<vtkBasisBRDF> Output;
  double Lambda = 0.0;
  double InZoneResidual = 0.0; // L2, both cosines as weights
  double ResidualLimit = 0.0;
  double NegativeMass = 0.0; // vtkBasisBRDF::GetNegativeMass over the hemisphere
  bool IsAccepted = false;
};

/**
 * Spherical harmonics of the whole hemisphere for i and o, from a basis over zones. For each
 * azimuthal order, the coefficients minimize the squared distance within the zone plus lambda times
 * the squared Laplacian, first over i, then over o. The L-curve finds lambda (Hansen 1992).
 *
 * Measured on 23 published fits, 14 measured materials and 8 Blinn-Phong lobes (exponents 1 to 200)
 * at orders 4, 6, 8, 12 on 9 to 57 degrees: the error over 0 to 75 degrees, compared with that of
 * keeping the value at the zone's edge. Zonal: of 77 accepted results 76 are better (0.21 to 0.94
 * times that error), one is worse (11 instead of 8.7 %); of the refused results two thirds are
 * worse, up to 2 times. Legendre x Fourier: of 68 accepted results 56 are better, 12 worse (at most
 * 11 instead of 7.1 %); of the refused results five in six are worse, up to 3.3 times.
 *
 * Throws std::runtime_error for an input without coefficients, and for sizes that vtkBasisBRDF
 * refuses.
 */
Extrapolation Extrapolate(
  vtkBasisBRDF* input, const ExtrapolationOptions& options = {},
  const Progress& show = [](double) {});
} // namespace laboratory

#endif
