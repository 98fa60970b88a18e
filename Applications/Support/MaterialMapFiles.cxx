// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialMapFiles.h"

#include "Files.h"
#include "Picture.h"
#include "Tool.h"

#include "vtkImageData.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace
{
constexpr int MaterialsPerImage = 3; // alpha is no place for a weight: programs multiply by it
constexpr double LargestCode = 65535.0;

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
