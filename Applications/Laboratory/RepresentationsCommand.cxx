// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Bases.h"
#include "Files.h"
#include "Inputs.h"
#include "Laboratory.h"
#include "Progress.h"
#include "RepresentationRows.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDFFitter.h"
#include "vtkBRDFResampler.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkBasisExtrapolator.h"
#include "vtkBasisProjector.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkDoubleArray.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkMath.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"
#include "vtkRepresentationAdvisor.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>

namespace
{
constexpr int MapWidth = 128; // the environments' size for the comparison
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

//------------------------------------------------------------------------------
// The environment at MapWidth: the comparison wants the same smooth-ish light for all, soon.
vtkSmartPointer<vtkEnvironment> Shrink(vtkEnvironment* environment)
{
  const int factor = std::max(environment->GetWidth() / MapWidth, 1);
  const int width = environment->GetWidth() / factor;
  const int height = std::max(environment->GetHeight() / factor, 1);
  std::vector<float> rgb;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      double sum[3] = { 0.0, 0.0, 0.0 };
      double weights = 0.0;
      for (int k = 0; k < factor * factor; ++k)
      {
        const int row = y * factor + k / factor;
        double pixel[3];
        environment->GetPixel(x * factor + k % factor, row, pixel);
        const double weight = environment->GetTexelSolidAngle(row);
        weights += weight;
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += weight * pixel[c];
        }
      }
      for (double channel : sum)
      {
        rgb.push_back(static_cast<float>(channel / weights));
      }
    }
  }
  auto small = vtkSmartPointer<vtkEnvironment>::New();
  small->SetPixels(width, height, std::move(rgb));
  small->SetName(environment->GetName());
  return small;
}

//------------------------------------------------------------------------------
// Normals of a sphere seen from +z, evenly over its disc (Vogel's spiral).
vtkSmartPointer<vtkDoubleArray> MakeNormals()
{
  auto normals = vtkSmartPointer<vtkDoubleArray>::New();
  normals->SetNumberOfComponents(3);
  for (int k = 0; k < NumberOfPixels; ++k)
  {
    const double r = 0.99 * std::sqrt((k + 0.5) / NumberOfPixels);
    const double phi = k * vtkMath::Pi() * (3.0 - std::sqrt(5.0));
    normals->InsertNextTuple3(r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - r * r));
  }
  return normals;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDoubleArray> DrawSphere(vtkBRDF* brdf, vtkEnvironment* environment)
{
  const vtkSmartPointer<vtkDoubleArray> normals = MakeNormals();
  vtkNew<vtkDoubleArray> views;
  views->SetNumberOfComponents(3);
  for (int k = 0; k < NumberOfPixels; ++k)
  {
    views->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  vtkNew<vtkAdaptiveRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  auto radiance = vtkSmartPointer<vtkDoubleArray>::New();
  if (!integrator->Integrate(normals, views, radiance))
  {
    throw tool::Error(tool::TakeErrorText());
  }
  return radiance;
}

//------------------------------------------------------------------------------
// mean |x - r| / mean r
double GetRelativeL1(vtkDoubleArray* image, vtkDoubleArray* reference)
{
  double difference = 0.0;
  double total = 0.0;
  for (vtkIdType k = 0; k < reference->GetNumberOfValues(); ++k)
  {
    difference += std::abs(image->GetValue(k) - reference->GetValue(k));
    total += reference->GetValue(k);
  }
  return total > 0.0 ? difference / total : 0.0;
}

//------------------------------------------------------------------------------
// One material's rows: every candidate is made, measured and forgotten.
class Table
{
public:
  Table(const RepresentationsOptions& options, const tool::Material& material,
    const std::vector<vtkSmartPointer<vtkEnvironment>>& environments, const tool::Range& zone)
    : Settings(options)
    , Material(material)
    , Environments(environments)
    , Zone(zone)
  {
    for (vtkEnvironment* environment : environments)
    {
      this->References.push_back(DrawSphere(material.BRDF, environment));
    }
  }

  std::vector<tool::RepresentationRow> Make(const std::function<void(double)>& progress)
  {
    this->Progress = progress;
    this->Steps = 4.0 * this->Settings.Orders.size() + (MEASUREDBRDF_WITH_CERES ? 4.0 : 2.0);
    vtkNew<vtkRepresentationAdvisor> advisor;
    advisor->SetInput(this->Material.BRDF);
    advisor->SetZone(this->Zone.Begin, this->Zone.End);
    this->RunWithProgress(advisor.Get(), &vtkRepresentationAdvisor::Update);
    this->FinishStep();
    const bool basis = advisor->GetRecommendation() == vtkRepresentationAdvisor::BASIS;
    for (const int order : this->Settings.Orders)
    {
      vtkSmartPointer<vtkBRDF> zonal;
      for (const int kind :
        { vtkBasisBRDF::ZONAL, vtkBasisBRDF::LEGENDRE_FOURIER, vtkBasisBRDF::SPHERICAL_HARMONICS })
      {
        const vtkSmartPointer<vtkBRDF> made =
          this->Add(vtkBasisBRDF::GetBasisName(kind) + " " + std::to_string(order),
            [&] { return this->Project(kind, order); });
        zonal = kind == vtkBasisBRDF::ZONAL ? made : zonal;
        this->Rows.back().Recommended =
          basis && kind == vtkBasisBRDF::SPHERICAL_HARMONICS && order == advisor->GetOrder();
      }
      this->Add(
        "zonal " + std::to_string(order) + ", extended", [&] { return this->Extend(zonal); });
    }
    vtkNew<vtkDistributionBRDFFitter> distribution;
    this->AddFit("D-BRDF", distribution);
    this->Rows.back().Recommended = !basis;
    for (int lobes = 1; MEASUREDBRDF_WITH_CERES && lobes <= 2; ++lobes)
    {
      vtkNew<vtkAshikhminShirleyBRDFFitter> ashikhmin;
      ashikhmin->SetNumberOfLobes(lobes);
      this->AddFit("Ashikhmin-Shirley " + std::to_string(lobes), ashikhmin);
    }
    return this->Rows;
  }

private:
  // A part of the current step. Throws Error where it failed.
  template <typename Maker, typename Method>
  void RunWithProgress(Maker* maker, Method run)
  {
    const bool done = tool::RunWithProgress(
      maker, run, [this](double share) { this->Progress((this->Step + share) / this->Steps); });
    const std::string said = tool::TakeErrorText();
    if (!done && !said.empty())
    {
      throw tool::Error(said);
    }
  }

  void FinishStep()
  {
    tool::Interruptible::Check();
    this->Progress(++this->Step / this->Steps);
  }

  vtkSmartPointer<vtkBRDF> Project(int basis, int order)
  {
    vtkNew<vtkBasisProjector> projector;
    projector->SetInput(this->Material.BRDF);
    projector->SetBasis(basis);
    projector->SetOrder(order);
    if (basis != vtkBasisBRDF::SPHERICAL_HARMONICS)
    {
      projector->SetIncidentZone(this->Zone.Begin, this->Zone.End);
      projector->SetOutgoingZone(this->Zone.Begin, this->Zone.End);
    }
    this->RunWithProgress(projector.Get(), &vtkBasisProjector::Project);
    return projector->GetOutput();
  }

  vtkSmartPointer<vtkBRDF> Extend(vtkBRDF* zonal)
  {
    vtkNew<vtkBasisExtrapolator> extrapolator;
    extrapolator->SetInput(vtkBasisBRDF::SafeDownCast(zonal));
    // What the gate refuses, without an error, is taken too: the table shows why.
    this->RunWithProgress(extrapolator.Get(), &vtkBasisExtrapolator::Extrapolate);
    return extrapolator->GetOutput();
  }

  void AddFit(const std::string& name, vtkBRDFFitter* fitter)
  {
    fitter->SetInput(this->Material.BRDF);
    this->Add(name,
      [&]() -> vtkSmartPointer<vtkBRDF>
      {
        this->RunWithProgress(fitter, &vtkBRDFFitter::Fit);
        return fitter->GetOutput();
      });
  }

  vtkSmartPointer<vtkBRDF> Add(
    const std::string& name, const std::function<vtkSmartPointer<vtkBRDF>()>& make)
  {
    tool::RepresentationRow row;
    row.Material = this->Material.Name;
    row.Representation = name;
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
    const double zone[2] = { this->Zone.Begin, this->Zone.End };
    row.Zone = vtkBRDFResampler::GetZoneRelativeL2Error(
      this->Material.BRDF, brdf, zone, zone, NumberOfErrorPairs);
    row.Hemisphere =
      vtkBRDFResampler::GetRelativeL2Error(this->Material.BRDF, brdf, NumberOfErrorPairs);
    for (std::size_t k = 0; k < this->Environments.size(); ++k)
    {
      tool::Interruptible::Check();
      row.Images.push_back(
        GetRelativeL1(DrawSphere(brdf, this->Environments[k]), this->References[k]));
    }
    vtkBRDFShaderInputs form;
    brdf->GetShaderInputs(form);
    row.Bytes = form.GetTextureBytes();
    this->Rows.push_back(row);
    this->FinishStep();
    return brdf;
  }

  const RepresentationsOptions& Settings;
  const tool::Material& Material;
  const std::vector<vtkSmartPointer<vtkEnvironment>>& Environments;
  tool::Range Zone;
  std::vector<vtkSmartPointer<vtkDoubleArray>> References;
  std::vector<tool::RepresentationRow> Rows;
  std::function<void(double)> Progress;
  double Step = 0.0;
  double Steps = 1.0;
};

//------------------------------------------------------------------------------
// The environments' names; a number tells those of the same name apart.
std::vector<std::string> GetNames(const std::vector<vtkSmartPointer<vtkEnvironment>>& environments)
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
// A material's rows. Throws Error naming the file.
std::vector<tool::RepresentationRow> Compare(const RepresentationsOptions& options,
  const std::string& file, const std::vector<vtkSmartPointer<vtkEnvironment>>& environments,
  const tool::Range& zone, const std::function<void(double)>& progress)
{
  const tool::Material material = tool::LoadMaterial(file); // its errors name the file
  try
  {
    material.BRDF->Prepare();
    return Table(options, material, environments, zone).Make(progress);
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
  std::vector<vtkSmartPointer<vtkEnvironment>> environments;
  for (const std::string& name :
    options.Environments.empty() ? std::vector<std::string>{ "sky", "hall" } : options.Environments)
  {
    environments.push_back(Shrink(tool::LoadEnvironment(name)));
  }
  std::vector<tool::RepresentationRow> rows;
  std::size_t failures = 0;
  for (std::size_t k = 0; k < files.size(); ++k)
  {
    try
    {
      tool::ProgressBar bar("measuring");
      const std::vector<tool::RepresentationRow> more = Compare(options, files[k], environments,
        zone, [&](double share) { bar.Update((static_cast<double>(k) + share) / files.size()); });
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
      tool::WriteWhole(options.Output, tool::FormatCSV(rows, GetNames(environments)));
    }
  }
  if (options.Output.empty() && !rows.empty())
  {
    tool::PrintOut(tool::FormatText(rows, GetNames(environments)));
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
