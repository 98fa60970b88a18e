// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bases.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Methods.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDFAcquisition.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <memory>

namespace
{
struct AcquireOptions
{
  std::string File;
  std::string Output;
  std::string Basis = "zonal";
  int Order = 6;
  std::string Zone = "9,57";
  double Noise = 0.0;
  int Bits = 0;
  unsigned int Seed = 1;
};

//------------------------------------------------------------------------------
tool::Range Check(const AcquireOptions& options, const CLI::App* command)
{
  if (tool::Extension(options.Output) != ".exr")
  {
    throw tool::UsageError(options.Output + ": OUT must end in .exr");
  }
  if (!(options.Noise >= 0.0) || !std::isfinite(options.Noise))
  {
    throw tool::UsageError("--noise: " + tool::FormatNumber(options.Noise) +
                           " is not a standard deviation; expected 0 or more, like 0.01");
  }
  if (options.Basis != "hemispherical")
  {
    return tool::ParseZone("--zone", options.Zone);
  }
  if (command->count("--zone") > 0)
  {
    throw tool::UsageError(
      "--zone: has no effect with --basis hemispherical, which covers 0 to 90 degrees");
  }
  return { 0.0, 90.0 };
}

//------------------------------------------------------------------------------
void Run(const AcquireOptions& options, const CLI::App* command)
{
  const tool::Range range = Check(options, command);
  const double zone[2] = { range.Begin, range.End };
  tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  vtkNew<vtkBRDFAcquisition> acquisition;
  acquisition->SetInput(material.BRDF);
  acquisition->SetBasis(tool::FindBasis(options.Basis));
  acquisition->SetOrder(options.Order);
  acquisition->SetZone(zone);
  acquisition->SetNoise(options.Noise);
  acquisition->SetBits(options.Bits);
  acquisition->SetSeed(options.Seed);
  if (!tool::RunWithProgress(acquisition.Get(), &vtkBRDFAcquisition::Acquire, "acquiring"))
  {
    throw tool::Error(options.File + ": " + tool::TakeErrorText());
  }
  vtkBasisBRDF* output = acquisition->GetOutput();
  tool::WriteMaterial(output, options.Output);
  tool::PrintOut(options.File + " -> " + options.Output + "\n" +
                 "photographs: " + std::to_string(acquisition->GetNumberOfPhotographs()) + "\n" +
                 tool::FormatShare("relative L2 error inside the zone",
                   tool::GetZoneError(material.BRDF, output, zone)) +
                 tool::DescribeForm(output) + "\n");
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddAcquireCommand(CLI::App& app)
{
  auto options = std::make_shared<AcquireOptions>();
  CLI::App* command = app.add_subcommand(
    "acquire", "Simulate a device with a projector and a camera that measures a material");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command
    ->add_option("--basis", options->Basis,
      "Patterns that the projector shows: zonal (default), legendre-fourier or hemispherical")
    ->check(CLI::IsMember({ "zonal", "legendre-fourier", "hemispherical" }));
  command
    ->add_option("--order", options->Order,
      "Order L of the basis (default 6): (L+1)^2 functions, each with two photographs except the "
      "first")
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
  command->add_option("--zone", options->Zone,
    "Polar angles in degrees that projector and camera cover (default 9,57)");
  command->add_option("--noise", options->Noise,
    "Standard deviation of the camera's noise, as a share of the brightest pixel of each pair of "
    "photographs (default 0)");
  command
    ->add_option(
      "--bits", options->Bits, "Bits of the camera's pixels, 1 to 24; 0 (default): no rounding")
    ->check(CLI::Range(0, 24));
  command->add_option("--seed", options->Seed, "Seed of the noise (default 1)");
  command->add_option("-o,--output", options->Output, "File to write, ending in .exr")->required();
  command->footer(
    "The stack of coefficients is a material like any other: use it with 'info', 'render', ...\n"
    "'project OUT.exr --extrapolate' extends it beyond the zone.\n\n"
    "Example:\n  measured-brdf-lab acquire gold-paint --order 6 --noise 0.01 --bits 12 -o "
    "stack.exr");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
