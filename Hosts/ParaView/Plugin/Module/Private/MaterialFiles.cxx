// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialFiles.h"

#include "vtkBRDFReader.h"
#include "vtkCommand.h"
#include "vtkCommunicator.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironmentReader.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPictureReader.h"
#include "vtkWeakPointer.h"

#include <vtksys/SystemTools.hxx>

#include <exception>
#include <iterator>
#include <map>

namespace measuredmaterials
{
namespace
{
//------------------------------------------------------------------------------
// The error is the caller's to report: the reader's own event is not printed.
template <typename Reader>
bool ReadQuietly(Reader* reader, const std::string& path)
{
  const unsigned long tag =
    reader->AddObserver(vtkCommand::ErrorEvent, reader, &vtkObject::Modified);
  reader->SetFileName(path);
  const bool success = reader->Read();
  reader->RemoveObserver(tag);
  return success;
}

// A file's path without the name of one of its materials.
std::string GetFile(const std::string& path)
{
  const std::size_t hash = path.rfind('#');
  return hash == std::string::npos || vtksys::SystemTools::FileExists(path) ? path
                                                                            : path.substr(0, hash);
}

//------------------------------------------------------------------------------
Found<vtkBRDF> MakeMaterial(const std::string& name)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    if (vtkEmbeddedMaterials::GetName(k) == name)
    {
      return { vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name)), "" };
    }
  }
  vtkNew<vtkBRDFReader> reader;
  const bool success = ReadQuietly(reader.Get(), name);
  return { success ? reader->GetBRDF() : nullptr, reader->GetErrorMessage() };
}

Found<vtkEnvironment> MakeEnvironment(const std::string& name)
{
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    if (vtkEmbeddedEnvironments::GetName(k) == name)
    {
      return { vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(name)),
        "" };
    }
  }
  vtkNew<vtkEnvironmentReader> reader;
  const bool success = ReadQuietly(reader.Get(), name);
  return { success ? reader->GetEnvironment() : nullptr, reader->GetErrorMessage() };
}

Found<vtkImageData> ReadWeightImage(const std::string& path)
{
  vtkNew<vtkPictureReader> reader;
  reader->KeepsGrayOn();
  const bool success = ReadQuietly(reader.Get(), path);
  return { success ? reader->GetPicture() : nullptr, reader->GetErrorMessage() };
}

//------------------------------------------------------------------------------
// Whether all processes have it, of files of one length. Built-in objects have none.
bool IsTheSameForAll(vtkMultiProcessController* controller, bool have, const std::string& file)
{
  const vtkIdType own =
    have ? static_cast<vtkIdType>(vtksys::SystemTools::FileLength(file)) : vtkIdType(-1);
  vtkIdType least = 0;
  vtkIdType most = 0;
  controller->AllReduce(&own, &least, 1, vtkCommunicator::MIN_OP);
  controller->AllReduce(&own, &most, 1, vtkCommunicator::MAX_OP);
  return have && least == most;
}

// Every process makes the same calls to the controller, whatever it finds and whatever throws: one
// that left by an exception would leave the others waiting.
template <typename Object>
Found<Object> Find(const std::string& name, vtkMultiProcessController* controller,
  Found<Object> (*make)(const std::string&))
{
  if (name.empty())
  {
    return {};
  }
  static std::map<std::string, vtkWeakPointer<Object>> shared; // those in use
  const std::string file = GetFile(name);
  const std::string key = name + "\n" + std::to_string(vtksys::SystemTools::ModifiedTime(file)) +
                          "\n" + std::to_string(vtksys::SystemTools::FileLength(file));
  Found<Object> found;
  try
  {
    found.Object = shared[key].Get();
    found = found.Object ? found : make(name);
  }
  catch (const std::exception& error)
  {
    found = { nullptr, name + ": " + error.what() };
  }
  if (controller && !IsTheSameForAll(controller, found.Object != nullptr, file))
  {
    const bool isFirst = controller->GetLocalProcessId() == 0;
    const std::string error =
      found.Error.empty() ? name + ": another process could not read the same file." : found.Error;
    found = { nullptr, isFirst ? error : "" };
  }
  shared[key] = found.Object;
  for (auto it = shared.begin(); it != shared.end();)
  {
    it = it->second ? std::next(it) : shared.erase(it);
  }
  return found;
}
}

//------------------------------------------------------------------------------
Found<vtkBRDF> FindMaterial(const std::string& name, vtkMultiProcessController* controller)
{
  return Find(name, controller, &MakeMaterial);
}

//------------------------------------------------------------------------------
Found<vtkEnvironment> FindEnvironment(
  const std::string& name, vtkMultiProcessController* controller)
{
  return Find(name, controller, &MakeEnvironment);
}

//------------------------------------------------------------------------------
Found<vtkImageData> FindWeightImage(const std::string& path, vtkMultiProcessController* controller)
{
  return Find(path, controller, &ReadWeightImage);
}
} // namespace measuredmaterials
