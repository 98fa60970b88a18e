// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialFiles.h"

#include "vtkBRDFFormat.h"
#include "vtkBRDFFormats.h"
#include "vtkBRDFReader.h"
#include "vtkCommand.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironmentReader.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPictureReader.h"
#include "vtkPointData.h"
#include "vtkWeakPointer.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <cstring>
#include <exception>
#include <iterator>
#include <map>
#include <new>
#include <sstream>
#include <utility>
#include <vector>

namespace measuredmaterials
{
namespace
{
constexpr vtkIdType LargestSize = 1 << 30; // bytes that one message between processes may have

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
struct Materials
{
  using Object = vtkBRDF;

  static vtkSmartPointer<vtkBRDF> FindBuiltIn(const std::string& name)
  {
    for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
    {
      if (vtkEmbeddedMaterials::GetName(k) == name)
      {
        return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
      }
    }
    return nullptr;
  }

  static Found<vtkBRDF> Read(const std::string& path)
  {
    vtkNew<vtkBRDFReader> reader;
    const bool success = ReadQuietly(reader.Get(), path);
    return { success ? reader->GetBRDF() : nullptr, reader->GetErrorMessage() };
  }

  // What the others need: the file itself.
  static std::string Pack(vtkBRDF*, const std::string& path)
  {
    vtksys::ifstream file(GetFile(path).c_str(), std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
  }

  static vtkSmartPointer<vtkBRDF> Unpack(const std::string& bytes, const std::string& path)
  {
    const std::string file = GetFile(path);
    const vtkBRDFFormat::File contents{ file,
      path.size() > file.size() ? path.substr(file.size() + 1) : "", bytes };
    vtkBRDFFormat::Content content;
    std::string error;
    const auto format = vtkBRDFFormats::FindForReading(contents);
    return format && format->Read(contents, content, error) ? content.BRDF : nullptr;
  }
};

//------------------------------------------------------------------------------
struct Environments
{
  using Object = vtkEnvironment;

  static vtkSmartPointer<vtkEnvironment> FindBuiltIn(const std::string& name)
  {
    for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
    {
      if (vtkEmbeddedEnvironments::GetName(k) == name)
      {
        return vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(name));
      }
    }
    return nullptr;
  }

  static Found<vtkEnvironment> Read(const std::string& path)
  {
    vtkNew<vtkEnvironmentReader> reader;
    const bool success = ReadQuietly(reader.Get(), path);
    return { success ? reader->GetEnvironment() : nullptr, reader->GetErrorMessage() };
  }

  // Image files may need folders and libraries that other machines do not have: pixels do not.
  static std::string Pack(vtkEnvironment* environment, const std::string&)
  {
    const int size[2] = { environment->GetWidth(), environment->GetHeight() };
    const std::vector<float>& pixels = environment->GetPixels();
    double rotation[9];
    environment->GetWorldToEnvironment(rotation);
    std::string bytes(reinterpret_cast<const char*>(size), sizeof(size));
    bytes.append(reinterpret_cast<const char*>(rotation), sizeof(rotation));
    bytes.append(reinterpret_cast<const char*>(pixels.data()), pixels.size() * sizeof(float));
    return bytes;
  }

  static vtkSmartPointer<vtkEnvironment> Unpack(const std::string& bytes, const std::string& path)
  {
    int size[2] = { 0, 0 };
    double rotation[9];
    constexpr std::size_t header = sizeof(size) + sizeof(rotation);
    std::memcpy(size, bytes.data(), sizeof(size));
    std::memcpy(rotation, bytes.data() + sizeof(size), sizeof(rotation));
    std::vector<float> pixels((bytes.size() - header) / sizeof(float));
    std::memcpy(pixels.data(), bytes.data() + header, pixels.size() * sizeof(float));
    auto environment = vtkSmartPointer<vtkEnvironment>::New();
    environment->SetWorldToEnvironment(rotation);
    environment->SetName(vtksys::SystemTools::GetFilenameWithoutExtension(path));
    return environment->SetPixels(size[0], size[1], std::move(pixels)) ? environment : nullptr;
  }
};

//------------------------------------------------------------------------------
struct WeightImages
{
  using Object = vtkImageData;

  static vtkSmartPointer<vtkImageData> FindBuiltIn(const std::string&) { return nullptr; }

  static Found<vtkImageData> Read(const std::string& path)
  {
    vtkNew<vtkPictureReader> reader;
    reader->KeepsGrayOn();
    const bool success = ReadQuietly(reader.Get(), path);
    return { success ? reader->GetPicture() : nullptr, reader->GetErrorMessage() };
  }

  static std::string Pack(vtkImageData* image, const std::string&)
  {
    const int* size = image->GetDimensions();
    vtkDataArray* weights = image->GetPointData()->GetScalars();
    const int header[4] = { size[0], size[1], weights->GetDataType(),
      weights->GetNumberOfComponents() };
    std::string bytes(reinterpret_cast<const char*>(header), sizeof(header));
    bytes.append(static_cast<const char*>(weights->GetVoidPointer(0)), GetBytes(weights));
    return bytes;
  }

  static vtkSmartPointer<vtkImageData> Unpack(const std::string& bytes, const std::string&)
  {
    int header[4] = { 0, 0, 0, 0 };
    std::memcpy(header, bytes.data(), sizeof(header));
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(header[0], header[1], 1);
    image->AllocateScalars(header[2], header[3]);
    vtkDataArray* weights = image->GetPointData()->GetScalars();
    std::memcpy(weights->GetVoidPointer(0), bytes.data() + sizeof(header), GetBytes(weights));
    return image;
  }

private:
  static std::size_t GetBytes(vtkDataArray* array)
  {
    return static_cast<std::size_t>(array->GetNumberOfValues()) *
           static_cast<std::size_t>(array->GetDataTypeSize());
  }
};

//------------------------------------------------------------------------------
std::string GetKey(const std::string& name)
{
  const std::string file = GetFile(name);
  return name + "\n" + std::to_string(vtksys::SystemTools::ModifiedTime(file)) + "\n" +
         std::to_string(vtksys::SystemTools::FileLength(file));
}

// Objects in use, by key.
template <typename Object>
std::map<std::string, vtkWeakPointer<Object>>& GetShared()
{
  static std::map<std::string, vtkWeakPointer<Object>> shared;
  return shared;
}

template <typename Object>
vtkSmartPointer<Object> FindShared(const std::string& key)
{
  const auto it = GetShared<Object>().find(key);
  return it != GetShared<Object>().end() ? it->second.Get() : nullptr;
}

template <typename Object>
void Share(const std::string& key, const vtkSmartPointer<Object>& object)
{
  auto& shared = GetShared<Object>();
  for (auto it = shared.begin(); it != shared.end();)
  {
    it = it->second ? std::next(it) : shared.erase(it);
  }
  if (object)
  {
    shared[key] = object;
  }
}

//------------------------------------------------------------------------------
// Whether all processes say so.
bool IsTrueForAll(vtkMultiProcessController* controller, bool own)
{
  int have = own ? 1 : 0;
  int allHave = 0;
  controller->AllReduce(&have, &allHave, 1, vtkCommunicator::MIN_OP);
  return allHave != 0;
}

// What an exception says; "" where there is none. A process that left by one would leave the others
// waiting for its next call to the controller.
template <typename Work>
std::string Try(const Work& work)
{
  try
  {
    work();
    return "";
  }
  catch (const std::bad_alloc&)
  {
    return "out of memory";
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
}

//------------------------------------------------------------------------------
// Nothing, where a process lacks the memory.
void Broadcast(vtkMultiProcessController* controller, std::string& bytes)
{
  vtkIdType size = static_cast<vtkIdType>(bytes.size());
  controller->Broadcast(&size, 1, 0);
  const std::string error = Try([&]() { bytes.resize(static_cast<std::size_t>(size)); });
  if (!IsTrueForAll(controller, error.empty()))
  {
    bytes.clear();
  }
  else if (size > 0)
  {
    controller->Broadcast(&bytes[0], size, 0);
  }
}

// Every process makes the same calls to the controller, whatever it finds and whatever throws.
template <typename Kind>
Found<typename Kind::Object> FindTogether(
  const std::string& name, vtkMultiProcessController* controller)
{
  const bool first = controller->GetLocalProcessId() == 0;
  std::string key = first ? GetKey(name) : "";
  Broadcast(controller, key);
  const auto shared = FindShared<typename Kind::Object>(key);
  if (IsTrueForAll(controller, shared != nullptr))
  {
    return { shared, "" };
  }

  Found<typename Kind::Object> found;
  std::string bytes;
  const auto read = [&]()
  {
    found = Kind::Read(name);
    bytes = found.Object ? Kind::Pack(found.Object, name) : "";
    if (static_cast<vtkIdType>(bytes.size()) > LargestSize)
    {
      found = { nullptr, name + ": more than 1 GiB cannot be sent to the other processes." };
      bytes.clear();
    }
  };
  std::string thrown = first ? Try(read) : "";
  if (!thrown.empty())
  {
    bytes.clear();
  }
  Broadcast(controller, bytes);
  if (!first && !bytes.empty())
  {
    Try([&]() { found.Object = Kind::Unpack(bytes, name); });
  }
  if (!IsTrueForAll(controller, found.Object && thrown.empty()))
  {
    const bool failed = first && thrown.empty() && found.Error.empty();
    return { nullptr, failed ? name + ": another process could not read it."
                             : (thrown.empty() ? found.Error : name + ": " + thrown) };
  }
  Share(key, found.Object);
  return found;
}

template <typename Kind>
Found<typename Kind::Object> Find(const std::string& name, vtkMultiProcessController* controller)
{
  if (name.empty())
  {
    return {};
  }
  using Object = typename Kind::Object;
  // Built-in objects are the same everywhere.
  vtkSmartPointer<Object> builtIn = FindShared<Object>(name);
  if (!builtIn)
  {
    builtIn = Kind::FindBuiltIn(name);
    Share(name, builtIn);
  }
  if (builtIn)
  {
    return { builtIn, "" };
  }
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    return FindTogether<Kind>(name, controller);
  }
  const std::string key = GetKey(name);
  if (const auto shared = FindShared<Object>(key))
  {
    return { shared, "" };
  }
  Found<Object> found = Kind::Read(name);
  Share(key, found.Object);
  return found;
}
}

//------------------------------------------------------------------------------
Found<vtkBRDF> FindMaterial(const std::string& name, vtkMultiProcessController* controller)
{
  return Find<Materials>(name, controller);
}

//------------------------------------------------------------------------------
Found<vtkEnvironment> FindEnvironment(
  const std::string& name, vtkMultiProcessController* controller)
{
  return Find<Environments>(name, controller);
}

//------------------------------------------------------------------------------
Found<vtkImageData> FindWeightImage(const std::string& path, vtkMultiProcessController* controller)
{
  return Find<WeightImages>(path, controller);
}
} // namespace measuredmaterials
