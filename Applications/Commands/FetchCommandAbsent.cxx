// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The command fetch of a build without libcurl: not in the help, but it says why it is not there.
#include "Tool.h"

#include <CLI/CLI.hpp>

namespace tool
{
//------------------------------------------------------------------------------
void AddFetchCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("fetch", "");
  command->group("");
  command->allow_extras();
  command->callback(
    []()
    {
      throw Error("fetch: this build has no libcurl (MEASUREDBRDF_WITH_CURL), so it downloads "
                  "nothing");
    });
}
} // namespace tool
