// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPictureReader.h"

#include "FileBytes.h"
#include "ImageFile.h"
#include "NumberText.h"

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
    throw FileError(path + ": pixel (" + std::to_string(at / 4 % width) + ", " +
                    std::to_string(at / 4 / width) + ") from the top left, channel " +
                    std::to_string(at % 4) + ": found " + measuredbrdf::NumberText(*bad) +
                    ", expected a finite value");
  }
}

//------------------------------------------------------------------------------
// RGBA, top row first -> scalars of colors (1 or 3), and alpha where there is one, bottom row
// first.
template <typename Value>
void Fill(const ImageFile& file, double scale, int colors, Value* values)
{
  const auto width = static_cast<std::size_t>(file.Width);
  for (int y = file.Height - 1; y >= 0; --y)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      const float* texel = &file.Pixels[4 * (static_cast<std::size_t>(y) * width + x)];
      for (int c = 0; c < colors + (file.HasAlpha ? 1 : 0); ++c)
      {
        // Alpha follows the color's values.
        const float value = texel[c == colors ? file.Channels : c % file.Channels];
        *values++ = static_cast<Value>(scale > 1.0 ? std::lround(scale * value) : value);
      }
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakePicture(const ImageFile& file, bool keepsGray)
{
  const int colors = keepsGray && file.Channels == 1 ? 1 : 3;
  const int components = colors + (file.HasAlpha ? 1 : 0);
  auto picture = vtkSmartPointer<vtkImageData>::New();
  picture->SetDimensions(file.Width, file.Height, 1);
  if (!file.IsEncoded)
  {
    picture->AllocateScalars(VTK_FLOAT, components);
    Fill(file, 1.0, colors, static_cast<float*>(picture->GetScalarPointer()));
  }
  else if (file.HasBytes)
  {
    picture->AllocateScalars(VTK_UNSIGNED_CHAR, components);
    Fill(file, 255.0, colors, static_cast<unsigned char*>(picture->GetScalarPointer()));
  }
  else
  {
    picture->AllocateScalars(VTK_UNSIGNED_SHORT, components);
    Fill(file, 65535.0, colors, static_cast<unsigned short*>(picture->GetScalarPointer()));
  }
  return picture;
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
  try
  {
    const ImageFile file =
      measuredbrdf::ReadImageFile(this->FileName, measuredbrdf::ImageValues::ColorAndAlpha);
    CheckValues(this->FileName, file);
    for (const std::string& note : file.Notes)
    {
      this->Notes += (this->Notes.empty() ? "" : "\n") + note;
    }
    this->Picture = MakePicture(file, this->KeepsGray);
    return true;
  }
  catch (const FileError& e)
  {
    this->ErrorMessage = e.what();
  }
  catch (const std::exception& e) // out of memory, say
  {
    this->ErrorMessage = measuredbrdf::ToPrintable(this->FileName + ": " + e.what());
  }
  vtkErrorMacro(<< this->ErrorMessage);
  return false;
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
