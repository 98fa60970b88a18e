// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPictureReader.h"

#include "FileBytes.h"
#include "ImageFile.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

vtkStandardNewMacro(vtkPictureReader);

namespace
{
using measuredbrdf::FileError;
using measuredbrdf::ImageFile;

//------------------------------------------------------------------------------
void CheckValues(const std::string& path, const ImageFile& file)
{
  const auto bad = std::find_if(
    file.Pixels.begin(), file.Pixels.end(), [](float value) { return !std::isfinite(value); });
  if (bad != file.Pixels.end())
  {
    const auto at = static_cast<std::size_t>(bad - file.Pixels.begin());
    const auto width = static_cast<std::size_t>(file.Width);
    throw FileError(path, ": pixel (", at / 4 % width, ", ", at / 4 / width,
      ") from the top left, channel ", at % 4, ": found ", *bad, ", expected a finite value");
  }
}
}

//------------------------------------------------------------------------------
vtkPictureReader::vtkPictureReader() = default;
vtkPictureReader::~vtkPictureReader() = default;

//------------------------------------------------------------------------------
vtkImageData* vtkPictureReader::GetPicture() { return this->Picture; }

//------------------------------------------------------------------------------
bool vtkPictureReader::Read()
{
  this->ErrorMessage.clear();
  this->Notes.clear();
  const bool done = measuredbrdf::CatchFileError(this->FileName, this->ErrorMessage,
    [&]()
    {
      const ImageFile file = measuredbrdf::ReadImageFile(this->FileName, true);
      CheckValues(this->FileName, file);
      this->Notes = file.JoinNotes();
      this->Picture = measuredbrdf::MakeImageData(file, file.IsEncoded, this->KeepsGray);
    });
  if (!done)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return done;
}

//------------------------------------------------------------------------------
void vtkPictureReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << measuredbrdf::ToPrintable(this->FileName) << "\n";
  os << indent << "KeepsGray: " << (this->KeepsGray ? "On" : "Off") << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "Notes: " << this->Notes << "\n";
  os << indent << "Picture: " << this->Picture.Get() << "\n";
}
