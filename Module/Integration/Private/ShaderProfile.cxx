// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderProfile.h"

#include "LobePlacement.h"
#include "RadianceTable.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
float Pack(double high, double low)
{
  const double whole = std::round(std::clamp(high, 0.0, 1.0) * ShaderProfile::HighSteps);
  const double steps = std::round(std::clamp(low, 0.0, 1.0) * ShaderProfile::LowSteps);
  return static_cast<float>(
    whole + std::min(steps, ShaderProfile::LowSteps - 1.0) / ShaderProfile::LowSteps);
}
}

ShaderProfile::ShaderProfile(const RadianceTable& table)
{
  glm::dvec3 share(1e-30);
  glm::dvec3 lambert(1e-30);
  for (std::size_t k = 0; k < Size; ++k)
  {
    const double u = GetTexelPosition(k);
    share = glm::max(share, GetProfileValue(table.Profile, 1, u));
    lambert = glm::max(lambert, GetProfileValue(table.Profile, 2, u));
  }
  share = glm::sqrt(share);
  lambert = glm::sqrt(lambert) * (LowSteps / (LowSteps - 1.0)); // the largest fraction is below 1
  for (std::size_t k = 0; k < Size; ++k)
  {
    const double u = GetTexelPosition(k);
    const auto root = [&](int row)
    { return glm::sqrt(glm::max(GetProfileValue(table.Profile, row, u), 0.0)); };
    const glm::dvec3 high = root(1) / share;
    const glm::dvec3 low = root(2) / lambert;
    for (int c = 0; c < 3; ++c)
    {
      this->Texels.push_back(Pack(high[c], low[c]));
    }
    this->Texels.push_back(static_cast<float>(GetAxisExcess(table.Profile, u)));
  }
  for (int c = 0; c < 3; ++c)
  {
    this->Share[static_cast<std::size_t>(c)] = static_cast<float>(share[c] / HighSteps);
    this->Lambert[static_cast<std::size_t>(c)] = static_cast<float>(lambert[c]);
  }
}
} // namespace measuredbrdf
