// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSimulatedPhotographSet.h"

#include "HalfVector.h"
#include "LowDiscrepancy.h"
#include "Setters.h"
#include "WeightTexels.h"
#include "vtkBRDF.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
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
std::string vtkSimulatedPhotographSet::FindProblem()
{
  return this->MaterialMap ? FindWeightProblem(this->MaterialMap) : "no material map";
}

//------------------------------------------------------------------------------
vtkImageData* vtkSimulatedPhotographSet::NewPicture(int index)
{
  const Photograph* photograph = this->Find(index);
  const std::string problem = photograph ? this->FindProblem() : "there is no such photograph";
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
  picture->SetDimensions(weights.GetWidth(), weights.GetHeight(), 1);
  picture->AllocateScalars(this->Bits > 0 ? VTK_UNSIGNED_SHORT : VTK_FLOAT, 3);
  auto* codes = static_cast<unsigned short*>(picture->GetScalarPointer());
  auto* floats = static_cast<float*>(picture->GetScalarPointer());
  NormalNumbers noise(this->Seed, index);
  const double levels = std::exp2(this->Bits) - 1.0;
  std::vector<double> shares(values.size());
  for (vtkIdType texel = 0; texel < weights.GetNumberOfTexels(); ++texel)
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
