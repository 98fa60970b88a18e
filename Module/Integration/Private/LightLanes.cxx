// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightLanes.h"

#include "Floats.h"
#include "OneByOne.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <array>
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
  this->Terms.reserve(sum ? sum->GetNumberOfTerms() : 0);
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
  return (this->Warp && this->Warp->IsIsotropic()) || this->Fit || this->Lambert ||
         (this->Table && this->Table->IsIsotropic() && this->Table->GetNumberOfInvalidCells() == 0);
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
      std::fill_n(f[c], count, ToFloat(everywhere[c]));
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

void LightLanes::Evaluate(
  std::size_t count, const glm::dvec3* lights, const glm::dvec3& view, glm::dvec3* f) const
{
  const bool sideBySide = this->AreSideBySide();
  for (std::size_t k = 0; k < count && !sideBySide; ++k)
  {
    this->BRDF->Evaluate(&lights[k].x, &view.x, &f[k].x);
  }
  constexpr std::size_t atOnce = 256;
  std::array<std::array<float, atOnce>, 3> i, values;
  const float* const from[3] = { i[0].data(), i[1].data(), i[2].data() };
  float* const to[3] = { values[0].data(), values[1].data(), values[2].data() };
  for (std::size_t first = 0; first < count && sideBySide; first += atOnce)
  {
    const std::size_t size = std::min(atOnce, count - first);
    for (std::size_t k = 0; k < size; ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        i[c][k] = static_cast<float>(lights[first + k][c]);
      }
    }
    this->Evaluate(static_cast<int>(size), from, view, to);
    for (std::size_t k = 0; k < size; ++k)
    {
      f[first + k] = glm::dvec3(values[0][k], values[1][k], values[2][k]);
    }
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
