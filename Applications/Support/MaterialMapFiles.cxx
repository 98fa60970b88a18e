// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialMapFiles.h"

#include "BoundedJson.h"
#include "Files.h"
#include "Inputs.h"
#include "Picture.h"
#include "Tool.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPictureReader.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace
{
constexpr int MaterialsPerImage = 3; // alpha is no place for a weight: programs multiply by it
constexpr double LargestCode = 65535.0;
constexpr std::uintmax_t MostBytes = std::uintmax_t(1) << 24; // of a description

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> ReadWeights(const std::string& path)
{
  vtkNew<vtkPictureReader> reader;
  reader->SetFileName(path);
  if (!reader->Read())
  {
    tool::TakeErrorText();
    throw tool::Error(reader->GetErrorMessage());
  }
  if (!reader->GetNotes().empty())
  {
    tool::PrintNote(path + ": " + reader->GetNotes());
  }
  return reader->GetPicture();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeWeightImage(vtkMaterialMap* map, int first)
{
  vtkImageData* source = map->GetWeightImage(0);
  const int* size = source->GetDimensions();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size[0], size[1], 1);
  image->AllocateScalars(VTK_UNSIGNED_SHORT, MaterialsPerImage);
  auto* codes = static_cast<unsigned short*>(image->GetScalarPointer());
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      for (int k = first; k < first + MaterialsPerImage; ++k)
      {
        double weight = 0.0;
        if (k < map->GetNumberOfMaterials()) // the fitter's images have four components
        {
          weight = map->GetWeightImage(k / 4)->GetScalarComponentAsDouble(x, y, 0, k % 4);
        }
        *codes++ = static_cast<unsigned short>(std::lround(LargestCode * weight));
      }
    }
  }
  return image;
}
}

namespace tool
{
//------------------------------------------------------------------------------
void MakeFolder(const std::string& path)
{
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path))
  {
    throw Error(path + ": the folder can't be made" + (error ? ": " + error.message() : ""));
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkMaterialMap> MakeMaterialMap(
  const std::vector<std::string>& materials, const std::vector<std::string>& images)
{
  auto map = vtkSmartPointer<vtkMaterialMap>::New();
  map->SetModeToTextures();
  for (const std::string& file : materials)
  {
    const Material material = LoadMaterial(file);
    map->AddMaterial(material.BRDF, material.Name);
  }
  for (const std::string& file : images)
  {
    map->AddWeightImage(ReadWeights(file));
  }
  return map;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkMaterialMap> ReadMaterialMap(const std::string& path)
{
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > MostBytes)
  {
    throw Error(path + ": " + (error ? error.message() : "too large for a material map"));
  }
  std::ifstream file(path, std::ios::binary);
  std::vector<std::string> materials, images;
  const fs::path folder = fs::path(path).parent_path();
  try
  {
    const ordered_json description = measuredbrdf::ParseJson<ordered_json>(file);
    for (const ordered_json& material : description.at("materials"))
    {
      const std::string name = material.at("material").get<std::string>();
      const bool isFile = name.find_first_of("/.#") != std::string::npos;
      materials.push_back(isFile ? (folder / name).string() : name);
    }
    for (const ordered_json& image : description.at("weights"))
    {
      images.push_back((folder / image.get<std::string>()).string());
    }
  }
  catch (const std::exception& e)
  {
    throw Error(path + ": no material map: " + e.what());
  }
  return MakeMaterialMap(materials, images);
}

//------------------------------------------------------------------------------
void WriteMaterialMap(vtkMaterialMap* map, const std::string& folder, const ordered_json& materials,
  const ordered_json& facts)
{
  ordered_json description = { { "materials", materials }, { "weights", ordered_json::array() } };
  description.update(facts);
  for (int first = 0; first < map->GetNumberOfMaterials(); first += MaterialsPerImage)
  {
    const std::string name = "weights-" + std::to_string(first / MaterialsPerImage + 1) + ".png";
    WritePNG((fs::path(folder) / name).string(), MakeWeightImage(map, first));
    description["weights"].push_back(name);
  }
  WriteWhole((fs::path(folder) / "map.json").string(),
    description.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n");
}
} // namespace tool
