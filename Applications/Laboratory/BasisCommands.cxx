// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Measuring.h"
#include "Methods.h"
#include "Options.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"

#include <memory>
#include <vector>

// Materials in a basis: by a simulated device, by projection, and continued beyond a zone.
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
tool::Range FindDeviceZone(const AcquireOptions& options, const CLI::App* command)
{
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
void RunAcquire(const AcquireOptions& options, const CLI::App* command)
{
  laboratory::AcquisitionOptions device = options.Device;
  const tool::Range range = FindDeviceZone(options, command);
  device.Zone[0] = range.Begin;
  device.Zone[1] = range.End;
  tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  const laboratory::Acquisition taken =
    laboratory::Acquire(material.BRDF, device, laboratory::ShowProgress("acquiring"));
  tool::WriteMaterial(taken.Stack, options.Output);
  tool::PrintOut(options.File + " -> " + options.Output + "\n" +
                 "photographs: " + std::to_string(taken.NumberOfPhotographs) + "\n" +
                 "relative L2 error inside the zone: " +
                 tool::FormatPercent(vtkBRDFResampler::GetZoneRelativeL2Error(
                   material.BRDF, taken.Stack, device.Zone, device.Zone, 1 << 16)) +
                 "\n" + tool::DescribeForm(taken.Stack) + "\n");
}

struct ProjectOptions
{
  std::string File;
  std::string Output;
  int Basis = -1;
  int Order = 0;
  std::string Zone = "9,57";
  bool Extrapolate = false;
  laboratory::ExtrapolationOptions Harmonics;
};

//------------------------------------------------------------------------------
void CheckProject(const ProjectOptions& options, const CLI::App* command)
{
  for (const char* option : { "--maximum-residual", "--maximum-negative-mass" })
  {
    if (command->count(option) > 0 && !options.Extrapolate)
    {
      throw tool::UsageError(std::string(option) + ": has no effect without --extrapolate");
    }
  }
}

//------------------------------------------------------------------------------
// What a projection needs, and an extrapolation of what is in a basis already does not.
void CheckProjection(const ProjectOptions& options)
{
  if (options.Basis < 0 || options.Order == 0)
  {
    throw tool::UsageError(
      options.File + " is not in a basis yet: --basis and --order are required");
  }
  if (options.Extrapolate && options.Basis < vtkBasisBRDF::ZONAL)
  {
    throw tool::UsageError(std::string("--extrapolate: --basis ") +
                           vtkBasisBRDF::GetBasisName(options.Basis) +
                           " covers the hemisphere; expected zonal or legendre-fourier");
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBasisBRDF> Extrapolate(
  const ProjectOptions& options, vtkBasisBRDF* input, std::string& text)
{
  laboratory::ExtrapolationOptions settings = options.Harmonics;
  settings.Order = options.Order;
  const laboratory::Extrapolation whole =
    laboratory::Extrapolate(input, settings, laboratory::ShowProgress("extrapolating"));
  const std::string residual = tool::FormatNumber(whole.InZoneResidual) + " (limit " +
                               tool::FormatNumber(whole.ResidualLimit) + ")";
  if (!whole.IsAccepted)
  {
    throw tool::Error(options.File + ": harmonics of order " +
                      std::to_string(whole.Output->GetOrder()) + " leave a relative residual of " +
                      residual + " inside the zone and a negative mass of " +
                      tool::FormatNumber(whole.NegativeMass) + " (limit " +
                      tool::FormatNumber(settings.MaximumNegativeMass) +
                      "), too much to trust them outside; nothing was written. Use "
                      "'measured-brdf fit " +
                      options.File + " --model d-brdf' instead");
  }
  text += "lambda: " + tool::FormatNumber(whole.Lambda) +
          "\nrelative residual inside the zone: " + residual + "\n";
  return whole.Output;
}

//------------------------------------------------------------------------------
void RunProject(const ProjectOptions& options, const CLI::App* command)
{
  CheckProject(options, command);
  const tool::Range range = tool::ParseZone("--zone", options.Zone);
  const double zone[2] = { range.Begin, range.End };
  tool::Interruptible interruptible;
  const tool::Material material = tool::LoadMaterial(options.File);
  vtkSmartPointer<vtkBasisBRDF> output = vtkBasisBRDF::SafeDownCast(material.BRDF);
  const bool projects = !options.Extrapolate || !output;
  std::string text = options.File + " -> " + options.Output + "\n";
  if (projects)
  {
    CheckProjection(options);
    output =
      laboratory::ProjectOnto(material.BRDF, options.Basis, options.Order, zone, options.File);
  }
  else
  {
    for (const char* option : { "--basis", "--zone" })
    {
      if (command->count(option) > 0)
      {
        throw tool::UsageError(
          std::string(option) + ": has no effect, " + options.File + " is in a basis already");
      }
    }
  }
  if (options.Extrapolate)
  {
    output = Extrapolate(options, output, text);
  }
  tool::WriteMaterial(output, options.Output);
  if (projects)
  {
    text += "relative L2 error from " + tool::FormatNumber(zone[0]) + " to " +
            tool::FormatNumber(zone[1]) + " degrees: " +
            tool::FormatPercent(vtkBRDFResampler::GetZoneRelativeL2Error(
              material.BRDF, output, zone, zone, 1 << 16)) +
            "\nrelative L2 error over the hemisphere: " +
            tool::FormatPercent(vtkBRDFResampler::GetRelativeL2Error(material.BRDF, output)) + "\n";
  }
  tool::PrintOut(
    text + "negative mass before the clamp: " +
    tool::FormatPercent(output->GetNegativeMass(laboratory::AllAngles, laboratory::AllAngles)) +
    "\n" + tool::DescribeForm(output) + "\n");
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
    ->add_option_function<std::string>(
      "--basis",
      [options](const std::string& name) { options->Device.Basis = laboratory::Bases.at(name); },
      "Patterns that the projector shows: zonal (default), legendre-fourier or hemispherical")
    ->check(CLI::IsMember(patterns));
  command
    ->add_option("--order", options->Device.Order,
      "Order L of the basis (default 6): (L+1)^2 functions, each with two photographs except the "
      "first")
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
  command->add_option("--zone", options->Zone,
    "Polar angles in degrees that projector and camera cover (default 9,57)");
  command
    ->add_option("--noise", options->Device.Noise,
      "Standard deviation of the camera's noise, as a share of the brightest pixel of each pair of "
      "photographs (default 0)")
    ->check(Between(0.0, 1e6));
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
  command->callback([options, command]() { RunAcquire(*options, command); });
}
//------------------------------------------------------------------------------
void AddProjectCommand(CLI::App& app)
{
  auto options = std::make_shared<ProjectOptions>();
  CLI::App* command = app.add_subcommand(
    "project", "Project a material onto a basis, or extrapolate a basis beyond its zone");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command
    ->add_option_function<std::string>(
      "--basis",
      [options](const std::string& name) { options->Basis = laboratory::Bases.at(name); },
      "spherical-harmonics or hemispherical (both of light from 0 to 90 degrees), zonal or "
      "legendre-fourier (of a zone)")
    ->check(CLI::IsMember(laboratory::Bases));
  command
    ->add_option("--order", options->Order,
      "Order N of the basis: (N+1)^2 functions. For a FILE that is in a basis already: order of "
      "the "
      "harmonics (default: its own)")
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
  command->add_option("--zone", options->Zone,
    "Polar angles in degrees of light and view (default 9,57): the zone of the last two bases and "
    "of the first printed error");
  command->add_flag("--extrapolate", options->Extrapolate,
    "Extrapolate beyond the zone by spherical harmonics. A FILE that is in a basis already (such "
    "as "
    "from 'acquire') is not projected again");
  command
    ->add_option("--maximum-residual", options->Harmonics.MaximumResidual,
      "Largest relative residual inside the zone at which an extrapolation is written (default "
      "0.1 for zonal inputs, 0.03 for others)")
    ->check(CLI::Range(1e-6, 1e6));
  command
    ->add_option("--maximum-negative-mass", options->Harmonics.MaximumNegativeMass,
      "Largest share of negative values over the hemisphere at which it is written (default 0.05)")
    ->check(CLI::Range(0.0, 1.0));
  command->add_option("-o,--output", options->Output, "File to write, ending in .exr")
    ->check(EndsIn({ ".exr" }))
    ->required();
  command->footer(
    "An extrapolation whose residual inside the zone is too large is refused with exit status 1:\n"
    "use 'fit' for such materials.\n\n"
    "Examples:\n"
    "  measured-brdf-lab project blue-fabric --basis legendre-fourier --order 6 -o blue.exr\n"
    "  measured-brdf-lab project stack.exr --extrapolate -o whole.exr");
  command->callback([options, command]() { RunProject(*options, command); });
}
} // namespace tool
