// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BouncedLight.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
BouncedLight::Code BouncedLight::MakeDark()
{
  Code code;
  code.fill(static_cast<std::uint8_t>(Middle));
  code[0] = 0;
  return code;
}

// Rounded down: what comes back is never more than what there is.
BouncedLight::Code BouncedLight::Encode(const Transfer& transfer)
{
  Code code = MakeDark();
  const double root = std::sqrt(std::max(transfer[0], 0.0));
  code[0] = static_cast<std::uint8_t>(std::clamp(std::floor(root / RootStep), 0.0, 255.0));
  for (std::size_t j = 1; code[0] > 0 && j < Harmonics; ++j)
  {
    const double step = std::round(transfer[j] / transfer[0] / RatioStep);
    code[j] = static_cast<std::uint8_t>(std::clamp(Middle + step, 0.0, 2.0 * Middle));
  }
  return code;
}

BouncedLight::BouncedLight(const Code& code)
{
  this->Values[0] = std::pow(code[0] * RootStep, 2.0);
  for (std::size_t j = 1; j < Harmonics; ++j)
  {
    this->Values[j] = this->Values[0] * (code[j] - Middle) * RatioStep;
  }
}

glm::dvec3 BouncedLight::GetIrradiance(const sky::Colors& light) const
{
  glm::dvec3 sum(0.0);
  for (std::size_t j = 0; j < Harmonics; ++j)
  {
    sum += this->Values[j] * light[j];
  }
  return glm::max(sum, glm::dvec3(0.0));
}

BouncedLight::Transfer BouncedLight::GetVisible(const HiddenSky::Code& code)
{
  const sky::Values all = sky::GetCosineTransfer(HiddenSky::UnpackNormal(code.data()));
  Transfer transfer;
  for (std::size_t j = 0; j < Harmonics; ++j)
  {
    transfer[j] = all[j] - (code[HiddenSky::SectorBytes + j] - HiddenSky::OpenTransfer) *
                             HiddenSky::TransferStep;
  }
  transfer[0] = std::clamp(transfer[0], 0.0, all[0]);
  return transfer;
}
} // namespace measuredbrdf
