// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"
#include "Bases.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Methods.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"
#include "vtkBasisProjector.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <iterator>
#include <memory>
#include <vector>

namespace
{
struct ProjectOptions
{
  std::string File;
  std::string Output;
  std::string Basis;
  int Order = 0;
  std::string Zone = "9,57";
  bool Extrapolate = false;
  laboratory::ExtrapolationOptions Harmonics;
};

//------------------------------------------------------------------------------
void Check(const ProjectOptions& options, const CLI::App* command)
{
  if (tool::Extension(options.Output) != ".exr")
  {
    throw tool::UsageError(options.Output + ": OUT must end in .exr");
  }
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
  if (options.Basis.empty() || options.Order == 0)
  {
    throw tool::UsageError(
      options.File + " is not in a basis yet: --basis and --order are required");
  }
  const bool zonal = tool::FindBasis(options.Basis) >= vtkBasisBRDF::ZONAL;
  if (options.Extrapolate && !zonal)
  {
    throw tool::UsageError("--extrapolate: --basis " + options.Basis +
                           " covers the hemisphere; expected zonal or legendre-fourier");
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBasisBRDF> Project(
  const ProjectOptions& options, const tool::Material& material, const double zone[2])
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(material.BRDF);
  projector->SetBasis(tool::FindBasis(options.Basis));
  projector->SetOrder(options.Order);
  if (projector->GetBasis() >= vtkBasisBRDF::ZONAL)
  {
    projector->SetIncidentZone(zone[0], zone[1]);
    projector->SetOutgoingZone(zone[0], zone[1]);
  }
  if (!tool::RunWithProgress(projector.Get(), &vtkBasisProjector::Project, "projecting"))
  {
    throw tool::Error(options.File + ": " + tool::TakeErrorText());
  }
  return projector->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBasisBRDF> Extrapolate(
  const ProjectOptions& options, vtkBasisBRDF* input, std::string& text)
{
  laboratory::ExtrapolationOptions settings = options.Harmonics;
  settings.Order = options.Order;
  const laboratory::Extrapolation whole =
    laboratory::Extrapolate(input, settings, tool::ShowProgress("extrapolating"));
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
void Run(const ProjectOptions& options, const CLI::App* command)
{
  Check(options, command);
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
    output = Project(options, material, zone);
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
    text += tool::FormatShare("relative L2 error from " + tool::FormatNumber(zone[0]) + " to " +
                                tool::FormatNumber(zone[1]) + " degrees",
      tool::GetZoneError(material.BRDF, output, zone));
    text += tool::FormatShare("relative L2 error over the hemisphere",
      vtkBRDFResampler::GetRelativeL2Error(material.BRDF, output));
  }
  text += tool::FormatShare("negative mass before the clamp", tool::GetNegativeMass(output));
  tool::PrintOut(text + tool::DescribeForm(output) + "\n");
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddProjectCommand(CLI::App& app)
{
  auto options = std::make_shared<ProjectOptions>();
  CLI::App* command = app.add_subcommand(
    "project", "Project a material onto a basis, or extrapolate a basis beyond its zone");
  command->add_option("FILE", options->File, GetMaterialHelp())->required();
  command
    ->add_option("--basis", options->Basis,
      "spherical-harmonics or hemispherical (both of light from 0 to 90 degrees), zonal or "
      "legendre-fourier (of a zone)")
    ->check(CLI::IsMember(std::vector<std::string>(std::begin(BasisNames), std::end(BasisNames))));
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
  command->add_option("-o,--output", options->Output, "File to write, ending in .exr")->required();
  command->footer(
    "An extrapolation whose residual inside the zone is too large is refused with exit status 1:\n"
    "use 'fit' for such materials.\n\n"
    "Examples:\n"
    "  measured-brdf-lab project blue-fabric --basis legendre-fourier --order 6 -o blue.exr\n"
    "  measured-brdf-lab project stack.exr --extrapolate -o whole.exr");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
