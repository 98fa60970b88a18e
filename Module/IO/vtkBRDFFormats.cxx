// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFFormats.h"

#include "MaterialFormat.h"
#include "Registry.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <functional>

vtkStandardNewMacro(vtkBRDFFormats);

namespace
{
using namespace measuredbrdf;
using Formats = Registry<vtkBRDFFormat>;

// The module's own, in the order in which they are asked: those that any bytes might be come last.
Formats::Items MakeOwnFormats()
{
  Formats::Items items;
  for (const MaterialFormat* format : { &TensorFormat, &MbsdfFormat, &ExrMaterialFormat,
         &BsdfXmlFormat, &OpenMaterialFormat, &AstmFormat, &FitFormat, &UtiaFormat, &MerlFormat })
  {
    items.push_back(BuiltInFormat::Make(*format));
  }
  return items;
}

Formats& GetRegistry()
{
  static auto& registry = Formats::MakeShared(MakeOwnFormats());
  return registry;
}

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
  return JoinNames(texts, [](const std::string& text) { return text; });
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
  if (!GetRegistry().Add(format, [](vtkBRDFFormat* other) { return other->GetName(); }))
  {
    vtkGenericWarningMacro("vtkBRDFFormats::Register: a format is called '"
                           << format->GetName() << "' already; expected another name.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDFFormats::Unregister(vtkBRDFFormat* format) { return GetRegistry().Remove(format); }

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkBRDFFormat>> vtkBRDFFormats::GetFormats()
{
  Formats::Items all = GetRegistry().GetAdded();
  std::reverse(all.begin(), all.end()); // the last one foremost
  const Formats::Items& own = GetRegistry().GetOwn();
  all.insert(all.end(), own.begin(), own.end());
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
