// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Methods.h"
#include "NumberText.h"
#include "Progress.h"
#include "SphereLight.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLobeBRDFFitter.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>

namespace
{
constexpr int MapWidth = 128; // the comparison wants the same smooth light for all, soon
constexpr int NumberOfSpherePairs = 96;
constexpr int NumberOfErrorPairs = 1 << 15;

struct RepresentationsOptions
{
  std::vector<std::string> Files;
  std::vector<std::string> Environments = { "sky", "hall" };
  std::vector<int> Orders = { 4, 6, 8, 12 };
  std::string Zone = "9,57";
  std::string Output;
};

//------------------------------------------------------------------------------
// Makes what a material can be turned into, one after the other, and writes a row for each.
class Comparison
{
public:
  explicit Comparison(const RepresentationsOptions& options)
    : Settings(options)
  {
    const tool::Range zone = tool::ParseZone("--zone", options.Zone);
    this->Zone[0] = zone.Begin;
    this->Zone[1] = zone.End;
    this->Text = "material,representation,functions,relative_l2_zone,relative_l2_hemisphere,"
                 "negative_mass";
    std::vector<std::string> names;
    for (const std::string& file : options.Environments)
    {
      const auto environment = tool::LoadEnvironment(file);
      std::string name = environment->GetName();
      for (int k = 2; std::find(names.begin(), names.end(), name) != names.end(); ++k)
      {
        name = environment->GetName() + " " + std::to_string(k);
      }
      names.push_back(name);
      this->Text += "," + tool::QuoteCell("image_" + name);
      this->Lights.push_back(laboratory::Shrink(environment, MapWidth));
    }
    this->Text += ",texture_bytes,seconds,recommended\n";
  }

  // Throws Error, and then adds no row.
  void Add(const std::string& file)
  {
    this->Material = tool::LoadMaterial(file);
    this->Material.BRDF->Prepare();
    this->References.clear();
    for (vtkEnvironment* light : this->Lights)
    {
      this->References.push_back(
        laboratory::IntegrateReference(this->Material.BRDF, light, this->Pairs));
    }
    const std::string before = this->Text;
    try
    {
      this->AddRows();
    }
    catch (const tool::Error& error)
    {
      this->Text = before;
      throw tool::Error(file + ": " + error.what());
    }
  }

  const std::string& GetTable() const { return this->Text; }

private:
  void AddRows()
  {
    constexpr int advisedOrder = 6;
    const bool isBasis = tool::Advise(this->Material.BRDF, advisedOrder, this->Zone).IsBasis;
    for (const int order : this->Settings.Orders)
    {
      const std::string number = " " + std::to_string(order);
      vtkSmartPointer<vtkBasisBRDF> zonal;
      for (const int kind :
        { vtkBasisBRDF::ZONAL, vtkBasisBRDF::LEGENDRE_FOURIER, vtkBasisBRDF::SPHERICAL_HARMONICS })
      {
        const auto project = [&]() -> vtkSmartPointer<vtkBRDF>
        {
          const auto basis = laboratory::ProjectOnto(
            this->Material.BRDF, kind, order, this->Zone, this->Material.Name);
          zonal = kind == vtkBasisBRDF::ZONAL ? basis : zonal;
          return basis;
        };
        this->AddRow(vtkBasisBRDF::GetBasisName(kind) + number, project,
          isBasis && kind == vtkBasisBRDF::SPHERICAL_HARMONICS && order == advisedOrder);
      }
      // What the extrapolation's gate refuses is taken, too: the table shows why.
      this->AddRow(
        "zonal" + number + ", extended", [&]() { return laboratory::Extrapolate(zonal).Output; },
        false);
    }
    const auto fit = [this]()
    { return laboratory::FitDistribution(this->Material.BRDF, this->Material.Name); };
    this->AddRow("D-BRDF", fit, !isBasis);
    for (int lobes = 1; lobes <= 2; ++lobes)
    {
      const auto fitLobes = [&]() -> vtkSmartPointer<vtkBRDF>
      {
        vtkNew<vtkLobeBRDFFitter> fitter;
        fitter->SetInput(this->Material.BRDF);
        fitter->SetNumberOfLobes(lobes);
        if (!tool::RunWithProgress(fitter.Get(), &vtkBRDFFitter::Fit, this->Material.Name))
        {
          throw tool::Error(tool::TakeErrorText());
        }
        return fitter->GetOutput();
      };
      this->AddRow("Ashikhmin-Shirley " + std::to_string(lobes), fitLobes, false);
    }
  }

  void AddRow(const std::string& name, const std::function<vtkSmartPointer<vtkBRDF>()>& make,
    bool recommended)
  {
    const auto begin = std::chrono::steady_clock::now();
    const vtkSmartPointer<vtkBRDF> brdf = make();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    brdf->Prepare();
    auto* basis = vtkBasisBRDF::SafeDownCast(brdf);
    vtkBRDF* original = this->Material.BRDF;
    this->Text += tool::QuoteCell(this->Material.Name) + "," + tool::QuoteCell(name) + "," +
                  std::to_string(basis ? basis->GetNumberOfFunctions() : 0);
    this->AddFigure(vtkBRDFResampler::GetZoneRelativeL2Error(
      original, brdf, this->Zone, this->Zone, NumberOfErrorPairs));
    this->AddFigure(vtkBRDFResampler::GetRelativeL2Error(original, brdf, NumberOfErrorPairs));
    this->AddFigure(basis ? laboratory::GetNegativeMass(basis) : 0.0, 5);
    for (std::size_t k = 0; k < this->Lights.size(); ++k)
    {
      this->AddFigure(laboratory::GetRelativeL1(
        laboratory::IntegrateReference(brdf, this->Lights[k], this->Pairs), this->References[k]));
    }
    vtkBRDFShaderInputs inputs;
    brdf->GetShaderInputs(inputs);
    this->Text += "," + std::to_string(inputs.GetTextureBytes());
    this->AddFigure(taken.count(), 2);
    this->Text += recommended ? ",1\n" : ",0\n";
  }

  void AddFigure(double value, int digits = 4)
  {
    this->Text += "," + measuredbrdf::FixedText(value, digits);
  }

  const RepresentationsOptions& Settings;
  double Zone[2];
  const laboratory::Pairs Pairs = laboratory::MakeSpherePairs(NumberOfSpherePairs);
  std::vector<laboratory::Environment> Lights;
  tool::Material Material;
  std::vector<laboratory::Radiance> References; // of the material, under each light
  std::string Text;
};

//------------------------------------------------------------------------------
void RunRepresentations(const RepresentationsOptions& options)
{
  tool::Interruptible interruptible;
  Comparison comparison(options);
  if (!options.Output.empty())
  {
    tool::CheckWritable(options.Output);
  }
  std::vector<std::string> files = options.Files;
  for (int k = 0; options.Files.empty() && k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    files.push_back(vtkEmbeddedMaterials::GetName(k));
  }
  std::size_t failures = 0;
  for (const std::string& file : files)
  {
    try
    {
      comparison.Add(file);
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
      tool::WriteWhole(options.Output, comparison.GetTable());
    }
  }
  if (options.Output.empty() && failures < files.size())
  {
    tool::PrintOut(comparison.GetTable());
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
  command->add_option("-o,--output", options->Output, "CSV file to write (default: to stdout)");
  command->footer(
    "zonal, Legendre x Fourier: over the zone, held constant beyond it; 'extended': the zonal one\n"
    "continued over the hemisphere by harmonics; spherical harmonics: over the hemisphere;\n"
    "'recommended': what the advisor recommends.\n"
    "Image errors: mean |x - r| / mean r over a sphere under the environment at 128 texels "
    "width.\n\n"
    "Example:\n  measured-brdf-lab representations satin_purple_rgb.bsdf --orders 4,8");
  command->callback([options]() { RunRepresentations(*options); });
}
} // namespace tool
