// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FitSamples.h"

#include "HalfVector.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>

namespace measuredbrdf
{
namespace
{
// Keeps the cube root's slope finite at 0; 1e-6 is below any measured f cos.
constexpr double CubeRootOffset = 1e-6;

// One shift per dimension of the sequence (Cranley, Patterson 1976).
std::array<double, 5> NewShifts(unsigned int seed)
{
  std::mt19937 random(seed);
  std::array<double, 5> shifts;
  for (double& shift : shifts)
  {
    shift = random() * 0x1p-32;
  }
  return shifts;
}

// Density of theta_h uniform in ThetaHToUnit, theta_d, phi_h and phi_d uniform, per di do.
double HalfDifferenceDensity(const glm::dvec3& h, double cosD)
{
  const double sinH = std::hypot(h.x, h.y);
  const double sinD = std::sqrt(std::max(1.0 - cosD * cosD, 0.0));
  const double u = ThetaHToUnit(std::atan2(sinH, h.z));
  const double half = 1.0 / (2.0 * Pi * Pi * u * sinH);
  const double difference = 1.0 / (Pi * Pi * sinD);
  return half * difference / (4.0 * cosD); // di do = 4 cos(theta_d) dh dd
}

// A pair of the sequence, or false where it is below the horizon or at its edge.
bool NewPair(std::uint32_t n, const std::array<double, 5>& shifts, FitSample& sample)
{
  const std::uint32_t bases[5] = { 2, 3, 5, 7, 11 };
  double u[5];
  for (int k = 0; k < 5; ++k)
  {
    u[k] = Wrap01(RadicalInverse(n, bases[k]) + shifts[k]);
  }
  if (u[4] < 0.5)
  {
    const double r = std::sqrt(1.0 - u[0] * u[0]);
    sample.I = glm::dvec3(r * std::cos(2.0 * Pi * u[1]), r * std::sin(2.0 * Pi * u[1]), u[0]);
    SampleCosine(u[2], u[3], glm::value_ptr(sample.O));
  }
  else
  {
    FromHalfDifference(
      { UnitToThetaH(u[0]), 0.5 * Pi * u[2], 2.0 * Pi * u[3] }, sample.I, sample.O);
    const double c = std::cos(2.0 * Pi * u[1]), s = std::sin(2.0 * Pi * u[1]);
    for (glm::dvec3* d : { &sample.I, &sample.O })
    {
      *d = glm::dvec3(c * d->x - s * d->y, s * d->x + c * d->y, d->z);
    }
  }
  sample.H = HalfVector(sample.I, sample.O);
  // Balance heuristic (Veach, Guibas 1995): the mixture's density is never far below the measure.
  const double density = 0.5 * sample.O.z / (2.0 * Pi * Pi) +
                         0.5 * HalfDifferenceDensity(sample.H, glm::dot(sample.H, sample.I));
  sample.Weight = sample.O.z / density;
  return sample.I.z > 1e-9 && sample.O.z >= MinimumViewCosine && std::isfinite(density) &&
         sample.Weight > 0.0;
}

// A twin of each table with holes: 1 in valid cells, 0 in others, so that it gives the share of
// valid cells in what the table interpolates.
void CollectMasks(vtkBRDF* brdf, std::vector<vtkSmartPointer<vtkTabulatedBRDF>>& masks)
{
  auto* sum = vtkSumBRDF::SafeDownCast(brdf);
  for (int k = 0; sum && k < sum->GetNumberOfTerms(); ++k)
  {
    CollectMasks(sum->GetTerm(k), masks);
  }
  auto* table = vtkTabulatedBRDF::SafeDownCast(brdf);
  if (table && table->GetNumberOfInvalidCells() > 0)
  {
    std::vector<float> values = table->GetVolume();
    for (std::size_t k = 0; k < values.size(); k += 3)
    {
      const bool invalid = std::isnan(values[k] + values[k + 1] + values[k + 2]);
      std::fill_n(&values[k], 3, invalid ? 0.0f : 1.0f);
    }
    auto mask = vtkSmartPointer<vtkTabulatedBRDF>::New();
    mask->SetVolume(table->GetParameterization(), table->GetAzimuthRange(), table->GetDimensions(),
      std::move(values));
    masks.push_back(mask);
  }
}
}

//------------------------------------------------------------------------------
double FitLoss::Value(double f, double cosine) const
{
  switch (this->Type)
  {
    case CubeRootCosine:
      return std::cbrt(f * cosine + CubeRootOffset) - std::cbrt(CubeRootOffset);
    case Squared:
      return f * std::sqrt(cosine);
    default:
      return std::log1p(f * cosine);
  }
}

//------------------------------------------------------------------------------
double FitLoss::Slope(double f, double cosine) const
{
  switch (this->Type)
  {
    case CubeRootCosine:
    {
      const double root = std::cbrt(f * cosine + CubeRootOffset);
      return cosine / (3.0 * root * root);
    }
    case Squared:
      return std::sqrt(cosine);
    default:
      return cosine / (1.0 + f * cosine);
  }
}

//------------------------------------------------------------------------------
FitSamples::FitSamples(vtkBRDF* input, const FitLoss& loss, unsigned int seed, int first, int count)
  : Loss(loss)
{
  const std::array<double, 5> shifts = NewShifts(seed);
  for (int k = 0; k < count; ++k)
  {
    FitSample sample;
    if (NewPair(static_cast<std::uint32_t>(first + k) + 1, shifts, sample))
    {
      this->Samples.push_back(sample);
    }
  }

  std::vector<vtkSmartPointer<vtkTabulatedBRDF>> masks;
  CollectMasks(input, masks);
  input->Prepare();
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(this->Samples.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        FitSample& sample = this->Samples[static_cast<std::size_t>(k)];
        const double* i = glm::value_ptr(sample.I);
        const double* o = glm::value_ptr(sample.O);
        input->Evaluate(i, o, sample.F);
        for (vtkTabulatedBRDF* mask : masks)
        {
          double valid[3];
          mask->Evaluate(i, o, valid);
          sample.Weight = valid[0] >= 0.5 ? sample.Weight : 0.0;
        }
      }
    });
  this->Samples.erase(std::remove_if(this->Samples.begin(), this->Samples.end(),
                        [](const FitSample& sample) { return sample.Weight == 0.0; }),
    this->Samples.end());
  this->Normalize();
}

//------------------------------------------------------------------------------
FitSamples::FitSamples(const FitLoss& loss, std::vector<FitSample> samples)
  : Loss(loss)
  , Samples(std::move(samples))
{
}

//------------------------------------------------------------------------------
void FitSamples::Normalize()
{
  double sum = 0.0;
  for (const FitSample& sample : this->Samples)
  {
    sum += sample.Weight;
  }
  for (FitSample& sample : this->Samples)
  {
    sample.Weight /= sum;
  }
}

//------------------------------------------------------------------------------
FitSamples FitSamples::GetFirst(std::size_t count) const
{
  FitSamples first(*this);
  first.Samples.resize(std::min(count, this->size()));
  first.Normalize();
  return first;
}
} // namespace measuredbrdf
