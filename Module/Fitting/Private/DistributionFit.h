// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fits a Lambert part and the D-BRDF's two tables by alternating non-negative least squares.
 */

#ifndef DistributionFit_h
#define DistributionFit_h

#include "FitSamples.h"

#include <functional>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
struct DistributionSize
{
  int NumberOfTheta;
  int NumberOfPhi; // 1: isotropic
  int NumberOfFresnel;
};

enum class FresnelShape
{
  Monotone, // a table that never falls towards grazing
  Free,     // a table
  Schlick   // base + rise (1 - cos theta_d)^5
};

struct DistributionFitOptions
{
  DistributionSize Size;
  FresnelShape Shape;
  int NumberOfStarts;
  unsigned int StartSeed; // 0: starts from the data, else random ones
  int MaximumNumberOfIterations;
  double Tolerance;
  std::function<bool(double)> Progress; // false: stop
};

/// Tables in vtkDistributionBRDF's order; empty if the fit was stopped. p is normalized, and F
/// contains the scale.
struct DistributionFitResult
{
  double Albedo[3] = { 0.0, 0.0, 0.0 };
  std::vector<float> Distribution;
  std::vector<float> Fresnel;
  std::vector<double> History; // mean squares over the samples
  bool Converged = false;
};

DistributionFitResult FitDistribution(
  vtkBRDF* input, const FitSamples& samples, const DistributionFitOptions& options);
} // namespace measuredbrdf

#endif
