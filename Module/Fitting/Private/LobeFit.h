// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fits a Lambert part and up to three analytic lobes about the half vector, with Ceres.
 *
 * f = albedo/pi + sum over lobes of (base + rise (1 - h.o)^5) shape(exponents): linear in all
 * parameters except the exponents. The scale S and reflectance R of Ashikhmin-Shirley are replaced
 * by base = S R and rise = S (1 - R). Changes of S and R can cancel each other; changes of base and
 * rise cannot, and the bounds S >= 0, 0 <= R <= 1 become base >= 0, rise >= 0.
 */

#ifndef LobeFit_h
#define LobeFit_h

#include "FitSamples.h"
#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkBRDFFitter;

namespace measuredbrdf
{
enum class LobeShape
{
  BlinnPhong,       // (n+2)/(2 pi) cos^n theta_h; no rise
  AshikhminShirley, // sqrt((nu+1)(nv+1))/(8 pi) (n.h)^e / ((h.o) max(cos_i, cos_o))
};

struct LobeModel
{
  LobeShape Shape = LobeShape::BlinnPhong;
  int NumberOfLobes = 1;
  bool Anisotropic = false; // only Ashikhmin-Shirley's
};

struct LobeFitResult
{
  vtkSmartPointer<vtkBRDF> BRDF; // a sum, lobes by ascending exponent; null: failed or stopped
  std::vector<double> History;   // mean squares over the samples
  bool Converged = false;
  std::string Report; // the parameters, or why it failed
};

/**
 * All combinations of log-spaced exponents are tried on a few samples with the best non-negative
 * coefficients; the best ones are refined on more, the best of those on all. settings: the numbers
 * of starts and iterations, the start seed and the tolerance. progress: returns false to stop.
 */
LobeFitResult FitLobes(const FitSamples& samples, const LobeModel& model, vtkBRDFFitter* settings,
  const std::function<bool(double)>& progress);
} // namespace measuredbrdf

#endif
