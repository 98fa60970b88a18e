// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "WeightImages.h"

#include "ParallelFor.h"
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

// Why the images cannot be used, or "". warning: what is odd about them.
std::string Check(vtkMaterialMap* map, std::string& warning)
{
  int components = 0;
  bool anyLeft = false; // weights of no material
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    const std::string name = "weight image " + std::to_string(k);
    vtkDataArray* scalars = GetScalars(image);
    int dimensions[3];
    image->GetDimensions(dimensions);
    if (!scalars || dimensions[2] != 1 || image->GetNumberOfPoints() == 0)
    {
      return name + " is not an image of one slice with scalars";
    }
    if (scalars->GetNumberOfComponents() > 4 ||
        scalars->GetNumberOfTuples() != image->GetNumberOfPoints())
    {
      return name + " has " + std::to_string(scalars->GetNumberOfComponents()) +
             " components and " + std::to_string(scalars->GetNumberOfTuples()) +
             " tuples, expected 1 to 4 components and " +
             std::to_string(image->GetNumberOfPoints()) + " tuples";
    }
    for (int c = 0; c < scalars->GetNumberOfComponents(); ++c)
    {
      double range[2] = { 0.0, 0.0 };
      if (components++ >= map->GetNumberOfMaterials())
      {
        scalars->GetRange(range, c);
      }
      anyLeft = anyLeft || range[0] != 0.0 || range[1] != 0.0;
    }
  }
  if (components < map->GetNumberOfMaterials())
  {
    return "its weight images have " + std::to_string(components) + " components for " +
           std::to_string(map->GetNumberOfMaterials()) + " materials";
  }
  if (anyLeft) // image files often have three components for two materials
  {
    warning = "the last " + std::to_string(components - map->GetNumberOfMaterials()) +
              " components of the weight images belong to no material";
  }
  return "";
}

// Values as floats, at least 0; bad is raised by the number of others.
std::vector<float> GetValues(vtkImageData* image, std::size_t& bad)
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

// The texels of a line of an image that the center of a texel of a finer line lies between, as
// textures are interpolated.
struct Between
{
  Between(int texel, int count, int size, bool repeats)
  {
    const double at = (texel + 0.5) * size / count - 0.5;
    const double below = std::floor(at + Exact);
    this->Share = at - below < Exact ? 0.0 : at - below;
    const auto limit = [size, repeats](double k)
    {
      const double turned =
        repeats ? k - size * std::floor(k / size) : std::clamp(k, 0.0, size - 1.0);
      return static_cast<std::size_t>(turned);
    };
    this->Low = limit(below);
    this->High = this->Share > 0.0 ? limit(below + 1.0) : this->Low;
  }

  static constexpr double Exact = 1e-9; // texels
  std::size_t Low;
  std::size_t High;
  double Share; // of High
};

struct MeasuredImage
{
  std::vector<float> Values;
  std::size_t Width;
  std::size_t Components;
  std::vector<Between> Columns;
  std::vector<Between> Rows;

  double Get(std::size_t column, std::size_t row, std::size_t component) const
  {
    const Between& x = this->Columns[column];
    const Between& y = this->Rows[row];
    const auto line = [&](std::size_t at)
    {
      const float* texels = &this->Values[at * this->Width * this->Components + component];
      return texels[x.Low * this->Components] * (1.0 - x.Share) +
             texels[x.High * this->Components] * x.Share;
    };
    return line(y.Low) * (1.0 - y.Share) + line(y.High) * y.Share;
  }
};
}

// Weights are looked at where the texels of the finest image have their centers: a texel of a
// coarser one is seen there, too.
WeightShares MeasureWeightImages(vtkMaterialMap* map)
{
  WeightShares shares;
  shares.Problem = Check(map, shares.Warning);
  if (!shares.Problem.empty())
  {
    return shares;
  }
  const auto materials = static_cast<std::size_t>(map->GetNumberOfMaterials());
  int width = 0;
  int height = 0;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    const int* size = map->GetWeightImage(k)->GetDimensions();
    width = std::max(width, size[0]);
    height = std::max(height, size[1]);
  }
  std::size_t bad = 0;
  std::vector<MeasuredImage> images;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    const int* size = image->GetDimensions();
    images.push_back({ GetValues(image, bad), static_cast<std::size_t>(size[0]),
      static_cast<std::size_t>(GetScalars(image)->GetNumberOfComponents()), {}, {} });
    for (int x = 0; x < width; ++x)
    {
      images.back().Columns.emplace_back(x, width, size[0], map->GetRepeatWeightImages());
    }
    for (int y = 0; y < height; ++y)
    {
      images.back().Rows.emplace_back(y, height, size[1], map->GetRepeatWeightImages());
    }
  }
  const std::size_t columns = materials + 1;
  std::vector<double> sums(static_cast<std::size_t>(height) * columns, 0.0); // of each row
  ParallelFor(0, height,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<double> weights(columns);
      for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row)
      {
        for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x)
        {
          std::size_t material = 0;
          double sum = 0.0;
          for (const MeasuredImage& image : images)
          {
            for (std::size_t c = 0; c < image.Components && material < materials; ++c)
            {
              weights[++material] = image.Get(x, row, c);
              sum += weights[material];
            }
          }
          sums[row * columns] += sum > 0.0 ? 0.0 : 1.0;
          for (std::size_t k = 1; k < columns && sum > 0.0; ++k)
          {
            sums[row * columns + k] += weights[k] / sum;
          }
        }
      }
    });
  shares.Means.assign(columns, 0.0);
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    shares.Means[k % columns] += sums[k] / (static_cast<double>(width) * height);
  }
  if (bad > 0)
  {
    shares.Warning += (shares.Warning.empty() ? "" : "; ") + std::to_string(bad) +
                      " weights in images are negative, infinite or NaN and count as 0";
  }
  return shares;
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
  std::vector<std::pair<vtkImageData*, vtkMTimeType>> source;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    source.emplace_back(map->GetWeightImage(k), map->GetWeightImage(k)->GetMTime());
  }
  const bool repeats = map->GetRepeatWeightImages();
  if (this->Window == window && source == this->Source && repeats == this->Repeats && !lost)
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
    std::vector<float> values = GetValues(image, bad);
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(window);
    const int wrap = repeats ? vtkTextureObject::Repeat : vtkTextureObject::ClampToEdge;
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
  ++this->Uploads;
  this->Source = std::move(source);
  this->Repeats = repeats;
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
