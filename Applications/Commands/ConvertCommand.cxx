// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "JsonReport.h"
#include "Tool.h"

#include "vtkBRDFFormats.h"
#include "vtkBRDFReader.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

namespace
{
struct ConvertOptions
{
  std::string Input;
  std::string Output;
  bool HalfFloats = false;
};

// Direction pairs that the printed errors are measured with.
constexpr int NumberOfPairs = 1 << 17;

//------------------------------------------------------------------------------
void Run(const ConvertOptions& options)
{
  const auto format = vtkBRDFFormats::FindForWriting(tool::Extension(options.Output));
  if (!format)
  {
    throw tool::UsageError(
      options.Output + ": OUT must end in " + vtkBRDFFormats::GetExtensions(true));
  }
  const tool::Material material = tool::LoadMaterial(options.Input);
  material.BRDF->Prepare();
  std::string problem;
  const vtkSmartPointer<vtkBRDF> output = format->Convert(material.BRDF, problem);
  if (!output)
  {
    throw tool::Error(material.Name + ": " + problem);
  }
  tool::WriteMaterial(output, options.Output, options.HalfFloats);

  std::error_code ignored;
  if (!std::filesystem::is_regular_file(options.Output, ignored))
  {
    tool::PrintNote(options.Output + ": written; what goes into a pipe cannot be read back, so its "
                                     "error is not known");
    return;
  }
  // The error of what is in the file, not of what should be.
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(options.Output);
  if (!reader->Read())
  {
    throw tool::Error("reading back what was written: " + reader->GetErrorMessage());
  }
  reader->GetBRDF()->Prepare();
  double maximum = 0.0;
  const double relative =
    vtkBRDFResampler::GetRelativeL2Error(material.BRDF, reader->GetBRDF(), NumberOfPairs, &maximum);

  if (material.Transmission)
  {
    tool::PrintNote(
      options.Input + ": its transmission is left out; what is written is reflection");
  }
  nlohmann::ordered_json report = { { "input", options.Input + " (" + material.Format + ")" },
    { "output", options.Output + " (" + reader->GetFormatName() + ")" },
    { "relative_l2_error", relative }, { "largest_absolute_error", maximum } };
  if (output->IsReciprocal() && !material.BRDF->IsReciprocal())
  {
    report["note"] = "what was written is reciprocal, f(i,o) = f(o,i), and this material is not: "
                     "the mean of both is kept, its asymmetry is lost (the errors above include "
                     "that)";
  }
  tool::PrintReport(report, false);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddConvertCommand(CLI::App& app)
{
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = app.add_subcommand(
    "convert", "Write a material in another format and print the error of the conversion");
  command->add_option("IN", options->Input, GetMaterialHelp())->required();
  command
    ->add_option("OUT", options->Output,
      "File to write: .exr keeps everything bit by bit (this project's own format); .binary is a "
      "MERL table of 90 x 90 x 180 that other programs read, isotropic and reciprocal")
    ->required();
  command->add_flag("--half", options->HalfFloats,
    "Write the tables of .exr as 16-bit floats: a third of the size");
  command->footer(
    "Prints the relative L2 error (both cosines as weights) and the largest absolute error of the\n"
    "written file against the input. A MERL table is reciprocal: a measurement that is not\n"
    "reciprocal loses its asymmetry.\n\n"
    "Example:\n  measured-brdf convert satin_purple_rgb.bsdf satin_purple.binary");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
