// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographSetReader.h"

#include "FileBytes.h"
#include "ImageFile.h"
#include "PhotographList.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPhotographSet.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

vtkStandardNewMacro(vtkPhotographSetReader);

using namespace measuredbrdf;

namespace
{
//------------------------------------------------------------------------------
// RGB, top row first -> three scalars, bottom row first.
template <typename Value>
void Fill(const ImageFile& file, float scale, Value* values)
{
  const auto width = static_cast<std::size_t>(file.Width);
  for (int y = file.Height - 1; y >= 0; --y)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      const float* texel = &file.Pixels[3 * (static_cast<std::size_t>(y) * width + x)];
      for (int c = 0; c < 3; ++c)
      {
        const float value = texel[c % file.Channels];
        *values++ = static_cast<Value>(scale > 1.0f ? std::round(scale * value) : value);
      }
    }
  }
}

//------------------------------------------------------------------------------
// Photographs in files, each read when it is asked for.
class FilePhotographSet : public vtkPhotographSet
{
public:
  static FilePhotographSet* New();
  vtkTypeMacro(FilePhotographSet, vtkPhotographSet);

  // Returns whether it was taken.
  bool AddFile(const std::string& path, const ListedPhotograph& listed)
  {
    Photograph photograph;
    std::copy_n(listed.Light, 3, photograph.Light);
    std::copy_n(listed.View, 3, photograph.View);
    photograph.Exposure = listed.Exposure;
    photograph.Name = path;
    return this->Insert(std::move(photograph)) >= 0;
  }

  vtkImageData* NewPicture(int index) override
  {
    const Photograph* photograph = this->Find(index);
    if (!photograph)
    {
      vtkErrorMacro("NewPicture: there is no photograph " << index << ".");
      return nullptr;
    }
    if (photograph->Picture) // added by hand
    {
      return this->Superclass::NewPicture(index);
    }
    try
    {
      return this->ReadPicture(photograph->Name);
    }
    catch (const std::exception& e) // FileError; out of memory, say
    {
      const std::string what = e.what();
      vtkErrorMacro("NewPicture: " << (what.find(photograph->Name) != std::string::npos
                                         ? what
                                         : ToPrintable(photograph->Name + ": " + what)));
    }
    return nullptr;
  }

private:
  vtkImageData* ReadPicture(const std::string& path)
  {
    const ImageFile file = ReadImageFile(path);
    if (file.IsInteger && !file.IsEncoded && this->Transfer == AUTOMATIC)
    {
      throw FileError(path +
                      ": the file says that its integers are linear, while 'automatic' takes "
                      "integers by sRGB's curve: set the transfer to linear or srgb");
    }
    vtkImageData* picture = vtkImageData::New();
    picture->SetDimensions(file.Width, file.Height, 1);
    const int type = !file.IsInteger ? VTK_FLOAT
                     : file.HasBytes ? VTK_UNSIGNED_CHAR
                                     : VTK_UNSIGNED_SHORT;
    picture->AllocateScalars(type, 3);
    void* values = picture->GetScalarPointer();
    if (type == VTK_FLOAT)
    {
      Fill(file, 1.0f, static_cast<float*>(values));
    }
    else if (type == VTK_UNSIGNED_CHAR)
    {
      Fill(file, 255.0f, static_cast<unsigned char*>(values));
    }
    else
    {
      Fill(file, 65535.0f, static_cast<unsigned short*>(values));
    }
    return picture;
  }
};
vtkStandardNewMacro(FilePhotographSet);

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPhotographSet> MakeSet(
  const PhotographList& list, const std::filesystem::path& folder)
{
  auto set = vtkSmartPointer<FilePhotographSet>::New();
  set->SetIrradiance(list.Irradiance);
  set->SetTransfer(list.Transfer);
  set->SetGamma(list.Gamma);
  set->SetSaturationLevel(list.SaturationLevel);
  set->SetBlackLevel(list.BlackLevel);
  set->SetLevelsForFloats(list.LevelsForFloats);
  for (const ListedPhotograph& photograph : list.Photographs)
  {
    const std::string path = (folder / photograph.File).string();
    CheckFile(path);
    if (!set->AddFile(path, photograph))
    {
      throw FileError(path + ": the photograph was refused");
    }
  }
  return set;
}
}

//------------------------------------------------------------------------------
vtkPhotographSetReader::vtkPhotographSetReader() = default;
vtkPhotographSetReader::~vtkPhotographSetReader() = default;

//------------------------------------------------------------------------------
vtkPhotographSet* vtkPhotographSetReader::GetPhotographs() { return this->Photographs; }

//------------------------------------------------------------------------------
bool vtkPhotographSetReader::Read()
{
  this->ErrorMessage.clear();
  try
  {
    std::size_t ignored = 0;
    std::error_code error;
    if (std::filesystem::is_directory(this->FileName, error))
    {
      this->Photographs = MakeSet(ListPhotographFolder(this->FileName, ignored), {});
    }
    else
    {
      if (CheckFile(this->FileName) > MostListBytes)
      {
        throw FileError(this->FileName + ": expected a list of at most " +
                        std::to_string(MostListBytes) + " bytes");
      }
      const FileBytes file(this->FileName);
      this->Photographs =
        MakeSet(ParsePhotographList(file), std::filesystem::path(this->FileName).parent_path());
    }
    this->NumberOfIgnoredFiles = static_cast<vtkIdType>(ignored);
    return true;
  }
  catch (const FileError& e)
  {
    this->ErrorMessage = e.what();
  }
  catch (const std::exception& e) // out of memory, say
  {
    this->ErrorMessage = ToPrintable(this->FileName + ": " + e.what());
  }
  vtkErrorMacro(<< this->ErrorMessage);
  return false;
}

//------------------------------------------------------------------------------
void vtkPhotographSetReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << ToPrintable(this->FileName) << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "NumberOfIgnoredFiles: " << this->NumberOfIgnoredFiles << "\n";
  os << indent << "Photographs: " << this->Photographs.Get() << "\n";
}
