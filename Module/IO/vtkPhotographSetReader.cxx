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
#include <filesystem>

vtkStandardNewMacro(vtkPhotographSetReader);

using namespace measuredbrdf;

namespace
{
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
    const Photograph& photograph = this->Get(index);
    if (photograph.Picture || photograph.Name.empty()) // added by hand, or not there
    {
      return this->Superclass::NewPicture(index);
    }
    try
    {
      return this->ReadPicture(photograph.Name);
    }
    catch (const std::exception& e) // FileError; out of memory, say
    {
      const std::string what = e.what();
      vtkErrorMacro("NewPicture: " << (what.find(photograph.Name) != std::string::npos
                                         ? what
                                         : ToPrintable(photograph.Name + ": " + what)));
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
    const auto picture = MakeImageData(file, file.IsInteger);
    picture->Register(nullptr); // the caller's
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
  const bool done = measuredbrdf::CatchFileError(this->FileName, this->ErrorMessage,
    [&]()
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
    });
  if (!done)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  return done;
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
