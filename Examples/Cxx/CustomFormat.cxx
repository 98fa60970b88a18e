// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A file format of your own: one class, registered once. From then on vtkBRDFReader and
// vtkBRDFWriter know it.
//
//   CustomFormat [FILE.diffuse]      writes the file, reads it back and prints what it holds
//
// The format is a line of text: "diffuse RED GREEN BLUE".

#include <vtkBRDFFormat.h>
#include <vtkBRDFFormats.h>
#include <vtkBRDFReader.h>
#include <vtkBRDFWriter.h>
#include <vtkLambertBRDF.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

class DiffuseFormat : public vtkBRDFFormat
{
public:
  static DiffuseFormat* New();
  vtkTypeMacro(DiffuseFormat, vtkBRDFFormat);

  std::string GetName() override { return "diffuse text"; }
  std::string GetDescription() override { return "the example's .diffuse"; }
  std::vector<std::string> GetExtensions() override { return { ".diffuse" }; }

  bool CanRead(const File& file) override { return file.Bytes.substr(0, 8) == "diffuse "; }

  bool Read(const File& file, Content& content, std::string& error) override
  {
    std::istringstream text(std::string(file.Bytes.substr(8)));
    double albedo[3];
    for (double& value : albedo)
    {
      if (!(text >> value) || !std::isfinite(value) || value < 0.0)
      {
        error = file.Path + ": diffuse text: expected three numbers of 0 or more";
        return false;
      }
    }
    vtkNew<vtkLambertBRDF> brdf;
    brdf->SetAlbedo(albedo);
    content.BRDF = brdf;
    return true;
  }

  bool CanWrite() override { return true; }

  bool Write(vtkBRDF* brdf, const std::string& path, bool, std::string& error) override
  {
    auto* lambert = vtkLambertBRDF::SafeDownCast(brdf);
    if (!lambert)
    {
      error = path + ": diffuse text holds a vtkLambertBRDF only";
      return false;
    }
    const double* albedo = lambert->GetAlbedo();
    std::ofstream file(path);
    file << "diffuse " << albedo[0] << " " << albedo[1] << " " << albedo[2] << "\n";
    if (!file.flush())
    {
      error = path + ": cannot be written";
    }
    return error.empty();
  }
};
vtkStandardNewMacro(DiffuseFormat);

int main(int argc, char* argv[])
{
  const std::string path = argc > 1 ? argv[1] : "paper.diffuse";

  vtkNew<DiffuseFormat> format;
  vtkBRDFFormats::Register(format);

  vtkNew<vtkLambertBRDF> paper;
  paper->SetAlbedo(0.75, 0.5, 0.25);
  vtkNew<vtkBRDFWriter> writer;
  writer->SetFileName(path);
  writer->SetBRDF(paper);
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(path);
  if (!writer->Write() || !reader->Read())
  {
    return EXIT_FAILURE; // writer and reader have said why
  }
  auto* read = vtkLambertBRDF::SafeDownCast(reader->GetBRDF());
  if (!read || read->GetAlbedo()[1] != 0.5)
  {
    std::cerr << path << ": what was read is not what was written\n";
    return EXIT_FAILURE;
  }
  std::cout << path << " is " << reader->GetFormatName()
            << "; formats that are known: " << vtkBRDFFormats::GetDescriptions() << "\n";
  return EXIT_SUCCESS;
}
