// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFFitter.h"

#include "FitSamples.h"
#include "HalfVector.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

using namespace measuredbrdf;

// The losses know their types by these numbers.
static_assert(static_cast<int>(vtkBRDFFitter::LOG_COSINE) == FitLoss::LogCosine);
static_assert(static_cast<int>(vtkBRDFFitter::CUBE_ROOT_COSINE) == FitLoss::CubeRootCosine);
static_assert(static_cast<int>(vtkBRDFFitter::SQUARED) == FitLoss::Squared);

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
  os << indent << "StartSeed: " << this->StartSeed << "\n";
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
void vtkBRDFFitter::SetInput(vtkBRDF* input)
{
  if (this->Input != input)
  {
    this->Input = input;
    this->Modified();
  }
}

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
  return FitLoss{ this->Loss }.Value(f, cosine);
}

//------------------------------------------------------------------------------
bool vtkBRDFFitter::Fit()
{
  this->Abort = false;
  const std::string wrong = this->Input ? this->CheckOptions() : "no input";
  if (!wrong.empty())
  {
    vtkErrorMacro("Fit: " << wrong << ".");
    return false;
  }
  std::vector<Sample> samples;
  bool black = true;
  for (const FitSample& drawn :
    FitSamples(this->Input, FitLoss{ this->Loss }, this->Seed, 0, this->NumberOfSamples))
  {
    samples.push_back({ { drawn.I.x, drawn.I.y, drawn.I.z }, { drawn.O.x, drawn.O.y, drawn.O.z },
      { drawn.F[0], drawn.F[1], drawn.F[2] }, drawn.Weight });
    black = black && drawn.F[0] == 0.0 && drawn.F[1] == 0.0 && drawn.F[2] == 0.0;
  }
  if (black)
  {
    vtkErrorMacro("Fit: the input is 0 (or has no valid cell) at all "
                  << this->NumberOfSamples << " direction pairs: there is nothing to fit.");
    return false;
  }
  if (!this->UpdateProgress(0.0))
  {
    vtkErrorMacro("Fit: aborted.");
    return false;
  }
  Result result = this->FitTo(samples);
  if (!result.BRDF || this->Abort)
  {
    const std::string why = result.Report.empty() ? "" : ": " + result.Report;
    vtkErrorMacro("Fit: " << (this->Abort ? "aborted" : "the solver failed" + why) << ".");
    return false;
  }
  result.BRDF->SetName(this->Input->GetName());
  result.BRDF->SetSource(this->GetModelName() + " fitted to " +
                         (this->Input->GetSource().empty() ? "a BRDF" : this->Input->GetSource()));
  if (!this->Measure(result.BRDF))
  {
    vtkErrorMacro("Fit: the input's values are too large to compute with.");
    return false;
  }
  this->Output = result.BRDF;
  this->ResidualHistory = result.History;
  for (double& mean : this->ResidualHistory)
  {
    mean = std::sqrt(mean);
  }
  this->Converged = result.Converged;
  this->Report = result.Report;
  this->UpdateProgress(1.0);
  return true;
}

//------------------------------------------------------------------------------
bool vtkBRDFFitter::Measure(vtkBRDF* output)
{
  const FitSamples samples(this->Input, FitLoss{ this->Loss }, this->Seed, this->NumberOfSamples,
    std::max(this->NumberOfSamples, 16384));
  const FitLoss& loss = samples.GetLoss();
  double mean = 0.0, difference = 0.0, total = 0.0, cosines = 0.0;
  double in[3] = { 0.0, 0.0, 0.0 }, out[3] = { 0.0, 0.0, 0.0 };
  output->Prepare();
  for (const FitSample& sample : samples)
  {
    const double projected = sample.Weight * sample.I.z;
    double f[3];
    output->Evaluate(glm::value_ptr(sample.I), glm::value_ptr(sample.O), f);
    cosines += projected;
    for (int c = 0; c < 3; ++c)
    {
      const double t = loss.Value(f[c], sample.I.z) - loss.Value(sample.F[c], sample.I.z);
      mean += sample.Weight * t * t / 3.0;
      difference += projected * (f[c] - sample.F[c]) * (f[c] - sample.F[c]);
      total += projected * sample.F[c] * sample.F[c];
      in[c] += projected * sample.F[c];
      out[c] += projected * f[c];
    }
  }
  if (!std::isfinite(mean) || !std::isfinite(difference) || !std::isfinite(total))
  {
    return false;
  }
  this->Residual = std::sqrt(mean);
  this->RelativeL2Error = total > 0.0 ? std::sqrt(difference / total) : 0.0;
  for (int c = 0; c < 3; ++c)
  {
    this->InputAlbedo[c] = Pi * in[c] / cosines;
    this->OutputAlbedo[c] = Pi * out[c] / cosines;
  }
  return true;
}
