// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FileKinds.h"

#include "Files.h"
#include "Meshes.h"

#include "vtkBRDFFormats.h"

#include <algorithm>

namespace
{
//------------------------------------------------------------------------------
bool Has(const std::vector<std::string>& list, const std::string& ending)
{
  return std::find(list.begin(), list.end(), ending) != list.end();
}
}

namespace explorer
{
//------------------------------------------------------------------------------
std::vector<std::string> GetMaterialExtensions()
{
  std::vector<std::string> all;
  for (const auto& format : vtkBRDFFormats::GetFormats())
  {
    for (const std::string& ending : format->GetExtensions())
    {
      if (!Has(all, ending))
      {
        all.push_back(ending);
      }
    }
  }
  return all;
}

//------------------------------------------------------------------------------
const std::vector<std::string>& GetEnvironmentExtensions()
{
  static const std::vector<std::string> endings = { ".exr", ".hdr", ".pic", ".pfm", ".tif", ".tiff",
    ".tx", ".png", ".jpg", ".jpeg" };
  return endings;
}

//------------------------------------------------------------------------------
FileKind FindFileKind(const std::string& file)
{
  const std::string ending = tool::Extension(file.substr(0, file.find('#')));
  const bool isMaterial = Has(GetMaterialExtensions(), ending);
  const bool isEnvironment = Has(GetEnvironmentExtensions(), ending);
  if (isMaterial || isEnvironment)
  {
    return !isEnvironment ? FileKind::Material
           : isMaterial   ? FileKind::MaterialOrEnvironment
                          : FileKind::Environment;
  }
  return Has(tool::GetMeshExtensions(), ending) ? FileKind::Mesh
         : ending == ".json"                    ? FileKind::State
                                                : FileKind::Material;
}
} // namespace explorer
