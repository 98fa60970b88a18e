// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightSetCache.h"

#include "vtkAlgorithm.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkImportanceLightSetGenerator.h"
#include "vtkLightSet.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkTexture.h"
#include "vtkWeakPointer.h"

#include <map>
#include <tuple>

namespace measuredbrdf
{
namespace
{
// Objects by what they were made from, for as long as somebody holds them. Keys hold modification
// times, which are never used twice: a recycled address does no harm.
template <typename Key, typename T>
class SharedObjects
{
public:
  template <typename Make>
  vtkSmartPointer<T> Find(const Key& key, const Make& make)
  {
    for (auto it = this->Objects.begin(); it != this->Objects.end();)
    {
      it = it->second ? std::next(it) : this->Objects.erase(it);
    }
    auto it = this->Objects.find(key);
    if (it != this->Objects.end())
    {
      return it->second.Get();
    }
    vtkSmartPointer<T> made = make();
    if (made)
    {
      this->Objects[key] = made;
    }
    return made;
  }

private:
  std::map<Key, vtkWeakPointer<T>> Objects;
};
}

vtkSmartPointer<vtkEnvironment> FindEnvironment(vtkTexture* texture)
{
  if (!texture || texture->GetCubeMap())
  {
    return nullptr;
  }
  if (texture->GetInputAlgorithm())
  {
    texture->GetInputAlgorithm()->Update();
  }
  vtkImageData* image = texture->GetInput();
  if (!image || image->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  static SharedObjects<std::tuple<vtkImageData*, vtkMTimeType, bool>, vtkEnvironment> environments;
  const bool sRGB = texture->GetUseSRGBColorSpace();
  return environments.Find({ image, image->GetMTime(), sRGB },
    [image, sRGB]() -> vtkSmartPointer<vtkEnvironment>
    {
      auto environment = vtkSmartPointer<vtkEnvironment>::New();
      return environment->SetImage(image, sRGB) ? environment : nullptr;
    });
}

vtkSmartPointer<vtkLightSet> FindLightSet(
  vtkEnvironment* environment, int method, int count, unsigned int seed)
{
  static SharedObjects<std::tuple<vtkEnvironment*, vtkMTimeType, int, int, unsigned int>,
    vtkLightSet>
    lightSets;
  return lightSets.Find({ environment, environment->GetPixelsMTime(), method, count, seed },
    [environment, method, count, seed]() -> vtkSmartPointer<vtkLightSet>
    {
      vtkSmartPointer<vtkLightSetGenerator> generator;
      if (method == vtkMeasuredBRDFMapper::MEDIAN_CUT)
      {
        generator = vtkSmartPointer<vtkMedianCutLightSetGenerator>::New();
      }
      else
      {
        vtkNew<vtkImportanceLightSetGenerator> importance;
        importance->SetSeed(seed);
        generator = importance;
      }
      auto lights = vtkSmartPointer<vtkLightSet>::New();
      return generator->Generate(environment, count, lights) ? lights : nullptr;
    });
}
} // namespace measuredbrdf
