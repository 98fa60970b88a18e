// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAnisotropicTabulatedBRDF.h"

#include "HalfVector.h"
#include "ModuleShader.h"
#include "NumberText.h"
#include "ParallelFor.h"
#include "Refusal.h"
#include "Setters.h"
#include "VolumeInterpolation.h"
#include "vtkBRDFAnisotropicTable.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/type_ptr.hpp>
#include <glm/gtx/rotate_vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAnisotropicTabulatedBRDF);

namespace
{
constexpr std::size_t MostCells = std::size_t(1) << 26;

// Of a table of that shape.
std::size_t CountCells(int azimuthRange, const int dimensions[4])
{
  const char* const names[] = { "phi_d", "theta_d", "phi_h", "theta_h" };
  const int most = vtkAnisotropicTabulatedBRDF::MaximumSamples; // not a reference to the constant
  std::size_t cells = 1;
  for (int axis = 0; axis < 4; ++axis)
  {
    Require(dimensions[axis] >= 1 && dimensions[axis] <= most,
      "found " + std::to_string(dimensions[axis]) + " samples along " + names[axis] +
        ", expected 1 to " + std::to_string(most));
    cells *= static_cast<std::size_t>(dimensions[axis]);
  }
  Require(dimensions[1] * dimensions[2] <= most,
    "found " + std::to_string(dimensions[1]) + " x " + std::to_string(dimensions[2]) +
      " samples along theta_d and phi_h, expected a product of at most " + std::to_string(most));
  Require(cells <= MostCells,
    "found " + std::to_string(cells) + " samples, expected at most " + std::to_string(MostCells));
  Require(azimuthRange == 0 || azimuthRange == 1,
    "found azimuth range " + std::to_string(azimuthRange) + ", expected 0 or 1");
  return cells;
}

double GetLargestAzimuth(int azimuthRange)
{
  return azimuthRange == vtkAnisotropicTabulatedBRDF::HALF_TURN ? Pi : 2.0 * Pi;
}

// A sample's directions, slid along theta_d to just above the horizon where they lie below: values
// there are seen by interpolation only.
void GetCell(
  int azimuthRange, const int dimensions[4], const int index[4], glm::dvec3& i, glm::dvec3& o)
{
  HalfDifference angles{ UnitToThetaH((index[3] + 0.5) / dimensions[3]),
    0.5 * Pi * (index[1] + 0.5) / dimensions[1], 2.0 * Pi * (index[0] + 0.5) / dimensions[0] };
  angles.ThetaD = std::min(angles.ThetaD, FindHorizon(angles) * (1.0 - 1e-4));
  FromHalfDifference(angles, i, o);
  const double phi = GetLargestAzimuth(azimuthRange) * (index[2] + 0.5) / dimensions[2];
  i = glm::rotateZ(i, phi);
  o = glm::rotateZ(o, phi);
}
}

//------------------------------------------------------------------------------
vtkAnisotropicTabulatedBRDF::vtkAnisotropicTabulatedBRDF() = default;

//------------------------------------------------------------------------------
vtkAnisotropicTabulatedBRDF::~vtkAnisotropicTabulatedBRDF() = default;

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkAnisotropicTabulatedBRDF, ResamplingError, double, 0.0, 1e6);

//------------------------------------------------------------------------------
bool vtkAnisotropicTabulatedBRDF::SetVolume(
  int azimuthRange, const int dimensions[4], std::vector<float> rgb)
{
  const std::string problem = FindProblemOf(
    [&]()
    {
      const std::size_t count = 3 * CountCells(azimuthRange, dimensions);
      Require(rgb.size() == count,
        "found " + std::to_string(rgb.size()) + " values, expected " + std::to_string(count));
      RequireFinite(rgb, "volume");
    });
  if (!problem.empty())
  {
    vtkErrorMacro("SetVolume: " << problem << "; the volume stays.");
    return false;
  }
  this->AzimuthRange = azimuthRange;
  std::copy_n(dimensions, 4, this->Dimensions);
  this->Volume = std::move(rgb);
  this->ResetLobe();
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
bool vtkAnisotropicTabulatedBRDF::Resample(
  vtkBRDF* source, int azimuthRange, const int dimensions[4])
{
  const std::string problem = FindProblemOf(
    [&]()
    {
      Require(source, "there is no source");
      CountCells(azimuthRange, dimensions);
    });
  if (!problem.empty())
  {
    vtkErrorMacro("Resample: " << problem << "; the volume stays.");
    return false;
  }
  source->Prepare();
  const vtkIdType rows = static_cast<vtkIdType>(dimensions[2]) * dimensions[3];
  const std::size_t row = 3u * static_cast<std::size_t>(dimensions[0] * dimensions[1]);
  std::vector<float> rgb(row * static_cast<std::size_t>(rows));
  measuredbrdf::ParallelFor(0, rows, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        float* value = &rgb[row * static_cast<std::size_t>(k)];
        for (int cell = 0; cell < dimensions[0] * dimensions[1]; ++cell)
        {
          const int index[4] = { cell % dimensions[0], cell / dimensions[0],
            static_cast<int>(k % dimensions[2]), static_cast<int>(k / dimensions[2]) };
          glm::dvec3 i, o, f;
          GetCell(azimuthRange, dimensions, index, i, o);
          source->Evaluate(&i.x, &o.x, &f.x);
          for (int c = 0; c < 3; ++c)
          {
            *value++ = static_cast<float>(
              std::min(f[c] * o.z, static_cast<double>(std::numeric_limits<float>::max())));
          }
        }
      }
    });
  this->SetCosineWeighted(true);
  return this->SetVolume(azimuthRange, dimensions, std::move(rgb));
}

//------------------------------------------------------------------------------
void vtkAnisotropicTabulatedBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (this->Volume.empty())
  {
    return;
  }
  const glm::dvec3 light = glm::make_vec3(i), view = glm::make_vec3(o);
  const HalfDifference angles = ToHalfDifference(light, view);
  const glm::dvec3 h = HalfVector(light, view);
  const double phiH = std::hypot(h.x, h.y) > 1e-7 ? std::atan2(h.y, h.x) : 0.0;
  const VolumeSum sum = GatherCorners<4>(this->Volume, this->Dimensions,
    { PeriodicNeighbors(angles.PhiD / (2.0 * Pi), this->Dimensions[0]),
      ClampedNeighbors(angles.ThetaD * (2.0 / Pi), this->Dimensions[1]),
      PeriodicNeighbors(phiH / GetLargestAzimuth(this->AzimuthRange), this->Dimensions[2]),
      ClampedNeighbors(ThetaHToUnit(angles.ThetaH), this->Dimensions[3]) });
  DivideByValid(sum, this->CosineWeighted ? o[2] : 1.0, f);
}

//------------------------------------------------------------------------------
void vtkAnisotropicTabulatedBRDF::Prepare()
{
  if (!this->HasLobe() && !this->Volume.empty())
  {
    this->SetLobe(64, 32, 0.5);
  }
}

//------------------------------------------------------------------------------
// theta_d within phi_h is one axis of the texture.
void vtkAnisotropicTabulatedBRDF::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  vtkBRDFShaderInputs::Term term;
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfVolume";
  texture.ThreeD = true;
  texture.Dimensions = { std::max(this->Dimensions[0], 1),
    std::max(this->Dimensions[1] * this->Dimensions[2], 1), std::max(this->Dimensions[3], 1) };
  texture.Repeat = { true, false, false };
  texture.HalfFloat = 4.0 * HalfRounding <= this->ResamplingTolerance;
  const float scale = texture.HalfFloat ? GetPeakScale(this->Volume) : 1.0f;
  texture.Data = this->Volume;
  texture.Data.resize(std::max<std::size_t>(texture.Data.size(), 3)); // black without a volume
  std::transform(texture.Data.begin(), texture.Data.end(), texture.Data.begin(),
    [scale](float value) { return value * scale; });
  measuredbrdf::SetModuleShader(term, "vtkBRDFAnisotropicTable", vtkBRDFAnisotropicTable);
  term.Uniforms = { { "brdfScale", { 1.0f / scale } },
    { "brdfTurns", { this->AzimuthRange == HALF_TURN ? 2.0f : 1.0f } },
    { "brdfAzimuths", { static_cast<float>(std::max(this->Dimensions[2], 1)) } },
    { "brdfCosineWeighted", { this->CosineWeighted ? 1.0f : 0.0f } } };
  TextStream text;
  text << "half/difference volume with the half vector's azimuth " << this->Dimensions[0] << " x "
       << this->Dimensions[1] << " x " << this->Dimensions[2] << " x " << this->Dimensions[3]
       << ", " << (texture.HalfFloat ? "16" : "32") << "-bit float, " << texture.GetBytes()
       << " bytes";
  if (this->ResamplingError > 0.0)
  {
    text << ", resampling error " << this->ResamplingError;
  }
  inputs.QuantizationError =
    std::max(inputs.QuantizationError, texture.HalfFloat ? HalfRounding : FloatRounding);
  inputs.ResamplingError = std::max(inputs.ResamplingError, this->ResamplingError);
  inputs.Description = text.str();
  term.Textures.push_back(std::move(texture));
  term.Fetches = 2;
  inputs.Terms.push_back(std::move(term));
}

//------------------------------------------------------------------------------
void vtkAnisotropicTabulatedBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  exchange.Flag(
    "cosineWeighted", this->CosineWeighted, [this](bool on) { this->SetCosineWeighted(on); });
  exchange.Number("resamplingError", this->ResamplingError,
    [this](double value) { this->SetResamplingError(value); });
  int azimuthRange = this->AzimuthRange;
  exchange.Option("azimuthRange", { "half-turn", "full-turn" }, azimuthRange,
    [&](int value) { azimuthRange = value; });
  if (!exchange.IsLoading())
  {
    exchange.SaveArray("volume",
      { this->Dimensions[3], this->Dimensions[2], this->Dimensions[1], this->Dimensions[0] }, 3,
      this->Volume);
    return;
  }
  auto volume = exchange.LoadArray("volume", 4, 3);
  const int dimensions[4] = { volume.Shape[3], volume.Shape[2], volume.Shape[1], volume.Shape[0] };
  if (!this->SetVolume(azimuthRange, dimensions, std::move(volume.Values)))
  {
    exchange.Fail("array 'volume' was refused");
  }
}

//------------------------------------------------------------------------------
vtkBRDF* vtkAnisotropicTabulatedBRDF::NewCopy()
{
  vtkAnisotropicTabulatedBRDF* copy = vtkAnisotropicTabulatedBRDF::New();
  copy->AzimuthRange = this->AzimuthRange;
  std::copy_n(this->Dimensions, 4, copy->Dimensions);
  copy->CosineWeighted = this->CosineWeighted;
  copy->ResamplingError = this->ResamplingError;
  copy->Volume = this->Volume;
  return copy;
}
