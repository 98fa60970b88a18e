// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The commands of measured-brdf-lab.
 */

#ifndef Laboratory_h
#define Laboratory_h

#include "Progress.h"

#include <functional>
#include <memory>
#include <string>

namespace CLI
{
class App;
}

namespace tool
{
/// For work that shows its progress: draws a bar, and throws Error where Ctrl-C was pressed. Needs
/// an Interruptible.
inline std::function<void(double)> ShowProgress(const std::string& label)
{
  return [bar = std::make_shared<ProgressBar>(label)](double share)
  {
    bar->Update(share);
    Interruptible::Check();
  };
}

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
