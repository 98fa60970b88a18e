// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Methods.h"
#include "Options.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"

#include <cmath>
#include <memory>

namespace
{
struct AcquireOptions
{
  std::string File;
  std::string Output;
  std::string Zone = "9,57";
  laboratory::AcquisitionOptions Device;
};

//------------------------------------------------------------------------------
tool::Range Check(const AcquireOptions& options, const CLI::App* command)
{
  const double noise = options.Device.Noise;
  if (!(noise >= 0.0) || !std::isfinite(noise))
  {
    throw tool::UsageError("--noise: " + tool::FormatNumber(noise) +
                           " is not a standard deviation; expected 0 or more, like 0.01");
  }
  if (options.Device.Basis != vtkBasisBRDF::HEMISPHERICAL)
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
  laboratory::AcquisitionOptions device = options.Device;
  const tool::Range range = Check(options, command);
  device.Zone[0] = range.Begin;
  device.Zone[1] = range.End;
  tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const laboratory::Acquisition taken =
    laboratory::Acquire(material.BRDF, device, laboratory::ShowProgress("acquiring"));
  tool::WriteMaterial(taken.Stack, options.Output);
  tool::PrintOut(options.File + " -> " + options.Output + "\n" +
                 "photographs: " + std::to_string(taken.NumberOfPhotographs) + "\n" +
                 laboratory::FormatShare("relative L2 error inside the zone",
                   vtkBRDFResampler::GetZoneRelativeL2Error(
                     material.BRDF, taken.Stack, device.Zone, device.Zone, 1 << 16)) +
                 tool::DescribeForm(taken.Stack) + "\n");
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
  std::map<std::string, int> patterns = laboratory::Bases;
  patterns.erase("spherical-harmonics");
  command
    ->add_option("--basis", options->Device.Basis,
      "Patterns that the projector shows: zonal (default), legendre-fourier or hemispherical")
    ->transform(CLI::CheckedTransformer(patterns));
  command
    ->add_option("--order", options->Device.Order,
      "Order L of the basis (default 6): (L+1)^2 functions, each with two photographs except the "
      "first")
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
  command->add_option("--zone", options->Zone,
    "Polar angles in degrees that projector and camera cover (default 9,57)");
  command->add_option("--noise", options->Device.Noise,
    "Standard deviation of the camera's noise, as a share of the brightest pixel of each pair of "
    "photographs (default 0)");
  command
    ->add_option("--bits", options->Device.Bits,
      "Bits of the camera's pixels, 1 to 24; 0 (default): no rounding")
    ->check(CLI::Range(0, 24));
  command->add_option("--seed", options->Device.Seed, "Seed of the noise (default 1)");
  command->add_option("-o,--output", options->Output, "File to write, ending in .exr")
    ->check(EndsIn({ ".exr" }))
    ->required();
  command->footer(
    "The stack of coefficients is a material like any other: use it with 'info', 'render', ...\n"
    "'project OUT.exr --extrapolate' extends it beyond the zone.\n\n"
    "Example:\n  measured-brdf-lab acquire gold-paint --order 6 --noise 0.01 --bits 12 -o "
    "stack.exr");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
