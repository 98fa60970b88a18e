// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFWriter.h"

#include "FileBytes.h"
#include "vtkBRDFFormats.h"
#include "vtkMeasuredBRDFConfigure.h"
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
      if (this->FileName.empty())
      {
        throw FileError("no file name was given");
      }
      if (!this->BRDF)
      {
        throw FileError(this->FileName + ": there is no material to write");
      }
      const std::string extension = vtksys::SystemTools::LowerCase(
        vtksys::SystemTools::GetFilenameLastExtension(this->FileName));
      const auto format = vtkBRDFFormats::FindForWriting(extension);
      if (!format && !MEASUREDBRDF_WITH_OPENEXR && extension == ".exr")
      {
        throw FileError(this->FileName + ": " + NoOpenEXR + ".exr materials cannot be written");
      }
      if (!format)
      {
        throw FileError(this->FileName + ": found extension " + Quote(extension) + ", expected " +
                        vtkBRDFFormats::GetExtensions(true));
      }
      std::string error;
      if (!format->Write(this->BRDF, this->FileName, this->HalfFloats, error))
      {
        throw FileError(error);
      }
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
