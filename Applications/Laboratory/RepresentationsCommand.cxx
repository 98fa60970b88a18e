// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"
#include "Bases.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Methods.h"
#include "NumberText.h"
#include "Progress.h"
#include "Stability.h"
#include "Tool.h"

#include "vtkAshikhminShirleyBRDFFitter.h"
#include "vtkBRDFResampler.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisProjector.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkMath.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

namespace
{
using Environments = std::vector<vtkSmartPointer<vtkEnvironment>>;

constexpr int MapWidth = 128; // the comparison wants the same smooth light for all, soon
constexpr int NumberOfPixels = 96;
constexpr int NumberOfErrorPairs = 1 << 15;

struct RepresentationsOptions
{
  std::vector<std::string> Files;
  std::vector<std::string> Environments;
  std::vector<int> Orders = { 4, 6, 8, 12 };
  std::string Zone = "9,57";
  std::string Output;
};

/// A representation of a material, and what it costs.
struct RepresentationRow
{
  std::string Material;
  std::string Representation;
  bool Recommended = false;
  double Seconds = 0.0;
  int Functions = 0; // 0: no basis
  double NegativeMass = 0.0;
  double Zone = 0.0;
  double Hemisphere = 0.0;
  std::vector<double> Images; // error for each environment
  std::size_t Bytes = 0;
};

//------------------------------------------------------------------------------
// Of a sphere seen from +z, evenly over its disc (Vogel's spiral).
tool::stability::Pairs MakeDiscPairs()
{
  tool::stability::Pairs pairs;
  for (int k = 0; k < NumberOfPixels; ++k)
  {
    const double r = 0.99 * std::sqrt((k + 0.5) / NumberOfPixels);
    const double phi = k * vtkMath::Pi() * (3.0 - std::sqrt(5.0));
    pairs.Add({ r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - r * r) }, { 0.0, 0.0, 1.0 });
  }
  return pairs;
}

//------------------------------------------------------------------------------
// Makes the candidates of one material, measures and forgets them.
class Comparison
{
public:
  Comparison(const RepresentationsOptions& options, const tool::Material& material,
    const Environments& environments, const tool::Range& zone)
    : Settings(options)
    , Material(material)
    , Lights(environments)
    , Zone{ zone.Begin, zone.End }
  {
    for (vtkEnvironment* environment : environments)
    {
      this->References.push_back(
        tool::stability::IntegrateReference(material.BRDF, environment, this->Pairs));
    }
  }

  std::vector<RepresentationRow> Make()
  {
    constexpr int advisedOrder = 6;
    const bool basis = tool::Advise(this->Material.BRDF, advisedOrder, this->Zone).IsBasis;
    for (const int order : this->Settings.Orders)
    {
      const std::string number = " " + std::to_string(order);
      vtkSmartPointer<vtkBasisBRDF> zonal;
      for (const int kind :
        { vtkBasisBRDF::ZONAL, vtkBasisBRDF::LEGENDRE_FOURIER, vtkBasisBRDF::SPHERICAL_HARMONICS })
      {
        vtkNew<vtkBasisProjector> projector;
        projector->SetInput(this->Material.BRDF);
        projector->SetBasis(kind);
        projector->SetOrder(order);
        if (kind != vtkBasisBRDF::SPHERICAL_HARMONICS)
        {
          projector->SetIncidentZone(this->Zone[0], this->Zone[1]);
          projector->SetOutgoingZone(this->Zone[0], this->Zone[1]);
        }
        this->Add(vtkBasisBRDF::GetBasisName(kind) + number, projector.Get(),
          &vtkBasisProjector::Project,
          basis && kind == vtkBasisBRDF::SPHERICAL_HARMONICS && order == advisedOrder);
        zonal = kind == vtkBasisBRDF::ZONAL ? projector->GetOutput() : zonal.Get();
      }
      // What the extrapolation's gate refuses is taken, too: the table shows why.
      this->Add(
        "zonal" + number + ", extended", [&]() { return laboratory::Extrapolate(zonal).Output; },
        false);
    }
    vtkNew<vtkDistributionBRDFFitter> distribution;
    distribution->SetInput(this->Material.BRDF);
    this->Add("D-BRDF", distribution.Get(), &vtkBRDFFitter::Fit, !basis);
    for (int lobes = 1; MEASUREDBRDF_WITH_CERES && lobes <= 2; ++lobes)
    {
      vtkNew<vtkAshikhminShirleyBRDFFitter> fitter;
      fitter->SetInput(this->Material.BRDF);
      fitter->SetNumberOfLobes(lobes);
      this->Add(
        "Ashikhmin-Shirley " + std::to_string(lobes), fitter.Get(), &vtkBRDFFitter::Fit, false);
    }
    return this->Rows;
  }

private:
  // Throws Error where it failed; without an error it only refused.
  template <typename Maker, typename Method>
  void RunMaker(Maker* maker, Method run)
  {
    const bool done = tool::RunWithProgress(maker, run, this->Material.Name);
    const std::string said = tool::TakeErrorText();
    if (!done && !said.empty())
    {
      throw tool::Error(said);
    }
  }

  template <typename Maker, typename Method>
  void Add(const std::string& name, Maker* maker, Method run, bool recommended)
  {
    this->Add(
      name,
      [&]()
      {
        this->RunMaker(maker, run);
        return maker->GetOutput();
      },
      recommended);
  }

  void Add(const std::string& name, const std::function<vtkSmartPointer<vtkBRDF>()>& make,
    bool recommended)
  {
    RepresentationRow row;
    row.Material = this->Material.Name;
    row.Representation = name;
    row.Recommended = recommended;
    const auto begin = std::chrono::steady_clock::now();
    const vtkSmartPointer<vtkBRDF> brdf = make();
    row.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!brdf)
    {
      throw tool::Error(name + ": nothing came out");
    }
    brdf->Prepare();
    if (auto* basis = vtkBasisBRDF::SafeDownCast(brdf))
    {
      row.Functions = basis->GetNumberOfFunctions();
      row.NegativeMass = tool::GetNegativeMass(basis);
    }
    row.Zone = vtkBRDFResampler::GetZoneRelativeL2Error(
      this->Material.BRDF, brdf, this->Zone, this->Zone, NumberOfErrorPairs);
    row.Hemisphere =
      vtkBRDFResampler::GetRelativeL2Error(this->Material.BRDF, brdf, NumberOfErrorPairs);
    for (std::size_t k = 0; k < this->Lights.size(); ++k)
    {
      row.Images.push_back(tool::stability::GetRelativeL1(
        tool::stability::IntegrateReference(brdf, this->Lights[k], this->Pairs),
        this->References[k]));
    }
    vtkBRDFShaderInputs form;
    brdf->GetShaderInputs(form);
    row.Bytes = form.GetTextureBytes();
    this->Rows.push_back(row);
  }

  const RepresentationsOptions& Settings;
  const tool::Material& Material;
  const Environments& Lights;
  const double Zone[2];
  const tool::stability::Pairs Pairs = MakeDiscPairs();
  std::vector<std::vector<double>> References;
  std::vector<RepresentationRow> Rows;
};

//------------------------------------------------------------------------------
// A cell of text: quoted, quotes in it doubled (RFC 4180).
std::string QuoteCell(const std::string& text)
{
  std::string cell = "\"";
  for (const char c : text)
  {
    cell += c == '"' ? "\"\"" : std::string(1, c);
  }
  return cell + "\"";
}

//------------------------------------------------------------------------------
std::string FormatRepresentationsCSV(
  const std::vector<RepresentationRow>& rows, const std::vector<std::string>& environments)
{
  std::string text = "material,representation,functions,relative_l2_zone,relative_l2_hemisphere,"
                     "negative_mass";
  for (const std::string& name : environments)
  {
    text += "," + QuoteCell("image_" + name);
  }
  text += ",texture_bytes,seconds,recommended\n";
  for (const RepresentationRow& row : rows)
  {
    text += QuoteCell(row.Material) + "," + QuoteCell(row.Representation) + "," +
            std::to_string(row.Functions) + "," + measuredbrdf::FixedText(row.Zone, 4) + "," +
            measuredbrdf::FixedText(row.Hemisphere, 4) + "," +
            measuredbrdf::FixedText(row.NegativeMass, 5);
    for (const double image : row.Images)
    {
      text += "," + measuredbrdf::FixedText(image, 4);
    }
    text += "," + std::to_string(row.Bytes) + "," + measuredbrdf::FixedText(row.Seconds, 2) + "," +
            (row.Recommended ? "1" : "0") + "\n";
  }
  return text;
}

//------------------------------------------------------------------------------
std::string FormatRepresentations(
  const std::vector<RepresentationRow>& rows, const std::vector<std::string>& environments)
{
  std::string text =
    "                               relative L2       negative   image, relative L1\n"
    "representation              zone   hemisphere     mass  ";
  for (const std::string& name : environments)
  {
    char cell[32];
    std::snprintf(cell, sizeof(cell), " %12.12s", name.c_str());
    text += cell;
  }
  text += "     bytes  seconds\n";
  std::string material;
  for (const RepresentationRow& row : rows)
  {
    if (row.Material != material)
    {
      material = row.Material;
      text += material + "\n";
    }
    char figures[200];
    std::snprintf(figures, sizeof(figures), "%s %-24.24s %6.1f %%   %7.1f %%  %6.2f %%",
      row.Recommended ? ">" : " ", row.Representation.c_str(), 100.0 * row.Zone,
      100.0 * row.Hemisphere, 100.0 * row.NegativeMass);
    text += figures;
    for (const double image : row.Images)
    {
      std::snprintf(figures, sizeof(figures), "   %8.2f %%", 100.0 * image);
      text += figures;
    }
    std::snprintf(figures, sizeof(figures), " %9zu %8.2f\n", row.Bytes, row.Seconds);
    text += figures;
  }
  return text + "> marks what the advisor recommends\n";
}
//------------------------------------------------------------------------------
// The environments' names; a number tells those of the same name apart.
std::vector<std::string> GetNames(const Environments& environments)
{
  std::vector<std::string> names;
  for (vtkEnvironment* environment : environments)
  {
    std::string name = environment->GetName();
    for (int k = 2; std::find(names.begin(), names.end(), name) != names.end(); ++k)
    {
      name = environment->GetName() + " " + std::to_string(k);
    }
    names.push_back(name);
  }
  return names;
}

//------------------------------------------------------------------------------
// Throws Error naming the file.
std::vector<RepresentationRow> CompareMaterial(const RepresentationsOptions& options,
  const std::string& file, const Environments& environments, const tool::Range& zone)
{
  const tool::Material material = tool::LoadMaterial(file); // its errors name the file
  try
  {
    material.BRDF->Prepare();
    return Comparison(options, material, environments, zone).Make();
  }
  catch (const tool::Error& error)
  {
    throw tool::Error(file + ": " + error.what());
  }
}

//------------------------------------------------------------------------------
void Run(const RepresentationsOptions& options)
{
  const tool::Range zone = tool::ParseZone("--zone", options.Zone);
  if (!options.Output.empty())
  {
    tool::CheckWritable(options.Output);
  }
  tool::Interruptible interruptible;
  std::vector<std::string> files = options.Files;
  for (int k = 0; options.Files.empty() && k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    files.push_back(vtkEmbeddedMaterials::GetName(k));
  }
  Environments environments;
  for (const std::string& name :
    options.Environments.empty() ? std::vector<std::string>{ "sky", "hall" } : options.Environments)
  {
    environments.push_back(tool::stability::Shrink(tool::LoadEnvironment(name), MapWidth));
  }
  std::vector<RepresentationRow> rows;
  std::size_t failures = 0;
  for (std::size_t k = 0; k < files.size(); ++k)
  {
    try
    {
      const std::vector<RepresentationRow> more =
        CompareMaterial(options, files[k], environments, zone);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    catch (const tool::Error& error)
    {
      tool::Interruptible::Check();
      ++failures;
      tool::PrintNote("left out: " + std::string(error.what()));
      continue;
    }
    if (!options.Output.empty()) // what is done is kept
    {
      tool::WriteWhole(options.Output, FormatRepresentationsCSV(rows, GetNames(environments)));
    }
  }
  if (options.Output.empty() && !rows.empty())
  {
    tool::PrintOut(FormatRepresentations(rows, GetNames(environments)));
  }
  if (failures > 0)
  {
    throw tool::Error(std::to_string(failures) + " of " + std::to_string(files.size()) +
                      " materials could not be compared");
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddRepresentationsCommand(CLI::App& app)
{
  auto options = std::make_shared<RepresentationsOptions>();
  CLI::App* command = app.add_subcommand("representations",
    "Compare what a material can be turned into: bases of several orders, fits; errors, bytes");
  command->add_option("FILE", options->Files,
    std::string("Materials, each as in the other commands: ") + GetMaterialHelp() +
      ". Default: all embedded ones");
  command->add_option("--environment", options->Environments,
    std::string(EnvironmentHelp) + "; can be given again (default: sky and hall)");
  AddProjectionOption(command);
  command->add_option("--orders", options->Orders, "Orders of the bases (default 4,6,8,12)")
    ->delimiter(',')
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
  command->add_option("--zone", options->Zone,
    "Polar angles that the zonal bases cover, BEGIN,END in degrees (default 9,57)");
  command->add_option(
    "-o,--output", options->Output, "CSV file to write (default: a table for people on stdout)");
  command->footer(
    "zonal, Legendre x Fourier: over the zone, held constant beyond it; 'extended': the zonal one\n"
    "continued over the hemisphere by harmonics; spherical harmonics: over the hemisphere.\n"
    "Image errors: mean |x - r| / mean r over a sphere under the environment at 128 texels "
    "width.\n\n"
    "Example:\n  measured-brdf-lab representations satin_purple_rgb.bsdf --orders 4,8");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
