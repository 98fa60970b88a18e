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
    this->Problem = "its weight images have " + std::to_string(components) + " components for " +
                    std::to_string(map->GetNumberOfMaterials()) + " materials";
  }
  else if (anyLeft) // image files often have three components for two materials
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

namespace
{
// Where a line across the images is looked at: at the centers of all texels. Between these weights
// are linear, so that nothing is missed that is seen anywhere.
struct Samples
{
  Samples(std::vector<int> sizes, bool repeats)
  {
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    for (int size : sizes)
    {
      for (int k = 0; k < size; ++k)
      {
        this->At.push_back((k + 0.5) / size);
      }
    }
    std::sort(this->At.begin(), this->At.end());
    this->At.erase(std::unique(this->At.begin(), this->At.end()), this->At.end());
    for (std::size_t k = 0; k < this->At.size(); ++k)
    {
      const double before =
        k > 0 ? this->At[k - 1] : (repeats ? this->At.back() - 1.0 : -this->At[0]);
      const double after = k + 1 < this->At.size()
                             ? this->At[k + 1]
                             : (repeats ? this->At[0] + 1.0 : 2.0 - this->At.back());
      this->Shares.push_back(0.5 * (after - before));
    }
  }

  std::vector<double> At;     // from 0 to 1
  std::vector<double> Shares; // of the line; their sum is 1
};

// The texels of an image that a sample lies between, as textures are interpolated.
struct Between
{
  Between(double at, int size, bool repeats)
  {
    const double texel = at * size - 0.5;
    const double below = std::floor(texel + Exact);
    this->Share = texel - below < Exact ? 0.0 : texel - below;
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
    const auto texel = [&](std::size_t at, std::size_t line)
    {
      return static_cast<double>(
        this->Values[(line * this->Width + at) * this->Components + component]);
    };
    const double low = texel(x.Low, y.Low) * (1.0 - x.Share) + texel(x.High, y.Low) * x.Share;
    const double high = texel(x.Low, y.High) * (1.0 - x.Share) + texel(x.High, y.High) * x.Share;
    return low * (1.0 - y.Share) + high * y.Share;
  }
};
}

void WeightImages::Measure(vtkMaterialMap* map)
{
  const auto materials = static_cast<std::size_t>(map->GetNumberOfMaterials());
  const bool repeats = map->GetRepeatWeightImages();
  std::vector<int> sizes[2];
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    int size[3];
    map->GetWeightImage(k)->GetDimensions(size);
    sizes[0].push_back(size[0]);
    sizes[1].push_back(size[1]);
  }
  const Samples columns(sizes[0], repeats);
  const Samples rows(sizes[1], repeats);
  std::size_t bad = 0;
  std::vector<MeasuredImage> images;
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    const auto place = static_cast<std::size_t>(k);
    MeasuredImage measured;
    measured.Values = GetValues(image, bad);
    measured.Width = static_cast<std::size_t>(sizes[0][place]);
    measured.Components = static_cast<std::size_t>(GetScalars(image)->GetNumberOfComponents());
    for (double at : columns.At)
    {
      measured.Columns.emplace_back(at, sizes[0][place], repeats);
    }
    for (double at : rows.At)
    {
      measured.Rows.emplace_back(at, sizes[1][place], repeats);
    }
    images.push_back(std::move(measured));
  }
  // Of each row: the materials' means, then the share without any.
  std::vector<double> sums(rows.At.size() * (materials + 1), 0.0);
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(rows.At.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<double> weights(materials);
      for (auto row = static_cast<std::size_t>(begin); row < static_cast<std::size_t>(end); ++row)
      {
        double* means = &sums[row * (materials + 1)];
        for (std::size_t column = 0; column < columns.At.size(); ++column)
        {
          std::size_t material = 0;
          double sum = 0.0;
          for (const MeasuredImage& image : images)
          {
            for (std::size_t c = 0; c < image.Components && material < materials; ++c, ++material)
            {
              weights[material] = image.Get(column, row, c);
              sum += weights[material];
            }
          }
          const double share = columns.Shares[column] * rows.Shares[row];
          means[materials] += sum > 0.0 ? 0.0 : share;
          for (std::size_t k = 0; k < materials && sum > 0.0; ++k)
          {
            means[k] += share * weights[k] / sum;
          }
        }
      }
    });
  this->Means.assign(materials, 0.0);
  for (std::size_t row = 0; row < rows.At.size(); ++row)
  {
    for (std::size_t k = 0; k < materials; ++k)
    {
      this->Means[k] += sums[row * (materials + 1) + k];
    }
    this->Empty += sums[row * (materials + 1) + materials];
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
    std::vector<float> values = WeightImages::GetValues(image, bad);
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
