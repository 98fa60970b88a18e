// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightLanes.h"

#include "OneByOne.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <typeinfo>

namespace measuredbrdf
{
namespace
{
// The material where it is just of this class, else null: whoever derives from it may do more.
template <typename BRDF>
BRDF* GetJust(vtkBRDF* brdf)
{
  return brdf && typeid(*brdf) == typeid(BRDF) ? static_cast<BRDF*>(brdf) : nullptr;
}
}

LightLanes::LightLanes(vtkBRDF* brdf)
  : BRDF(brdf)
  , Warp(GetJust<vtkAdaptiveWarpBRDF>(brdf))
  , Table(GetJust<vtkTabulatedBRDF>(brdf))
  , Fit(GetJust<vtkAshikhminShirleyBRDF>(brdf))
  , Lambert(GetJust<vtkLambertBRDF>(brdf))
{
  auto* sum = GetJust<vtkSumBRDF>(brdf);
  for (int k = 0; sum && k < sum->GetNumberOfTerms(); ++k)
  {
    this->Terms.emplace_back(sum->GetTerm(k));
  }
}

bool LightLanes::AreSideBySide() const
{
  if (!this->Terms.empty())
  {
    return std::all_of(this->Terms.begin(), this->Terms.end(),
      [](const LightLanes& term) { return term.AreSideBySide(); });
  }
  return this->Warp || this->Fit || this->Lambert ||
         (this->Table && this->Table->GetNumberOfInvalidCells() == 0);
}

void LightLanes::Evaluate(
  int count, const float* const lights[3], const glm::dvec3& view, float* const f[3]) const
{
  if (this->Warp)
  {
    this->Warp->EvaluateLights(count, lights, &view.x, f);
  }
  else if (this->Table)
  {
    this->Table->EvaluateLights(count, lights, &view.x, f);
  }
  else if (this->Fit)
  {
    this->Fit->EvaluateLights(count, lights, &view.x, f);
  }
  else if (this->Lambert)
  {
    double everywhere[3];
    this->Lambert->Evaluate(&view.x, &view.x, everywhere);
    for (int c = 0; c < 3; ++c)
    {
      std::fill_n(f[c], count, static_cast<float>(everywhere[c]));
    }
  }
  else if (!this->Terms.empty())
  {
    this->AddUp(count, lights, view, f);
  }
  else
  {
    EvaluateLightsOneByOne(this->BRDF, count, lights, &view.x, f);
  }
}

void LightLanes::AddUp(
  int count, const float* const lights[3], const glm::dvec3& view, float* const f[3]) const
{
  constexpr int atOnce = 64;
  for (int first = 0; first < count; first += atOnce)
  {
    const int some = std::min(count - first, atOnce);
    const float* const from[3] = { lights[0] + first, lights[1] + first, lights[2] + first };
    float values[3][atOnce];
    float* const to[3] = { values[0], values[1], values[2] };
    for (std::size_t term = 0; term < this->Terms.size(); ++term)
    {
      this->Terms[term].Evaluate(some, from, view, to);
      for (int c = 0; c < 3; ++c)
      {
        float* const sum = f[c] + first;
        for (int k = 0; k < some; ++k)
        {
          const float before = term > 0 ? sum[k] : 0.0f;
          sum[k] = std::min(before + values[c][k], std::numeric_limits<float>::max());
        }
      }
    }
  }
}
} // namespace measuredbrdf
