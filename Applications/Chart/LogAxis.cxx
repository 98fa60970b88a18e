// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LogAxis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tool
{
//------------------------------------------------------------------------------
std::string FormatTick(double value, Unit unit)
{
  char text[32];
  switch (unit)
  {
    case Unit::Milliseconds:
      std::snprintf(
        text, sizeof(text), value < 999.0 ? "%g ms" : "%g s", value < 999.0 ? value : 1e-3 * value);
      break;
    case Unit::Bytes:
      std::snprintf(text, sizeof(text),
        value < 999.0     ? "%g B"
        : value < 0.999e6 ? "%g kB"
                          : "%g MB",
        value < 999.0     ? value
        : value < 0.999e6 ? 1e-3 * value
                          : 1e-6 * value);
      break;
    case Unit::Share:
      std::snprintf(text, sizeof(text), "%g %%", 100.0 * value);
      break;
    default:
      std::snprintf(text, sizeof(text), "%g", value);
  }
  return text;
}

//------------------------------------------------------------------------------
LogAxis::LogAxis(const std::vector<double>& values)
{
  for (const double value : values)
  {
    if (value > 0.0 && std::isfinite(value))
    {
      this->Least = std::min(this->Least, std::log10(value));
      this->Largest = std::max(this->Largest, std::log10(value));
    }
  }
  if (!(this->Least <= this->Largest))
  {
    this->Least = this->Largest = 0.0;
  }
  const double air = std::max(0.08 * (this->Largest - this->Least), 0.15);
  this->Least -= air;
  this->Largest += air;
}

//------------------------------------------------------------------------------
double LogAxis::Find(double value) const
{
  return (std::log10(value) - this->Least) / (this->Largest - this->Least);
}

//------------------------------------------------------------------------------
std::vector<double> LogAxis::GetTicks() const
{
  std::vector<double> ticks;
  const bool wide = this->Largest - this->Least > 3.2;
  for (int k = static_cast<int>(std::floor(this->Least)); k <= this->Largest; ++k)
  {
    for (const double factor : { 1.0, 2.0, 5.0 })
    {
      const double at = k + std::log10(factor);
      if (at >= this->Least && at <= this->Largest && (factor == 1.0 || !wide))
      {
        ticks.push_back(at);
      }
    }
  }
  return ticks;
}
} // namespace tool
