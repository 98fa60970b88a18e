// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"
#include "Tool.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace
{
// The explorer is a program of its own, so that this one needs no Qt.
const char* const Explorer = "measured-brdf-explorer";

//------------------------------------------------------------------------------
void Run(const std::vector<std::string>& given)
{
#if MEASUREDBRDF_HAS_EXPLORER
  const std::string beside = tool::FindBeside(Explorer);
  const std::string program = beside.empty() ? Explorer : beside; // which the PATH may know
  std::vector<std::string> words = { program };
  words.insert(words.end(), given.begin(), given.end());
  std::vector<char*> arguments;
  for (std::string& word : words)
  {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  execvp(program.c_str(), arguments.data());
  throw tool::Error(program + ": could not be started: " + std::strerror(errno));
#else
  (void)given;
  throw tool::Error(
    "this build has no explorer: VTK's Qt widget was not there or was not wanted. With Debian's "
    "libvtk9-qt-dev and qtbase5-dev (or qt6-base-dev) installed, configure again with "
    "-DMEASUREDBRDF_WITH_QT=ON and build");
#endif
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddExploreCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("explore",
    "Open a window: materials under environments, method against method, lobes and slices");
#if MEASUREDBRDF_HAS_EXPLORER
  command->set_help_flag(); // the explorer's own
#endif
  command->prefix_command();
  command->footer("Example:\n  measured-brdf explore gold-paint --environment hall");
  command->callback([command]() { Run(command->remaining()); });
}
} // namespace tool
