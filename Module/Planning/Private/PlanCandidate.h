// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a planner tries, in which order, and what it need not try. Private to the module.
 */

#ifndef PlanCandidate_h
#define PlanCandidate_h

#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
/// A method of vtkRadiancePlanner with its sizes: lights, samples or functions; or rows, view
/// angles, azimuths and samples.
struct PlanCandidate
{
  PlanCandidate(int method, int first, int second = 0, int third = 0, int fourth = 0)
    : Method(method)
    , Sizes{ first, second, third, fourth }
  {
  }
  int Method;
  int Sizes[4];
  int Lights = 0;          // suns and lamps that a hybrid one evaluates
  double LightAngle = 0.0; // degrees: lamps within it are one light
  double Cost = 0.0;       // ns per covered pixel
  double Error = 0.0;
  vtkIdType Bytes = 0;
  double SetUp = 0.0; // ms
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
};

/// "33 rows x 12 view angles x 16 azimuths, 2 suns as lights".
std::string GetSizesText(const PlanCandidate& candidate);

struct PlanConstraints
{
  bool IsIsotropic = true;
  bool All = false; // to compare with, too
  int Lights = 0;   // that suns and lamps make
  double LightAngle = 0.0;
  vtkIdType PyramidBytes = 0; // of the filtered environment
  vtkIdType MaximumBytes = 0; // of textures
  double Pixels = 0.0;        // that share them
};

/// In the order to try them: by cost (vtkRadianceCostModel's, ns a pixel), bytes included.
std::vector<PlanCandidate> ListCandidates(
  const PlanConstraints& wishes, const std::vector<double>& costs);

/// Whether those of its kind that were tried tell that a larger one does not help.
bool CanPrune(
  const PlanCandidate& candidate, const std::vector<PlanCandidate>& tried, double tolerance);
} // namespace measuredbrdf

#endif
