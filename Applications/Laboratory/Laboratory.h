// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The commands of measured-brdf-lab.
 */

#ifndef Laboratory_h
#define Laboratory_h

namespace CLI
{
class App;
}

namespace tool
{
///@{
/// Add one subcommand each.
void AddAcquireCommand(CLI::App& app);
void AddProjectCommand(CLI::App& app);
void AddRepresentationsCommand(CLI::App& app);
void AddStabilityCommand(CLI::App& app);
void AddThesisCommand(CLI::App& app);
///@}
} // namespace tool

#endif
