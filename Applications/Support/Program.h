// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the two command line programs, measured-brdf and measured-brdf-lab, do alike: they read the
 * command line, run one command, and turn what it throws into a message and an exit status.
 */

#ifndef Program_h
#define Program_h

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace CLI
{
class App;
}

namespace tool
{
struct Program
{
  std::string Name;
  std::string Description;
  std::string Footer; // of the help: with which commands to begin
  std::function<void(CLI::App& app)> AddCommands;
};

/// The exit status.
int RunProgram(int argc, char* argv[], const Program& program);

/// What identifies this machine: processor, threads, system, VTK, and the version of the program.
nlohmann::ordered_json DescribeMachine();

/// The path of another program of the project that lies beside this one; "" where there is none.
std::string FindBeside(const std::string& program);

/// A command that is not in this program, nor in its help, and says why.
void AddAbsentCommand(CLI::App& app, const std::string& name, const std::string& reason);
} // namespace tool

#endif
