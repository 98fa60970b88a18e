// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WeightImages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPointData.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace measuredbrdf
{
namespace
{
vtkDataArray* GetScalars(vtkImageData* image) { return image->GetPointData()->GetScalars(); }

bool IsInteger(int type) { return type != VTK_FLOAT && type != VTK_DOUBLE; }
}

WeightImages::WeightImages(vtkMaterialMap* map)
{
  this->Check(map);
  if (this->Problem.empty())
  {
    this->Measure(map);
  }
}

void WeightImages::Check(vtkMaterialMap* map)
{
  int components = 0;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    const std::string name = "weight image " + std::to_string(k);
    vtkDataArray* scalars = GetScalars(image);
    int dimensions[3];
    image->GetDimensions(dimensions);
    if (!scalars || dimensions[2] != 1 || image->GetNumberOfPoints() == 0)
    {
      this->Problem = name + " is not an image of one slice with scalars";
      return;
    }
    if (scalars->GetNumberOfComponents() > 4 ||
        scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
    {
      this->Problem = name + " has " + std::to_string(scalars->GetNumberOfComponents()) +
                      " components and " + std::to_string(scalars->GetNumberOfTuples()) +
                      " tuples, expected 1 to 4 components and " +
                      std::to_string(image->GetNumberOfPoints()) + " tuples";
      return;
    }
    components += scalars->GetNumberOfComponents();
  }
  if (components < map->GetNumberOfMaterials())
  {
    this->Problem = "its weight images have " + std::to_string(components) + " components for " +
                    std::to_string(map->GetNumberOfMaterials()) + " materials";
  }
  else if (components > map->GetNumberOfMaterials())
  {
    this->Warning = "the last " + std::to_string(components - map->GetNumberOfMaterials()) +
                    " components of the weight images belong to no material";
  }
}

std::vector<float> WeightImages::GetValues(vtkImageData* image, std::size_t& bad)
{
  vtkDataArray* scalars = GetScalars(image);
  const int components = scalars->GetNumberOfComponents();
  const double scale = IsInteger(scalars->GetDataType()) ? 1.0 / scalars->GetDataTypeMax() : 1.0;
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(scalars->GetNumberOfValues()));
  for (vtkIdType p = 0; p < scalars->GetNumberOfTuples(); ++p)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = scale * scalars->GetComponent(p, c);
      const bool good = value >= 0.0 && value <= VTK_FLOAT_MAX;
      bad += good ? 0 : 1;
      values.push_back(good ? static_cast<float>(value) : 0.0f);
    }
  }
  return values;
}

// Images of different sizes are compared texel by texel of the first: as many rows and columns of
// the others are looked at.
void WeightImages::Measure(vtkMaterialMap* map)
{
  const auto materials = static_cast<std::size_t>(map->GetNumberOfMaterials());
  this->Means.assign(materials, 0.0);
  std::size_t bad = 0;
  std::vector<std::vector<float>> values;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    values.push_back(GetValues(map->GetWeightImage(k), bad));
  }
  int first[3];
  map->GetWeightImage(0)->GetDimensions(first);
  std::vector<double> texel(materials);
  std::size_t empty = 0;
  for (int y = 0; y < first[1]; ++y)
  {
    for (int x = 0; x < first[0]; ++x)
    {
      std::size_t material = 0;
      double sum = 0.0;
      for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
      {
        vtkImageData* image = map->GetWeightImage(k);
        int size[3];
        image->GetDimensions(size);
        const auto components =
          static_cast<std::size_t>(GetScalars(image)->GetNumberOfComponents());
        const auto column =
          static_cast<std::size_t>(static_cast<vtkIdType>(x) * size[0] / first[0]);
        const auto row = static_cast<std::size_t>(static_cast<vtkIdType>(y) * size[1] / first[1]);
        const std::size_t at = (row * static_cast<std::size_t>(size[0]) + column) * components;
        for (std::size_t c = 0; c < components && material < materials; ++c, ++material)
        {
          texel[material] = values[static_cast<std::size_t>(k)][at + c];
          sum += texel[material];
        }
      }
      empty += sum > 0.0 ? 0 : 1;
      for (std::size_t k = 0; k < materials && sum > 0.0; ++k)
      {
        this->Means[k] += texel[k] / sum;
      }
    }
  }
  const double texels = static_cast<double>(first[0]) * first[1];
  this->Empty = static_cast<double>(empty) / texels;
  for (double& mean : this->Means)
  {
    mean /= texels;
  }
  if (bad > 0)
  {
    this->Warning += (this->Warning.empty() ? "" : "; ") + std::to_string(bad) +
                     " weights in images are negative, infinite or NaN and count as 0";
  }
}

std::shared_ptr<WeightTextures> WeightTextures::Find(
  vtkMaterialMap* map, vtkOpenGLRenderWindow* window)
{
  using Key = std::pair<vtkMaterialMap*, vtkOpenGLRenderWindow*>;
  static std::map<Key, std::weak_ptr<WeightTextures>> shared;
  static std::mutex mutex; // windows may be drawn by different threads
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto it = shared.begin(); it != shared.end();)
  {
    it = it->second.expired() ? shared.erase(it) : std::next(it);
  }
  std::weak_ptr<WeightTextures>& known = shared[Key(map, window)];
  std::shared_ptr<WeightTextures> found = known.lock();
  if (!found)
  {
    found = std::make_shared<WeightTextures>();
    known = found;
  }
  return found;
}

std::string WeightTextures::Update(vtkMaterialMap* map, vtkOpenGLRenderWindow* window)
{
  const bool lost = std::any_of(this->Textures.begin(), this->Textures.end(),
    [window](const vtkSmartPointer<vtkTextureObject>& texture)
    { return texture->GetHandle() == 0 || texture->GetContext() != window; });
  if (this->Window == window && this->Time >= map->GetMTime() && !lost)
  {
    return "";
  }
  std::vector<vtkSmartPointer<vtkTextureObject>> textures;
  std::size_t bytes = 0;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    int size[3];
    image->GetDimensions(size);
    if (std::max(size[0], size[1]) > vtkTextureObject::GetMaximumTextureSize(window))
    {
      return "weight image " + std::to_string(k) + " is larger than this graphics card's limit";
    }
    std::size_t bad = 0; // reported when the surface was divided
    std::vector<float> values = WeightImages::GetValues(image, bad);
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(window);
    const int wrap =
      map->GetRepeatWeightImages() ? vtkTextureObject::Repeat : vtkTextureObject::ClampToEdge;
    texture->SetWrapS(wrap);
    texture->SetWrapT(wrap);
    texture->SetGenerateMipmap(true); // radiance is linear in the weights: means are right
    texture->SetMinificationFilter(vtkTextureObject::LinearMipmapLinear);
    texture->SetMagnificationFilter(vtkTextureObject::Linear);
    if (!texture->Create2DFromRaw(static_cast<unsigned int>(size[0]),
          static_cast<unsigned int>(size[1]), GetScalars(image)->GetNumberOfComponents(), VTK_FLOAT,
          values.data()))
    {
      return "weight image " + std::to_string(k) + " could not be uploaded";
    }
    bytes += 4 * values.size() / 3 * 4; // with the smaller levels
    textures.push_back(texture);
  }
  this->Textures = std::move(textures);
  this->Bytes = bytes;
  this->Time = map->GetMTime();
  this->Window = window;
  return "";
}

void WeightTextures::Activate()
{
  for (const vtkSmartPointer<vtkTextureObject>& texture : this->Textures)
  {
    texture->Activate();
  }
}

void WeightTextures::Deactivate()
{
  for (const vtkSmartPointer<vtkTextureObject>& texture : this->Textures)
  {
    texture->Deactivate();
  }
}

std::string WeightTextures::GetSampler(std::size_t image)
{
  return "brdfWeightImage" + std::to_string(image);
}

void WeightTextures::SetUniforms(vtkShaderProgram* program) const
{
  for (std::size_t k = 0; k < this->Textures.size(); ++k)
  {
    program->SetUniformi(GetSampler(k).c_str(), this->Textures[k]->GetTextureUnit());
  }
}
} // namespace measuredbrdf
