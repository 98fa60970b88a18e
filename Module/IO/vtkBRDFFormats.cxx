// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFFormats.h"

#include "AstmFile.h"
#include "BsdfXmlFile.h"
#include "FitFile.h"
#include "MbsdfFile.h"
#include "MerlFile.h"
#include "OpenMaterialFile.h"
#include "Registry.h"
#include "TensorFile.h"
#include "UtiaFile.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkObjectFactory.h"

#if MEASUREDBRDF_WITH_OPENEXR
#include "ExrMaterialFile.h"
#endif

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
#if MEASUREDBRDF_WITH_OPENEXR
  return Formats::Make<TensorFormat, MbsdfFormat, ExrFormat, BsdfXmlFormat, OpenMaterialFormat,
    AstmFormat, FitFormat, UtiaFormat, MerlFormat>();
#else
  return Formats::Make<TensorFormat, MbsdfFormat, BsdfXmlFormat, OpenMaterialFormat, AstmFormat,
    FitFormat, UtiaFormat, MerlFormat>();
#endif
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
