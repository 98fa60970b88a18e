// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * f of many lights for one view: faster than one by one where a material can. Private to the
 * module.
 */

#ifndef ManyLights_h
#define ManyLights_h

#include "OneByOne.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <typeinfo>

namespace measuredbrdf
{
/// The material where it is one of RGL's files, else null: whoever derives from the class may do
/// more.
inline vtkAdaptiveWarpBRDF* GetWarp(vtkBRDF* brdf)
{
  return brdf && typeid(*brdf) == typeid(vtkAdaptiveWarpBRDF)
           ? static_cast<vtkAdaptiveWarpBRDF*>(brdf)
           : nullptr;
}

/// The material where it is a table, else null.
inline vtkTabulatedBRDF* GetTable(vtkBRDF* brdf)
{
  return brdf && typeid(*brdf) == typeid(vtkTabulatedBRDF) ? static_cast<vtkTabulatedBRDF*>(brdf)
                                                           : nullptr;
}

/// f of many lights in single precision, by what the material can.
class LightLanes
{
public:
  LightLanes() = default;
  explicit LightLanes(vtkBRDF* brdf)
    : BRDF(brdf)
    , Warp(GetWarp(brdf))
    , Table(GetTable(brdf))
  {
  }

  /// Whether the material evaluates them side by side.
  bool AreSideBySide() const
  {
    return this->Warp || (this->Table && this->Table->GetNumberOfInvalidCells() == 0);
  }

  /// lights: x, y and z of unit vectors above the horizon; f: red, green and blue.
  void Evaluate(
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
    else
    {
      EvaluateLightsOneByOne(this->BRDF, count, lights, &view.x, f);
    }
  }

private:
  vtkBRDF* BRDF = nullptr;
  vtkAdaptiveWarpBRDF* Warp = nullptr;
  vtkTabulatedBRDF* Table = nullptr;
};

/// Of a prepared material; lights: unit vectors above the horizon, like o. RGL's files in single
/// precision; all others, tables too, one by one.
inline void EvaluateManyLights(
  vtkBRDF* brdf, std::size_t count, const glm::dvec3* lights, const glm::dvec3& o, glm::dvec3* f)
{
  vtkAdaptiveWarpBRDF* many = GetWarp(brdf);
  for (std::size_t k = 0; k < count && !many; ++k)
  {
    brdf->Evaluate(&lights[k].x, &o.x, &f[k].x);
  }
  constexpr std::size_t atOnce = 256;
  std::array<std::array<float, atOnce>, 3> i, values;
  const float* const from[3] = { i[0].data(), i[1].data(), i[2].data() };
  float* const to[3] = { values[0].data(), values[1].data(), values[2].data() };
  for (std::size_t first = 0; first < count && many; first += atOnce)
  {
    const std::size_t size = std::min(atOnce, count - first);
    for (std::size_t k = 0; k < size; ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        i[c][k] = static_cast<float>(lights[first + k][c]);
      }
    }
    many->EvaluateLights(static_cast<int>(size), from, &o.x, to);
    for (std::size_t k = 0; k < size; ++k)
    {
      f[first + k] = glm::dvec3(values[0][k], values[1][k], values[2][k]);
    }
  }
}
} // namespace measuredbrdf

#endif
