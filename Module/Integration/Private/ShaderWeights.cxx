// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderWeights.h"

#include "RadianceCore.h"
#include "ShaderProfile.h"

#include <glm/glm.hpp>

namespace measuredbrdf
{
namespace
{
constexpr double Zero = RadianceCore::MostSteps; // what is stored for none
}

ShaderWeights::ShaderWeights(const RadianceCore& core)
  : Rows(CountRows(static_cast<int>(core.Orders.size())))
{
  constexpr auto perTexel = static_cast<std::size_t>(PerTexel);
  this->Texels.assign(
    4 * Size * static_cast<std::size_t>(this->Rows), static_cast<float>(Zero + Zero / Fractions));
  for (std::size_t mode = 0; mode < core.Orders.size(); ++mode)
  {
    for (std::size_t k = 0; k < Size; ++k)
    {
      const glm::dvec3 steps = core.GetSteps(mode, ShaderProfile::GetTexelPosition(k));
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        const std::size_t number = 3 * mode + channel;
        const double unit = number % perTexel < 4 ? 1.0 : 1.0 / Fractions;
        this->Texels[4 * (number / perTexel * Size + k) + number % 4] +=
          static_cast<float>(unit * steps[static_cast<int>(channel)]);
      }
    }
  }
}

std::string ShaderWeights::GetUnpacking(int row)
{
  const std::string index = std::to_string(row);
  const std::string low = "low" + index;
  const std::string high = "high" + index;
  const std::string zero = std::to_string(static_cast<int>(Zero)) + ".0";
  return "vec4 " + low + " = texelFetch(brdfCoreProfileINSTANCE, ivec2(view, " + index +
         "), 0); vec4 " + high + " = floor(" + low + "); " + low + " = (" + low + " - " + high +
         ") * " + std::to_string(static_cast<int>(Fractions)) + ".0 - " + zero + "; " + high +
         " -= " + zero + "; " + low + " *= abs(" + low + "); " + high + " *= abs(" + high + "); ";
}

std::string ShaderWeights::GetName(int number)
{
  return (number % PerTexel < 4 ? "high" : "low") + std::to_string(number / PerTexel) + "." +
         "xyzw"[number % 4];
}
} // namespace measuredbrdf
