// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"
#include "Inputs.h"
#include "Tool.h"

#include "vtkBRDFReader.h"
#include "vtkBRDFResampler.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <memory>

namespace
{
struct Options
{
  std::string Input;
  std::string Output;
  bool HalfFloats = false;
};

// Samples along phi_d, theta_d, theta_h of a MERL table (Matusik et al. 2003).
constexpr int MERLSize[3] = { 180, 90, 90 };

// Direction pairs that the printed errors are measured with.
constexpr int NumberOfPairs = 1 << 17;

//------------------------------------------------------------------------------
bool IsMERLTable(vtkBRDF* brdf)
{
  auto* table = vtkTabulatedBRDF::SafeDownCast(brdf);
  return table && table->GetParameterization() == vtkTabulatedBRDF::HALF_DIFFERENCE &&
         table->GetAzimuthRange() == vtkTabulatedBRDF::HALF_TURN &&
         std::equal(MERLSize, MERLSize + 3, table->GetDimensions());
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> ToMERLTable(const tool::Material& material)
{
  if (IsMERLTable(material.BRDF))
  {
    return material.BRDF;
  }
  if (!material.BRDF->IsIsotropic())
  {
    throw tool::Error(material.Name + ": is anisotropic, which a MERL table can't hold; convert it "
                                      "to .exr, which keeps everything");
  }
  vtkNew<vtkBRDFResampler> resampler;
  resampler->SetInput(material.BRDF);
  resampler->ReciprocalOn();
  resampler->ResampleTo(MERLSize[0], MERLSize[1], MERLSize[2]);
  vtkSmartPointer<vtkTabulatedBRDF> table = resampler->GetOutput();
  table->SetName(material.BRDF->GetName());
  table->SetSource(material.BRDF->GetSource());
  return table;
}

//------------------------------------------------------------------------------
void Run(const Options& options)
{
  const std::string extension = tool::Extension(options.Output);
  if (extension != ".exr" && extension != ".binary")
  {
    throw tool::UsageError(
      options.Output + ": OUT must end in .exr (exact copy) or .binary (MERL table)");
  }
  if (extension == ".binary" && options.HalfFloats)
  {
    throw tool::UsageError("--half: a MERL table holds 64-bit floats; OUT must end in .exr");
  }
  tool::Material material = tool::LoadMaterial(options.Input);
  material.BRDF->Prepare();
  const bool merl = extension == ".binary";
  const vtkSmartPointer<vtkBRDF> output = merl ? ToMERLTable(material) : material.BRDF;
  tool::WriteMaterial(output, options.Output, options.HalfFloats);

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

  std::string text = options.Input + " (" + material.Format + ") -> " + options.Output + " (" +
                     reader->GetFormatName() + ")\n";
  text += "relative L2 error, weighted by both cosines: " + tool::FormatNumber(relative) + "\n";
  text += "largest absolute error met: " + tool::FormatNumber(maximum) + " 1/sr\n";
  if (merl && !material.BRDF->IsReciprocal())
  {
    text += "note: a MERL table is reciprocal, f(i,o) = f(o,i), and this material is not: the mean "
            "of both is kept, its asymmetry is lost (the errors above include that)\n";
  }
  tool::PrintOut(text);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddConvertCommand(CLI::App& app)
{
  auto options = std::make_shared<Options>();
  CLI::App* command =
    app.add_subcommand("convert", "Write a material in another format and print what that costs");
  command->add_option("IN", options->Input, MaterialHelp)->required();
  command
    ->add_option("OUT", options->Output,
      "File to write: .exr keeps everything bit by bit (this project's own format); .binary is a "
      "MERL table of 90 x 90 x 180 that other programs read, isotropic and reciprocal")
    ->required();
  command->add_flag("--half", options->HalfFloats,
    "Write the tables of .exr as 16-bit floats: a third of the size");
  command->footer(
    "Prints the relative L2 error (both cosines as weights) and the largest absolute error of the\n"
    "written file against the input. A MERL table is reciprocal: a measurement that is not loses\n"
    "its asymmetry.\n\n"
    "Example:\n  measured-brdf convert satin_purple_rgb.bsdf satin_purple.binary");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
