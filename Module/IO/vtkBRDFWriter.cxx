// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFWriter.h"

#include "FileBytes.h"
#include "vtkBRDFFormats.h"
#include "vtkObjectFactory.h"

#include <vtksys/SystemTools.hxx>

vtkStandardNewMacro(vtkBRDFWriter);

//------------------------------------------------------------------------------
void vtkBRDFWriter::SetBRDF(vtkBRDF* brdf)
{
  if (this->BRDF != brdf)
  {
    this->BRDF = brdf;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
bool vtkBRDFWriter::Write()
{
  using namespace measuredbrdf;
  this->ErrorMessage.clear();
  const bool done = measuredbrdf::CatchFileError(this->FileName, this->ErrorMessage,
    [&]()
    {
      Require(!this->FileName.empty(), "no file name was given");
      Require(this->BRDF != nullptr, this->FileName, ": there is no material to write");
      const std::string extension = vtksys::SystemTools::LowerCase(
        vtksys::SystemTools::GetFilenameLastExtension(this->FileName));
      const auto format = vtkBRDFFormats::FindForWriting(extension);
      Require(format != nullptr, this->FileName, ": found extension ", Quote(extension),
        ", expected ", vtkBRDFFormats::GetExtensions(true));
      std::string error;
      const bool isWritten = format->Write(this->BRDF, this->FileName, this->HalfFloats, error);
      Require(isWritten, error);
    });
  if (!done)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return done;
}

//------------------------------------------------------------------------------
void vtkBRDFWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << measuredbrdf::ToPrintable(this->FileName) << "\n";
  os << indent << "HalfFloats: " << (this->HalfFloats ? "On" : "Off") << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
}
