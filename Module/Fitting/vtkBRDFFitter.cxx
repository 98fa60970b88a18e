// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFFitter.h"

#include "HalfVector.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

using namespace measuredbrdf;

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

// A pair of the sequence; of weight 0 where it is below the horizon or at its edge.
vtkBRDFFitter::Sample NewPair(std::uint32_t n, const std::array<double, 5>& shifts)
{
  const std::uint32_t bases[5] = { 2, 3, 5, 7, 11 };
  double u[5];
  for (int k = 0; k < 5; ++k)
  {
    u[k] = Wrap01(RadicalInverse(n, bases[k]) + shifts[k]);
  }
  glm::dvec3 i, o;
  if (u[4] < 0.5)
  {
    i = ToDirection(u[0], 2.0 * Pi * u[1]);
    SampleCosine(u[2], u[3], glm::value_ptr(o));
  }
  else
  {
    FromHalfDifference({ UnitToThetaH(u[0]), 0.5 * Pi * u[2], 2.0 * Pi * u[3] }, i, o);
    const double c = std::cos(2.0 * Pi * u[1]), s = std::sin(2.0 * Pi * u[1]);
    i = { c * i.x - s * i.y, s * i.x + c * i.y, i.z };
    o = { c * o.x - s * o.y, s * o.x + c * o.y, o.z };
  }
  const glm::dvec3 h = HalfVector(i, o);
  // Balance heuristic (Veach, Guibas 1995): the mixture's density is never far below the measure.
  const double density =
    0.5 * o.z / (2.0 * Pi * Pi) + 0.5 * HalfDifferenceDensity(h, glm::dot(h, i));
  const double weight = o.z / density;
  const bool counts =
    i.z > 1e-9 && o.z >= MinimumViewCosine && std::isfinite(density) && weight > 0.0;
  return { { i.x, i.y, i.z }, { o.x, o.y, o.z }, { 0.0, 0.0, 0.0 }, counts ? weight : 0.0 };
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

// Pairs first ... first + count of the sequence; fewer if the input has invalid cells.
vtkBRDFFitter::Samples DrawSamples(vtkBRDF* input, unsigned int seed, int first, int count)
{
  const std::array<double, 5> shifts = NewShifts(seed);
  vtkBRDFFitter::Samples samples;
  for (int k = 0; k < count; ++k)
  {
    samples.push_back(NewPair(static_cast<std::uint32_t>(first + k) + 1, shifts));
  }
  std::vector<vtkSmartPointer<vtkTabulatedBRDF>> masks;
  CollectMasks(input, masks);
  input->Prepare();
  ParallelForEach(
    samples.size(),
    [&](std::size_t k)
    {
      vtkBRDFFitter::Sample& sample = samples[k];
      if (sample.Weight > 0.0)
      {
        input->Evaluate(sample.I, sample.O, sample.F);
      }
      for (vtkTabulatedBRDF* mask : masks)
      {
        double valid[3];
        mask->Evaluate(sample.I, sample.O, valid);
        sample.Weight = valid[0] >= 0.5 ? sample.Weight : 0.0;
      }
    },
    nullptr, 0);
  samples.erase(std::remove_if(samples.begin(), samples.end(),
                  [](const vtkBRDFFitter::Sample& sample) { return sample.Weight == 0.0; }),
    samples.end());
  vtkBRDFFitter::NormalizeWeights(samples);
  return samples;
}
}

//------------------------------------------------------------------------------
vtkBRDFFitter::vtkBRDFFitter() = default;

//------------------------------------------------------------------------------
vtkBRDFFitter::~vtkBRDFFitter() = default;

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkBRDFFitter, Loss, int, LOG_COSINE, SQUARED);
measuredbrdfSetInRangeMacro(vtkBRDFFitter, NumberOfSamples, int, 256, 1 << 22);
measuredbrdfSetInRangeMacro(vtkBRDFFitter, NumberOfStarts, int, 1, 64);
measuredbrdfSetInRangeMacro(vtkBRDFFitter, MaximumNumberOfIterations, int, 1, 10000);
measuredbrdfSetInRangeMacro(vtkBRDFFitter, Tolerance, double, 1e-15, 0.999);

//------------------------------------------------------------------------------
void vtkBRDFFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Input: " << this->Input.Get() << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
  os << indent << "Loss: " << this->Loss << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "NumberOfStarts: " << this->NumberOfStarts << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
  os << indent << "Residual: " << this->Residual << "\n";
  os << indent << "RelativeL2Error: " << this->RelativeL2Error << "\n";
  os << indent << "InputAlbedo: " << this->InputAlbedo[0] << " " << this->InputAlbedo[1] << " "
     << this->InputAlbedo[2] << "\n";
  os << indent << "OutputAlbedo: " << this->OutputAlbedo[0] << " " << this->OutputAlbedo[1] << " "
     << this->OutputAlbedo[2] << "\n";
  os << indent << "NumberOfIterations: " << this->GetNumberOfIterations() << "\n";
  os << indent << "Converged: " << (this->Converged ? "On" : "Off") << "\n";
}

//------------------------------------------------------------------------------
void vtkBRDFFitter::SetInput(vtkBRDF* input) { measuredbrdfAssignMacro(Input, input); }

//------------------------------------------------------------------------------
vtkBRDF* vtkBRDFFitter::GetInput() { return this->Input; }

//------------------------------------------------------------------------------
vtkBRDF* vtkBRDFFitter::GetOutput() { return this->Output; }

//------------------------------------------------------------------------------
int vtkBRDFFitter::GetNumberOfIterations()
{
  return std::max(static_cast<int>(this->ResidualHistory.size()) - 1, 0);
}

//------------------------------------------------------------------------------
bool vtkBRDFFitter::UpdateProgress(double share)
{
  this->InvokeEvent(vtkCommand::ProgressEvent, &share);
  return !this->Abort;
}

//------------------------------------------------------------------------------
double vtkBRDFFitter::GetLossValue(double f, double cosine) const
{
  switch (this->Loss)
  {
    case CUBE_ROOT_COSINE:
      return std::cbrt(f * cosine + CubeRootOffset) - std::cbrt(CubeRootOffset);
    case SQUARED:
      return f * std::sqrt(cosine);
    default:
      return std::log1p(f * cosine);
  }
}

//------------------------------------------------------------------------------
double vtkBRDFFitter::GetLossSlope(double f, double cosine) const
{
  switch (this->Loss)
  {
    case CUBE_ROOT_COSINE:
    {
      const double root = std::cbrt(f * cosine + CubeRootOffset);
      return cosine / (3.0 * root * root);
    }
    case SQUARED:
      return std::sqrt(cosine);
    default:
      return cosine / (1.0 + f * cosine);
  }
}

//------------------------------------------------------------------------------
void vtkBRDFFitter::NormalizeWeights(Samples& samples)
{
  double sum = 0.0;
  for (const Sample& sample : samples)
  {
    sum += sample.Weight;
  }
  for (Sample& sample : samples)
  {
    sample.Weight /= sum;
  }
}

//------------------------------------------------------------------------------
bool vtkBRDFFitter::Fit()
{
  this->Abort = false;
  const auto fit = [&]()
  {
    if (!this->Input)
    {
      throw std::runtime_error("no input");
    }
    const Samples samples = DrawSamples(this->Input, this->Seed, 0, this->NumberOfSamples);
    if (std::all_of(samples.begin(), samples.end(),
          [](const Sample& s) { return s.F[0] == 0.0 && s.F[1] == 0.0 && s.F[2] == 0.0; }))
    {
      throw std::runtime_error("the input is 0 (or has no valid cell) at all " +
                               std::to_string(this->NumberOfSamples) +
                               " direction pairs: there is nothing to fit");
    }
    const Result result = this->UpdateProgress(0.0) ? this->FitTo(samples) : Result();
    if (!result.BRDF || this->Abort)
    {
      const std::string why = result.Report.empty() ? "" : ": " + result.Report;
      throw std::runtime_error(this->Abort ? "aborted" : "the solver failed" + why);
    }
    const std::string source = this->Input->GetSource();
    result.BRDF->SetName(this->Input->GetName());
    result.BRDF->SetSource(
      this->GetModelName() + " fitted to " + (source.empty() ? "a BRDF" : source));
    this->Measure(result.BRDF);
    this->Output = result.BRDF;
    this->ResidualHistory = result.History;
    for (double& mean : this->ResidualHistory)
    {
      mean = std::sqrt(mean);
    }
    this->Converged = result.Converged;
    this->Report = result.Report;
    this->UpdateProgress(1.0);
  };
  return RunGuarded(this, "Fit", fit);
}

//------------------------------------------------------------------------------
void vtkBRDFFitter::Measure(vtkBRDF* output)
{
  const Samples samples = DrawSamples(
    this->Input, this->Seed, this->NumberOfSamples, std::max(this->NumberOfSamples, 16384));
  double mean = 0.0, difference = 0.0, total = 0.0, cosines = 0.0;
  glm::dvec3 in(0.0), out(0.0);
  output->Prepare();
  for (const Sample& sample : samples)
  {
    const double projected = sample.Weight * sample.I[2];
    glm::dvec3 f;
    output->Evaluate(sample.I, sample.O, &f.x);
    cosines += projected;
    for (int c = 0; c < 3; ++c)
    {
      const double t =
        this->GetLossValue(f[c], sample.I[2]) - this->GetLossValue(sample.F[c], sample.I[2]);
      mean += sample.Weight * t * t / 3.0;
      difference += projected * (f[c] - sample.F[c]) * (f[c] - sample.F[c]);
      total += projected * sample.F[c] * sample.F[c];
    }
    in += projected * glm::make_vec3(sample.F);
    out += projected * f;
  }
  if (!std::isfinite(mean) || !std::isfinite(difference) || !std::isfinite(total))
  {
    throw std::runtime_error("the input's values are too large to compute with");
  }
  this->Residual = std::sqrt(mean);
  this->RelativeL2Error = total > 0.0 ? std::sqrt(difference / total) : 0.0;
  for (int c = 0; c < 3; ++c)
  {
    this->InputAlbedo[c] = Pi * in[c] / cosines;
    this->OutputAlbedo[c] = Pi * out[c] / cosines;
  }
}
