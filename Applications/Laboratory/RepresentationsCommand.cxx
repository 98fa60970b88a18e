// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Methods.h"
#include "NumberText.h"
#include "Progress.h"
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
// Makes what a material can be turned into, one after the other: a row of the table for each.
struct Comparison
{
  explicit Comparison(const RepresentationsOptions& options)
    : Orders(options.Orders)
    , Range(tool::ParseZone("--zone", options.Zone))
  {
    std::vector<std::string> names;
    for (const std::string& file : options.Environments)
    {
      const auto environment = tool::LoadEnvironment(file);
      const auto before = std::count(names.begin(), names.end(), environment->GetName());
      names.push_back(environment->GetName());
      this->Header += "," + tool::QuoteCell("image_" + names.back() +
                                            (before > 0 ? " " + std::to_string(before + 1) : ""));
      this->Lights.push_back(laboratory::Shrink(environment, MapWidth));
    }
    this->Header += ",texture_bytes,seconds,recommended\n";
  }

  std::string MakeRows(const tool::Material& material) const
  {
    const double zone[2] = { this->Range.Begin, this->Range.End };
    material.BRDF->Prepare();
    std::vector<laboratory::Radiance> references;
    for (vtkEnvironment* light : this->Lights)
    {
      references.push_back(laboratory::IntegrateReference(material.BRDF, light, this->Pairs));
    }
    std::string text;
    const auto addFigure = [&text](double value, int digits = 4)
    { text += "," + measuredbrdf::FixedText(value, digits); };
    const auto add = [&](const std::string& name, bool recommended,
                       const std::function<vtkSmartPointer<vtkBRDF>()>& make)
    {
      const auto begin = std::chrono::steady_clock::now();
      const vtkSmartPointer<vtkBRDF> brdf = make();
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      brdf->Prepare();
      auto* basis = vtkBasisBRDF::SafeDownCast(brdf);
      text += tool::QuoteCell(material.Name) + "," + tool::QuoteCell(name) + "," +
              std::to_string(basis ? basis->GetNumberOfFunctions() : 0);
      addFigure(vtkBRDFResampler::GetZoneRelativeL2Error(
        material.BRDF, brdf, zone, zone, NumberOfErrorPairs));
      addFigure(vtkBRDFResampler::GetRelativeL2Error(material.BRDF, brdf, NumberOfErrorPairs));
      addFigure(
        basis ? basis->GetNegativeMass(laboratory::AllAngles, laboratory::AllAngles) : 0.0, 5);
      for (std::size_t k = 0; k < this->Lights.size(); ++k)
      {
        addFigure(laboratory::GetRelativeL1(
          laboratory::IntegrateReference(brdf, this->Lights[k], this->Pairs), references[k]));
      }
      vtkBRDFShaderInputs inputs;
      brdf->GetShaderInputs(inputs);
      text += "," + std::to_string(inputs.GetTextureBytes());
      addFigure(taken.count(), 2);
      text += recommended ? ",1\n" : ",0\n";
    };

    constexpr int advisedOrder = 6;
    const bool isBasis = tool::Advise(material.BRDF, advisedOrder, zone).IsBasis;
    for (const int order : this->Orders)
    {
      const std::string number = " " + std::to_string(order);
      vtkSmartPointer<vtkBasisBRDF> zonal;
      for (const int kind :
        { vtkBasisBRDF::ZONAL, vtkBasisBRDF::LEGENDRE_FOURIER, vtkBasisBRDF::SPHERICAL_HARMONICS })
      {
        add(vtkBasisBRDF::GetBasisName(kind) + number,
          isBasis && kind == vtkBasisBRDF::SPHERICAL_HARMONICS && order == advisedOrder,
          [&]()
          {
            const auto basis =
              laboratory::ProjectOnto(material.BRDF, kind, order, zone, material.Name);
            zonal = kind == vtkBasisBRDF::ZONAL ? basis : zonal;
            return basis;
          });
      }
      // What the extrapolation's gate refuses is taken, too: the table shows why.
      add("zonal" + number + ", extended", false,
        [&]() { return laboratory::Extrapolate(zonal).Output; });
    }
    add("D-BRDF", !isBasis,
      [&]() { return laboratory::FitDistribution(material.BRDF, material.Name); });
    for (int lobes = 1; lobes <= 2; ++lobes)
    {
      add("Ashikhmin-Shirley " + std::to_string(lobes), false,
        [&]()
        {
          vtkNew<vtkLobeBRDFFitter> fitter;
          fitter->SetInput(material.BRDF);
          fitter->SetNumberOfLobes(lobes);
          if (!tool::RunWithProgress(fitter.Get(), &vtkBRDFFitter::Fit, material.Name))
          {
            throw tool::Error(tool::TakeErrorText());
          }
          return vtkSmartPointer<vtkBRDF>(fitter->GetOutput());
        });
    }
    return text;
  }

  std::vector<int> Orders;
  tool::Range Range;
  const laboratory::Pairs Pairs = laboratory::MakeSpherePairs(NumberOfSpherePairs);
  std::vector<laboratory::Environment> Lights;
  std::string Header = "material,representation,functions,relative_l2_zone,"
                       "relative_l2_hemisphere,negative_mass";
};

//------------------------------------------------------------------------------
void RunRepresentations(const RepresentationsOptions& options)
{
  tool::Interruptible interruptible;
  const Comparison comparison(options);
  tool::CheckWritable(options.Output);
  std::vector<std::string> files = options.Files;
  for (int k = 0; options.Files.empty() && k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    files.push_back(vtkEmbeddedMaterials::GetName(k));
  }
  std::string table = comparison.Header;
  std::size_t failures = 0;
  for (const std::string& file : files)
  {
    std::string where; // what loading says names the file itself
    try
    {
      const tool::Material material = tool::LoadMaterial(file);
      where = file + ": ";
      table += comparison.MakeRows(material);
    }
    catch (const tool::Error& error)
    {
      tool::Interruptible::Check();
      ++failures;
      tool::PrintNote("left out: " + where + error.what());
      continue;
    }
    if (!options.Output.empty()) // what is done is kept
    {
      tool::WriteWhole(options.Output, table);
    }
  }
  if (options.Output.empty() && failures < files.size())
  {
    tool::PrintOut(table);
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
