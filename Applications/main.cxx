// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// measured-brdf: measured materials from the command line, over the module's public API.

#include "MeasuredBRDFToolVersion.h"
#include "Program.h"
#include "Tool.h"

namespace
{
//------------------------------------------------------------------------------
void AddCommands(CLI::App& app)
{
  tool::AddListCommand(app);
#if MEASUREDBRDF_WITH_CURL
  tool::AddFetchCommand(app);
#else
  tool::AddAbsentCommand(app, "fetch",
    "this build has no libcurl (MEASUREDBRDF_WITH_CURL), so it downloads nothing; "
    "python3 -m vtkmeasuredbrdf fetch does");
#endif
  tool::AddInfoCommand(app);
  tool::AddEvaluateCommand(app);
  tool::AddIntegrateCommand(app);
  tool::AddLightsCommand(app);
  tool::AddRenderCommand(app);
  tool::AddExploreCommand(app);
  tool::AddPlanCommand(app);
  tool::AddCompareCommand(app);
  tool::AddDiffCommand(app);
  tool::AddChartCommand(app);
  tool::AddGalleryCommand(app);
  tool::AddConvertCommand(app);
  tool::AddSvbrdfCommand(app);
  tool::AddFitCommand(app);
  tool::AddExportCommand(app);
  tool::AddAbsentCommand(app, "view",
    "this command is in the Python package: python3 -m vtkmeasuredbrdf view [FILE...]");
  for (const std::string name :
    { "acquire", "photograph", "project", "representations", "stability", "thesis" })
  {
    tool::AddAbsentCommand(app, name,
      "this command is in the program measured-brdf-lab, which the build makes with "
      "MEASUREDBRDF_BUILD_LABORATORY=ON: measured-brdf-lab " +
        name + " ...");
  }
}
}

int main(int argc, char* argv[])
{
  return tool::RunProgram(argc, argv,
    { "measured-brdf",
      "Measured materials (BRDFs): look into them, evaluate them, light them with an HDR\n"
      "environment, render and convert them.",
      "Start with:\n"
      "  measured-brdf list                      the materials that come with the tool\n"
      "  measured-brdf gallery -o gallery.png    a picture of them\n"
      "  measured-brdf render gold-paint --environment sky -o gold.png\n"
      "  measured-brdf COMMAND --help            what a command does and its options",
      AddCommands });
}
