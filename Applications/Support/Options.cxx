// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "Files.h"
#include "Meshes.h"
#include "Scenes.h"
#include "Tool.h"

#include <algorithm>

namespace tool
{
//------------------------------------------------------------------------------
CLI::Validator EndsIn(const std::vector<std::string>& endings)
{
  const auto check = [endings](const std::string& path)
  {
    std::string known;
    for (const std::string& ending : endings)
    {
      known += (known.empty() ? "" : " or ") + ending;
    }
    const bool isKnown =
      std::find(endings.begin(), endings.end(), Extension(path)) != endings.end();
    return isKnown ? std::string() : path + " must end in " + known;
  };
  return CLI::Validator(check, "");
}

//------------------------------------------------------------------------------
CLI::Validator Between(double least, double largest)
{
  const auto check = [least, largest](const std::string& text)
  {
    double value = 0.0;
    const bool isNumber = CLI::detail::lexical_cast(text, value);
    return isNumber && value >= least && value <= largest
             ? std::string()
             : text + " is not between " + FormatNumber(least) + " and " + FormatNumber(largest);
  };
  return CLI::Validator(check, "");
}

//------------------------------------------------------------------------------
void AddSizeOption(CLI::App* command, Size& size, int largest, const std::string& help)
{
  const std::string usual = std::to_string(size.Width) + "x" + std::to_string(size.Height);
  command->add_option_function<std::string>(
    "--size",
    [&size, largest](const std::string& text) { size = ParseSize("--size", text, largest); },
    help + " in pixels, WIDTHxHEIGHT (default " + usual + ")");
}

//------------------------------------------------------------------------------
void AddViewOption(CLI::App* command, View& view, const std::string& help)
{
  command->add_option_function<std::string>(
    "--view", [&view](const std::string& text) { view = ParseView(text); },
    help +
      "Where to look from, AZIMUTH,ELEVATION[,ANGLE] in degrees: azimuth 0 is from +z, 90 from "
      "+x; elevation is above the horizon; ANGLE is the vertical angle of view (default "
      "30,20,30)");
}

//------------------------------------------------------------------------------
void Stage::AddTo(CLI::App* command, int largest, const std::string& meshHelp)
{
  command->add_option("--environment", this->EnvironmentFile, EnvironmentHelp)->required();
  AddProjectionOption(command);
  this->AddMeshTo(command, largest, meshHelp);
}

//------------------------------------------------------------------------------
void Stage::AddMeshTo(CLI::App* command, int largest, const std::string& meshHelp)
{
  command->add_option("--mesh", this->MeshFile,
    meshHelp +
      ": ply, stl, obj, vtp, vtk, gltf, glb or 'ball-on-foot', which is built in (default: "
      "a sphere). A mesh without normals gets smooth ones");
  AddSizeOption(command, this->Size, largest, "Picture size");
  AddViewOption(command, this->View);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Stage::LoadMesh() const
{
  return this->MeshFile.empty() ? MakeSphere() : tool::LoadMesh(this->MeshFile);
}

//------------------------------------------------------------------------------
void Stage::Place(OffscreenScene& scene, vtkPolyData* mesh) const
{
  scene.SetMesh(mesh);
  scene.SetView(this->View, ViewFill);
}
} // namespace tool
