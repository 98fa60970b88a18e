// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// measured-brdf-lab: the experiments behind the methods.

#include "Laboratory.h"
#include "Program.h"

namespace
{
//------------------------------------------------------------------------------
void AddCommands(CLI::App& app)
{
  tool::AddThesisCommand(app);
  tool::AddAcquireCommand(app);
  tool::AddPhotographCommand(app);
  tool::AddProjectCommand(app);
  tool::AddRepresentationsCommand(app);
  tool::AddStabilityCommand(app);
}
}

int main(int argc, char* argv[])
{
  return tool::RunProgram(argc, argv,
    { "measured-brdf-lab",
      "Experiments with measured materials: the thesis's device, bases and figures, and every "
      "known\n"
      "way to fail, measured.",
      "Start with:\n"
      "  measured-brdf-lab thesis -o output/thesis            the thesis's figures\n"
      "  measured-brdf-lab representations gold-paint         what each form of it would cost\n"
      "  measured-brdf-lab COMMAND --help                     what a command does and its options",
      AddCommands });
}
