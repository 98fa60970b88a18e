// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Stability.h"

#include "StabilityTools.h"

#include <cmath>

namespace tool::stability
{
//------------------------------------------------------------------------------
void Finding::KnownUpTo(double bound, const std::string& why)
{
  this->Bound = bound;
  this->Why = why;
}

//------------------------------------------------------------------------------
std::string Finding::GetStatus() const
{
  if (!std::isfinite(this->Value) || this->Value > this->Bound)
  {
    return "fail";
  }
  return this->Value <= this->Threshold ? "pass" : "known limit";
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> Context::Choose(vtkBRDF* otherwise) const
{
  return this->BRDF ? this->BRDF.Get() : otherwise;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Context::MakeEnvironment(
  const std::string& otherwise, int width) const
{
  return Shrink(this->Environment ? this->Environment : LoadEnvironment(otherwise), width);
}

//------------------------------------------------------------------------------
Finding& Context::Add(const std::string& method, const std::string& figure, double value,
  double threshold, const std::string& note)
{
  this->Findings.push_back({ method, figure, value, threshold, threshold, note, "" });
  return this->Findings.back();
}

//------------------------------------------------------------------------------
void Context::Add(
  const std::string& method, const std::string& figure, double value, const Limits& limits)
{
  Finding& finding = this->Add(method, figure, value, limits.Threshold);
  const auto known = limits.Known.find(method);
  if (known != limits.Known.end())
  {
    finding.KnownUpTo(known->second, limits.Why);
  }
}

//------------------------------------------------------------------------------
std::vector<Case> GetCases()
{
  std::vector<Case> cases;
  AddBasesCases(cases);
  AddRangeCases(cases);
  AddSamplingCases(cases);
  AddGeometryCases(cases);
  AddTemporalCases(cases);
  AddScaleCases(cases);
  AddDataCases(cases);
  AddConvergenceCases(cases);
  AddNumericCases(cases);
  return cases;
}
} // namespace tool::stability
