// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSimulatedPhotographSet.h"

#include "HalfVector.h"
#include "LowDiscrepancy.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkSimulatedPhotographSet);

namespace
{
constexpr double BrightestValue = 0.9;
constexpr double LargestCode = 65535.0;
constexpr double LowestCosine = 0.1736; // of 80 degrees

//------------------------------------------------------------------------------
// Gaussian numbers by Box and Muller 1958: the engine's bits are fixed by the standard, its
// distributions are not.
class NormalNumbers
{
public:
  NormalNumbers(unsigned int seed, int photograph)
  {
    std::seed_seq sequence{ seed, static_cast<unsigned int>(photograph) };
    this->Random.seed(sequence);
  }

  double Get()
  {
    const double u = (static_cast<double>(this->Random()) + 0.5) * 0x1p-32;
    const double v = (static_cast<double>(this->Random()) + 0.5) * 0x1p-32;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * Pi * v);
  }

private:
  std::mt19937 Random;
};

std::string FormatSize(const int dimensions[3])
{
  return std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]);
}

// What keeps a map from having weights for each texel; "" if nothing.
std::string FindWeightProblem(vtkMaterialMap* map)
{
  if (map->GetMode() != vtkMaterialMap::TEXTURES || map->GetNumberOfWeightImages() == 0)
  {
    return "the material map has no weight images";
  }
  int components = 0;
  const int* first = map->GetWeightImage(0)->GetDimensions();
  for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
  {
    vtkImageData* image = map->GetWeightImage(k);
    const int* size = image->GetDimensions();
    vtkDataArray* values = image->GetPointData()->GetScalars();
    if (!values || image->GetNumberOfPoints() == 0 || size[2] != 1)
    {
      return "weight image " + std::to_string(k) + " has no values, or more than one slice";
    }
    if (size[0] != first[0] || size[1] != first[1])
    {
      return "weight image " + std::to_string(k) + ": found " + FormatSize(size) +
             " texels, expected the first image's " + FormatSize(first);
    }
    components += values->GetNumberOfComponents();
  }
  if (map->GetNumberOfMaterials() == 0 || components < map->GetNumberOfMaterials())
  {
    return std::to_string(map->GetNumberOfMaterials()) + " materials with " +
           std::to_string(components) +
           " components of weight images; expected a component for each";
  }
  return std::string();
}

// The weights of a material map's images, texel by texel. The map must have no such problem, and
// must not change meanwhile.
class WeightTexels
{
public:
  explicit WeightTexels(vtkMaterialMap* map)
    : Materials(map->GetNumberOfMaterials())
  {
    for (int k = 0; k < map->GetNumberOfWeightImages(); ++k)
    {
      vtkDataArray* values = map->GetWeightImage(k)->GetPointData()->GetScalars();
      const bool isInteger =
        values->GetDataType() != VTK_FLOAT && values->GetDataType() != VTK_DOUBLE;
      this->Images.emplace_back(values, isInteger ? values->GetDataTypeMax() : 1.0);
    }
  }

  // The materials' weights there, divided by their sum as vtkMaterialMap has it; all 0 where none
  // is positive.
  void Get(vtkIdType texel, double* weights) const
  {
    int material = 0;
    double sum = 0.0;
    for (const auto& [values, divisor] : this->Images)
    {
      for (int c = 0; c < values->GetNumberOfComponents() && material < this->Materials; ++c)
      {
        const double weight = values->GetComponent(texel, c) / divisor;
        weights[material] = std::isfinite(weight) && weight > 0.0 ? weight : 0.0;
        sum += weights[material++];
      }
    }
    for (int k = 0; k < this->Materials && sum > 0.0; ++k)
    {
      weights[k] /= sum;
    }
  }

private:
  std::vector<std::pair<vtkSmartPointer<vtkDataArray>, double>> Images;
  int Materials;
};
}

//------------------------------------------------------------------------------
vtkSimulatedPhotographSet::vtkSimulatedPhotographSet() = default;
vtkSimulatedPhotographSet::~vtkSimulatedPhotographSet() = default;

//------------------------------------------------------------------------------
void vtkSimulatedPhotographSet::SetMaterialMap(vtkMaterialMap* map)
{
  if (this->MaterialMap != map)
  {
    this->MaterialMap = map;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMaterialMap* vtkSimulatedPhotographSet::GetMaterialMap() { return this->MaterialMap; }

//------------------------------------------------------------------------------
double vtkSimulatedPhotographSet::GetBrightest(const Photograph& photograph)
{
  double brightest = 0.0;
  for (int k = 0; this->MaterialMap && k < this->MaterialMap->GetNumberOfMaterials(); ++k)
  {
    double f[3];
    this->MaterialMap->GetBRDF(k)->Evaluate(photograph.Light, photograph.View, f);
    brightest = std::max({ brightest, f[0], f[1], f[2] });
  }
  return brightest * photograph.Light[2] /
         std::hypot(photograph.Light[0], photograph.Light[1], photograph.Light[2]);
}

//------------------------------------------------------------------------------
int vtkSimulatedPhotographSet::AddDirections(
  const double light[3], const double view[3], double exposure)
{
  Photograph photograph;
  std::copy_n(light, 3, photograph.Light);
  std::copy_n(view, 3, photograph.View);
  photograph.Exposure = exposure;
  photograph.Name = "photograph " + std::to_string(this->GetNumberOfPhotographs());
  if (exposure == 0.0)
  {
    const double brightest = this->GetBrightest(photograph);
    photograph.Exposure = brightest > 0.0 ? BrightestValue / (this->Irradiance * brightest) : 1.0;
  }
  return this->Insert(std::move(photograph));
}

//------------------------------------------------------------------------------
int vtkSimulatedPhotographSet::AddBonnDirections(int count, double exposure)
{
  constexpr long long pairs =
    static_cast<long long>(NumberOfBonnDirections) * NumberOfBonnDirections;
  constexpr long long stride = 4057; // prime, pairs times the golden section
  int added = 0;
  for (long long k = 0; k < std::min<long long>(count, pairs); ++k)
  {
    const int pair = static_cast<int>(k * stride % pairs);
    double angles[2], light[3], view[3];
    GetBonnDirection(pair / NumberOfBonnDirections, angles);
    GetDirection(angles[0], angles[1], light);
    GetBonnDirection(pair % NumberOfBonnDirections, angles);
    GetDirection(angles[0], angles[1], view);
    if (this->AddDirections(light, view, exposure) < 0)
    {
      break; // the next fails alike, and it has been said
    }
    ++added;
  }
  return added;
}

//------------------------------------------------------------------------------
int vtkSimulatedPhotographSet::AddHalfVectorDirections(int count, double exposure)
{
  int added = 0;
  for (unsigned int k = 1;
       added < count && this->GetNumberOfPhotographs() < MaximumNumberOfPhotographs; ++k)
  {
    HalfDifference angles;
    angles.ThetaH = 0.5 * Pi * std::pow(RadicalInverse(k, 2), 2);
    angles.ThetaD = 0.5 * Pi * RadicalInverse(k, 3);
    angles.PhiD = 2.0 * Pi * RadicalInverse(k, 5);
    glm::dvec3 light, view;
    FromHalfDifference(angles, light, view);
    if (std::min(light.z, view.z) < LowestCosine)
    {
      continue;
    }
    // The half vector's own azimuth, so that the lights come from all sides.
    const double turn = 2.0 * Pi * RadicalInverse(k, 7);
    const glm::dmat3 rotation(
      std::cos(turn), std::sin(turn), 0.0, -std::sin(turn), std::cos(turn), 0.0, 0.0, 0.0, 1.0);
    light = rotation * light;
    view = rotation * view;
    if (this->AddDirections(&light.x, &view.x, exposure) < 0)
    {
      break;
    }
    ++added;
  }
  return added;
}

//------------------------------------------------------------------------------
void vtkSimulatedPhotographSet::SetNoise(double noise)
{
  if (!std::isfinite(noise) || noise < 0.0)
  {
    measuredbrdfRefuseMacro(Noise, noise, "a finite number >= 0");
    return;
  }
  measuredbrdfAssignMacro(Noise, noise);
}

//------------------------------------------------------------------------------
void vtkSimulatedPhotographSet::SetBits(int bits)
{
  if (bits < 0 || bits > 16)
  {
    measuredbrdfRefuseMacro(Bits, bits, "0 or 1 to 16");
    return;
  }
  measuredbrdfAssignMacro(Bits, bits);
  this->SetTransfer(bits > 0 ? LINEAR : AUTOMATIC);
}

//------------------------------------------------------------------------------
vtkImageData* vtkSimulatedPhotographSet::NewPicture(int index)
{
  const Photograph* photograph = this->Find(index);
  const std::string problem = !photograph         ? "there is no such photograph"
                              : this->MaterialMap ? FindWeightProblem(this->MaterialMap)
                                                  : "no material map";
  if (!problem.empty())
  {
    vtkErrorMacro("NewPicture: photograph " << index << ": " << problem << ".");
    return nullptr;
  }
  const double scale = this->GetScale(index);
  std::vector<std::array<double, 3>> values; // of a texel that is all of one material
  for (int k = 0; k < this->MaterialMap->GetNumberOfMaterials(); ++k)
  {
    double f[3];
    this->MaterialMap->GetBRDF(k)->Evaluate(photograph->Light, photograph->View, f);
    values.push_back({ scale * f[0], scale * f[1], scale * f[2] });
  }
  const WeightTexels weights(this->MaterialMap);
  vtkImageData* picture = vtkImageData::New();
  picture->SetDimensions(this->MaterialMap->GetWeightImage(0)->GetDimensions());
  picture->AllocateScalars(this->Bits > 0 ? VTK_UNSIGNED_SHORT : VTK_FLOAT, 3);
  auto* codes = static_cast<unsigned short*>(picture->GetScalarPointer());
  auto* floats = static_cast<float*>(picture->GetScalarPointer());
  NormalNumbers noise(this->Seed, index);
  const double levels = std::exp2(this->Bits) - 1.0;
  std::vector<double> shares(values.size());
  for (vtkIdType texel = 0; texel < picture->GetNumberOfPoints(); ++texel)
  {
    weights.Get(texel, shares.data());
    for (std::size_t c = 0; c < 3; ++c)
    {
      double value = this->Noise > 0.0 ? this->Noise * noise.Get() : 0.0;
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        value += shares[k] * values[k][c];
      }
      if (this->Bits > 0)
      {
        value = std::round(std::clamp(value, 0.0, 1.0) * levels) / levels;
        *codes++ = static_cast<unsigned short>(std::lround(value * LargestCode));
      }
      else
      {
        *floats++ = static_cast<float>(value);
      }
    }
  }
  return picture;
}

//------------------------------------------------------------------------------
void vtkSimulatedPhotographSet::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaterialMap: " << this->MaterialMap.Get() << "\n";
  os << indent << "Noise: " << this->Noise << "\n";
  os << indent << "Bits: " << this->Bits << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
