// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Tool.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace
{
struct EvaluateOptions
{
  std::string File;
  std::string Pairs;
  std::string Output;
};

//------------------------------------------------------------------------------
void Run(const EvaluateOptions& options)
{
  static const tool::PairColumns columns = { "ix", "iy", "iz", "ox", "oy", "oz" };
  const std::vector<tool::Pair> pairs = tool::ReadPairs(options.Pairs, columns);
  const tool::Material material = tool::LoadMaterial(options.File);
  material.BRDF->Prepare();
  std::vector<double> rgb(3 * pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    material.BRDF->Evaluate(pairs[k].data(), pairs[k].data() + 3, rgb.data() + 3 * k);
  }
  tool::WriteResults(options.Output, columns, pairs, rgb);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddEvaluateCommand(CLI::App& app)
{
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App* command =
    app.add_subcommand("evaluate", "Look up a material's BRDF for pairs of directions");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command
    ->add_option("--pairs", options->Pairs,
      "CSV file with the columns ix,iy,iz (towards the light) and ox,oy,oz (towards the viewer) in "
      "the surface's frame: z is the normal. Other columns and lines that start with # are ignored")
    ->required();
  command->add_option("-o,--output", options->Output,
    "CSV file to write: the six columns and r,g,b of f(i,o) in 1/sr, linear Rec. 709, without the "
    "cosine (default: standard output)");
  command->footer("Example:\n  measured-brdf evaluate gold-paint --pairs pairs.csv -o values.csv");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
