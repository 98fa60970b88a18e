// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The commands of measured-brdf-lab, and what several of them make and measure.
 */

#ifndef Laboratory_h
#define Laboratory_h

#include "Progress.h"

#include "vtkBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace CLI
{
class App;
}

namespace laboratory
{
/// What --basis takes, and vtkBasisBRDF's types.
const std::map<std::string, int> Bases = { { "spherical-harmonics",
                                             vtkBasisBRDF::SPHERICAL_HARMONICS },
  { "hemispherical", vtkBasisBRDF::HEMISPHERICAL }, { "zonal", vtkBasisBRDF::ZONAL },
  { "legendre-fourier", vtkBasisBRDF::LEGENDRE_FOURIER } };

/// For work that shows its progress: draws a bar, and throws Error where Ctrl-C was pressed. Needs
/// an Interruptible.
inline std::function<void(double)> ShowProgress(const std::string& label)
{
  return [bar = std::make_shared<tool::ProgressBar>(label)](double share)
  {
    bar->Update(share);
    tool::Interruptible::Check();
  };
}

///@{
/// The material in a basis, by least squares, zonal ones over a zone in degrees; its D-BRDF fit.
/// With a progress bar. Throw Error, which begins with name. Need an Interruptible.
vtkSmartPointer<vtkBasisBRDF> ProjectOnto(
  vtkBRDF* brdf, int basis, int order, const double zone[2], const std::string& name);
vtkSmartPointer<vtkBRDF> FitDistribution(vtkBRDF* brdf, const std::string& name);
///@}

/// Share of negative values before the clamp, over the whole hemisphere.
double GetNegativeMass(vtkBasisBRDF* brdf);

/// "label: 3.21 %\n"
std::string FormatShare(const std::string& label, double share);
} // namespace laboratory

namespace tool
{
///@{
/// Add one subcommand each.
void AddAcquireCommand(CLI::App& app);
void AddPhotographCommand(CLI::App& app);
void AddProjectCommand(CLI::App& app);
void AddRepresentationsCommand(CLI::App& app);
void AddStabilityCommand(CLI::App& app);
void AddThesisCommand(CLI::App& app);
///@}
} // namespace tool

#endif
