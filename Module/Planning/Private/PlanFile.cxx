// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanFile.h"

#include "NumberText.h"
#include "vtkRadianceMethods.h"

#include <algorithm>
#include <cstddef>
#include <locale>
#include <sstream>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t LargestCount = 100; // of candidates
constexpr std::size_t MostSizes = 16;     // of a candidate

// Whether the candidate's method has such sizes: damaged ones may ask for any amount of memory.
bool AreSizesValid(const PlanCandidate& candidate)
{
  const auto method = vtkSmartPointer<vtkRadianceIntegrator>::Take(
    vtkRadianceMethods::NewIntegrator(candidate.Method));
  const auto sizes = method ? method->GetSizes() : std::vector<vtkRadianceIntegrator::Size>();
  bool valid = method && candidate.Sizes.size() <= sizes.size();
  for (std::size_t k = 0; valid && k < candidate.Sizes.size(); ++k)
  {
    valid = candidate.Sizes[k] >= sizes[k].Least && candidate.Sizes[k] <= sizes[k].Largest;
  }
  return valid;
}

bool ReadCandidate(std::istream& text, PlanCandidate& candidate)
{
  std::size_t count = 0;
  text >> candidate.Method >> count;
  if (!text || !vtkRadianceMethods::IsBuiltIn(candidate.Method) || count > MostSizes)
  {
    return false;
  }
  candidate.Sizes.resize(count);
  for (int& size : candidate.Sizes)
  {
    text >> size;
  }
  text >> candidate.Cost >> candidate.Error >> candidate.Uncertainty >> candidate.Picture >>
    candidate.Bytes >> candidate.SetUp;
  std::getline(text >> std::ws, candidate.Description);
  return text && !text.eof();
}
}

std::string WritePlan(const Plan& plan)
{
  TextStream text;
  text.precision(17);
  text << plan.Candidates.size() << " " << plan.Choice << " " << plan.Meets << "\n";
  for (const PlanCandidate& candidate : plan.Candidates)
  {
    if (!vtkRadianceMethods::IsBuiltIn(candidate.Method))
    {
      return "";
    }
    text << candidate.Method << " " << candidate.Sizes.size();
    for (const int size : candidate.Sizes)
    {
      text << " " << size;
    }
    text << " " << candidate.Cost << " " << candidate.Error << " " << candidate.Uncertainty << " "
         << candidate.Picture << " " << candidate.Bytes << " " << candidate.SetUp << " "
         << candidate.Description << "\n";
  }
  text << plan.Reason << "\n";
  text << plan.Candidates[static_cast<std::size_t>(plan.Choice)].Integrator->GetPrepared();
  return text.str();
}

bool ReadPlan(const std::string& bytes, vtkBRDF* brdf, vtkEnvironment* environment, Plan& plan)
{
  std::istringstream text(bytes);
  text.imbue(std::locale::classic());
  std::size_t count = 0;
  Plan read;
  text >> count >> read.Choice >> read.Meets;
  if (!text || count > LargestCount || read.Choice < 0 || read.Choice >= static_cast<int>(count))
  {
    return false;
  }
  read.Candidates.resize(count);
  const bool whole = std::all_of(read.Candidates.begin(), read.Candidates.end(),
    [&text](PlanCandidate& candidate) { return ReadCandidate(text, candidate); });
  std::getline(text >> std::ws, read.Reason);
  if (!whole || !text || text.eof()) // the line has no end
  {
    return false;
  }
  PlanCandidate& chosen = read.Candidates[static_cast<std::size_t>(read.Choice)];
  if (!AreSizesValid(chosen))
  {
    return false;
  }
  chosen.Integrator = MakeIntegrator(chosen, brdf, environment);
  if (!chosen.Integrator->TakePrepared(bytes.substr(static_cast<std::size_t>(text.tellg()))))
  {
    return false;
  }
  plan = read;
  return true;
}
} // namespace measuredbrdf
