// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LightSplatter.h"

#include "CosinePowerWarp.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
// alpha / pi of CosinePowerWarp.h for cosines down to the horizon, absolute error 2e-8 (acos by
// Abramowitz and Stegun 1964, 4.4.46): atan2 would cost more than everything else about a light.
double FastHalfAngle(double cosine)
{
  const double x = std::sqrt(std::min(cosine, 1.0));
  return (2.0 / Pi) * std::sqrt(1.0 - x) *
         (1.5707963050 +
           x * (-0.2145988016 +
                 x * (0.0889789874 +
                       x * (-0.0501743046 +
                             x * (0.0308918810 +
                                   x * (-0.0170881256 + x * (0.0066700901 - x * 0.0012624911)))))));
}

}

LightSplatter::LightSplatter(int orders)
  : Values(6 * orders)
  , Sums(6 * orders, IncidentNodes + 2)
  , Orders(orders)
{
}

void LightSplatter::Gather(const std::vector<MapLight>& lights, const Frame& frame)
{
  this->Sums.setZero();
  for (const MapLight& light : lights)
  {
    const double z = glm::dot(frame[2], light.Direction);
    if (z > 0.0)
    {
      this->Add(glm::dot(frame[0], light.Direction), glm::dot(frame[1], light.Direction), z,
        light.Irradiance);
    }
  }
}

Eigen::Matrix<float, 6, 1> LightSplatter::Contract(const Radial& radial) const
{
  const auto rows = this->Sums.middleRows<6>(6 * radial.Order);
  const float sign = radial.Order % 2 == 0 ? 1.0f : -1.0f;
  return rows.middleCols(1, IncidentNodes) * radial.Incident +
         rows.col(0) * (sign * radial.Incident[0]) +
         rows.col(IncidentNodes + 1) * radial.Incident[IncidentNodes - 1];
}

void LightSplatter::Add(double x, double y, double z, const glm::dvec3& irradiance)
{
  const double l = std::sqrt(x * x + y * y);
  const float c = l > 1e-12 ? static_cast<float>(x / l) : 1.0f;
  const float s = l > 1e-12 ? static_cast<float>(y / l) : 0.0f;
  float cm = 1.0f;
  float sm = 0.0f;
  const float rgb[3] = { static_cast<float>(irradiance.x), static_cast<float>(irradiance.y),
    static_cast<float>(irradiance.z) };
  for (int m = 0; m < this->Orders; ++m)
  {
    float* values = this->Values.data() + 6 * m;
    for (int k = 0; k < 3; ++k)
    {
      values[k] = cm * rgb[k];
      values[3 + k] = sm * rgb[k];
    }
    const float next = cm * c - sm * s;
    sm = cm * s + sm * c;
    cm = next;
  }
  const double position = FastHalfAngle(z) * IncidentNodes + 0.5;
  const int first = std::min(static_cast<int>(position), IncidentNodes);
  const float weight = static_cast<float>(position - first);
  this->Sums.col(first) += (1.0f - weight) * this->Values;
  this->Sums.col(first + 1) += weight * this->Values;
}
} // namespace measuredbrdf
