// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Writes the files of cases.json: WriteExports CASES.json FOLDER.
#include "ExportCases.h"
#include "ExportFiles.h"

#include <iostream>

namespace
{
//------------------------------------------------------------------------------
bool Write(const std::string& path, const std::string& bytes)
{
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  return static_cast<bool>(file.flush());
}

//------------------------------------------------------------------------------
bool WriteCase(const ExportCase& made, const std::string& stem)
{
  const std::string& name = made.Name;
  if (made.Model == "gltf")
  {
    return Write(stem + ".gltf", tool::MakeGltf(made.Fit, name, false)) &&
           Write(stem + ".glb", tool::MakeGltf(made.Fit, name, true));
  }
  if (made.Model == "preview_surface")
  {
    return Write(stem + ".usda", tool::MakeUsd(made.Fit, name));
  }
  if (made.Model == "vtk_pbr")
  {
    return Write(stem + ".json", tool::MakeVtkJson(made.Fit, name)) &&
           Write(stem + ".py", tool::MakeParaViewScript(made.Fit, name));
  }
  return Write(stem + ".mtlx", tool::MakeMaterialX({ made.Fit }, name));
}
}

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::cerr << "usage: WriteExports CASES.json FOLDER\n";
    return 2;
  }
  for (const ExportCase& made : ReadExportCases(argv[1]))
  {
    if (!WriteCase(made, std::string(argv[2]) + "/" + made.Name))
    {
      std::cerr << made.Name << ": cannot be written into " << argv[2] << "\n";
      return 1;
    }
  }
  return 0;
}
