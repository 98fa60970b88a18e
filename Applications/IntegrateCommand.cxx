// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Thesis.h"
#include "Tool.h"
#include "Watch.h"

#include "vtkDoubleArray.h"
#include "vtkExactIntegrator.h"
#include "vtkLightSetIntegrator.h"
#include "vtkNew.h"

#include <memory>

namespace
{
struct Options
{
  std::string File;
  std::string Environment;
  std::string Pairs;
  std::string Method = "exact";
  std::string Output;
  tool::LightSetOptions Lights;
  tool::ThesisOptions Thesis;
};

//------------------------------------------------------------------------------
vtkSmartPointer<vtkRadianceIntegrator> MakeIntegrator(
  const Options& options, vtkEnvironment* environment)
{
  if (options.Method == "exact")
  {
    return vtkSmartPointer<vtkExactIntegrator>::New();
  }
  auto integrator = vtkSmartPointer<vtkLightSetIntegrator>::New();
  integrator->SetLightSet(tool::MakeLightSet(environment, options.Lights));
  integrator->SetSoftLights(options.Lights.Soft);
  return integrator;
}

//------------------------------------------------------------------------------
void Run(const Options& options, const CLI::App* command)
{
  options.Thesis.Check(command, options.Method);
  static const tool::PairColumns columns = { "nx", "ny", "nz", "vx", "vy", "vz" };
  if (options.Method != "exact")
  {
    options.Lights.Check();
  }
  tool::Interruptible interruptible;
  const std::vector<tool::Pair> pairs = tool::ReadPairs(options.Pairs, columns);
  tool::Material material = tool::LoadMaterial(options.File);
  if (options.Method == "thesis")
  {
    material.BRDF = tool::RepresentAsThesis(material, options.Thesis).BRDF;
  }
  const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(options.Environment);

  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> views;
  vtkNew<vtkDoubleArray> radiance;
  for (vtkDoubleArray* array : { normals.Get(), views.Get(), radiance.Get() })
  {
    array->SetNumberOfComponents(3);
  }
  for (const tool::Pair& pair : pairs)
  {
    normals->InsertNextTuple(pair.data());
    views->InsertNextTuple(pair.data() + 3);
  }

  const vtkSmartPointer<vtkRadianceIntegrator> integrator = MakeIntegrator(options, environment);
  integrator->SetBRDF(material.BRDF);
  integrator->SetEnvironment(environment);
  const bool done = tool::Watch(
    integrator.Get(),
    [&](vtkRadianceIntegrator* made) { return made->Integrate(normals, views, radiance); },
    "integrating");
  if (!done)
  {
    throw tool::Error("integrate: " + tool::TakeErrorText());
  }
  std::vector<double> rgb(3 * pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    radiance->GetTuple(static_cast<vtkIdType>(k), rgb.data() + 3 * k);
  }
  tool::WriteResults(options.Output, columns, pairs, rgb);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddIntegrateCommand(CLI::App& app)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
    "integrate", "Compute the light a material sends to the viewer under an environment");
  command->add_option("FILE", options->File, MaterialHelp)->required();
  command->add_option("--environment", options->Environment, EnvironmentHelp)->required();
  AddProjectionOption(command);
  command
    ->add_option("--pairs", options->Pairs,
      "CSV file with the columns nx,ny,nz (surface normal) and vx,vy,vz (from the surface to the "
      "viewer) in world coordinates, y up. Other columns and lines that start with # are ignored")
    ->required();
  command
    ->add_option("--method", options->Method,
      "exact: the sum over every texel of the environment (default); light-set: over a set of "
      "lights, as the renderer does it; thesis: the same with the material in a basis or, where "
      "that "
      "rings, as a D-BRDF fit")
    ->check(CLI::IsMember({ "exact", "light-set", "thesis" }));
  options->Lights.AddTo(command, "--lights");
  options->Lights.AddSoftTo(command);
  options->Thesis.AddTo(command);
  command->add_option("-o,--output", options->Output,
    "CSV file to write: the six columns and r,g,b of the outgoing radiance, linear Rec. 709 "
    "(default: standard output)");
  command->footer("Example:\n  measured-brdf integrate gold-paint --environment sky --pairs nv.csv "
                  "--method exact");
  command->callback([options, command]() { Run(*options, command); });
}
} // namespace tool
