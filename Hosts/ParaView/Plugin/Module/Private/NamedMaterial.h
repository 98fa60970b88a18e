// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What sources whose material is named have in common.
 */

#ifndef NamedMaterial_h
#define NamedMaterial_h

#include "MaterialFiles.h"

#include "vtkObject.h"

#include <string>

namespace measuredmaterials
{
inline void AssignName(vtkObject* self, std::string& name, const char* value)
{
  const std::string text = value ? value : "";
  if (name != text)
  {
    name = text;
    self->Modified();
  }
}

/// Give the source its material. Returns whether there is one; an error event says why not.
template <typename Source>
bool SetNamedMaterial(Source* self, const std::string& name, const std::string& file)
{
  const Found<vtkBRDF> found = FindMaterial(name == "File" ? file : name, nullptr);
  if (!found.Object)
  {
    const std::string error = found.Error.empty() ? "no material was named" : found.Error;
    vtkErrorWithObjectMacro(self, << error);
    return false;
  }
  self->SetBRDF(found.Object);
  return true;
}
} // namespace measuredmaterials

#endif
