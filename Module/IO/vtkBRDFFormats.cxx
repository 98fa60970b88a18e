// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFFormats.h"

#include "FitFile.h"
#include "MbsdfFile.h"
#include "MerlFile.h"
#include "TensorFile.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkObjectFactory.h"

#if MEASUREDBRDF_WITH_OPENEXR
#include "ExrMaterialFile.h"
#endif

#include <algorithm>
#include <functional>
#include <mutex>

vtkStandardNewMacro(vtkBRDFFormats);

namespace
{
using namespace measuredbrdf;
using Formats = std::vector<vtkSmartPointer<vtkBRDFFormat>>;

// The module's own, in the order in which they are asked: those that any bytes might be come last.
template <class... Types>
Formats MakeFormats()
{
  return { vtkSmartPointer<Types>::New()... };
}

Formats MakeOwnFormats()
{
#if MEASUREDBRDF_WITH_OPENEXR
  return MakeFormats<TensorFormat, MbsdfFormat, ExrFormat, FitFormat, MerlFormat>();
#else
  return MakeFormats<TensorFormat, MbsdfFormat, FitFormat, MerlFormat>();
#endif
}

// Never destroyed: programs may read files until their very end.
struct Registry
{
  std::mutex Mutex;
  Formats Added; // the last one foremost
  const Formats Own = MakeOwnFormats();

  static Registry& Get()
  {
    static Registry* registry = new Registry;
    return *registry;
  }
};

std::string List(bool writable, const std::function<std::vector<std::string>(vtkBRDFFormat*)>& get)
{
  std::vector<std::string> texts;
  for (const auto& format : vtkBRDFFormats::GetFormats())
  {
    if (!writable || format->CanWrite())
    {
      for (const std::string& text : get(format))
      {
        texts.push_back(text);
      }
    }
  }
  std::string line;
  for (std::size_t k = 0; k < texts.size(); ++k)
  {
    line += (k == 0 ? "" : k + 1 < texts.size() ? ", " : " or ") + texts[k];
  }
  return line;
}
}

//------------------------------------------------------------------------------
bool vtkBRDFFormats::Register(vtkBRDFFormat* format)
{
  if (!format)
  {
    vtkGenericWarningMacro("vtkBRDFFormats::Register: there is no format.");
    return false;
  }
  for (const auto& known : GetFormats())
  {
    if (known == format || known->GetName() == format->GetName())
    {
      vtkGenericWarningMacro("vtkBRDFFormats::Register: a format is called '"
                             << format->GetName() << "' already; expected another name.");
      return false;
    }
  }
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  registry.Added.insert(registry.Added.begin(), format);
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDFFormats::Unregister(vtkBRDFFormat* format)
{
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  const auto found = std::find(registry.Added.begin(), registry.Added.end(), format);
  if (found == registry.Added.end())
  {
    return false;
  }
  registry.Added.erase(found);
  return true;
}

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkBRDFFormat>> vtkBRDFFormats::GetFormats()
{
  Registry& registry = Registry::Get();
  const std::lock_guard<std::mutex> lock(registry.Mutex);
  Formats all = registry.Added;
  all.insert(all.end(), registry.Own.begin(), registry.Own.end());
  return all;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDFFormat> vtkBRDFFormats::FindForReading(const vtkBRDFFormat::File& file)
{
  for (const auto& format : GetFormats())
  {
    if (format->CanRead(file))
    {
      return format;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDFFormat> vtkBRDFFormats::FindForWriting(const std::string& extension)
{
  for (const auto& format : GetFormats())
  {
    const std::vector<std::string> extensions = format->GetExtensions();
    if (format->CanWrite() &&
        std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
    {
      return format;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
std::string vtkBRDFFormats::GetNames(bool writable)
{
  return List(
    writable, [](vtkBRDFFormat* format) { return std::vector<std::string>{ format->GetName() }; });
}

//------------------------------------------------------------------------------
std::string vtkBRDFFormats::GetDescriptions(bool writable)
{
  return List(writable,
    [](vtkBRDFFormat* format) { return std::vector<std::string>{ format->GetDescription() }; });
}

//------------------------------------------------------------------------------
std::string vtkBRDFFormats::GetExtensions(bool writable)
{
  return List(writable, [](vtkBRDFFormat* format) { return format->GetExtensions(); });
}

//------------------------------------------------------------------------------
void vtkBRDFFormats::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Formats: " << GetNames() << "\n";
}
