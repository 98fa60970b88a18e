// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLightSet.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkLightSet);

//------------------------------------------------------------------------------
void vtkLightSet::RemoveAllLights()
{
  this->Lights.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkLightSet::AddLight(
  const double direction[3], const double irradiance[3], double solidAngle, double concentration)
{
  Light light = {};
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    vtkErrorMacro("AddLight: the direction (" << direction[0] << ", " << direction[1] << ", "
                                              << direction[2] << ") has no length.");
    return false;
  }
  for (int c = 0; c < 3; ++c)
  {
    if (!std::isfinite(irradiance[c]) || irradiance[c] < 0.0)
    {
      vtkErrorMacro("AddLight: the irradiance (" << irradiance[0] << ", " << irradiance[1] << ", "
                                                 << irradiance[2]
                                                 << ") is negative or not finite.");
      return false;
    }
    light.Direction[c] = direction[c] / length;
    light.Irradiance[c] = irradiance[c];
  }
  if (!(concentration >= 0.0))
  {
    vtkErrorMacro("AddLight: the concentration " << concentration << " is negative or NaN.");
    return false;
  }
  light.SolidAngle = solidAngle;
  light.Concentration = std::isfinite(concentration) ? concentration : 0.0;
  this->Lights.push_back(light);
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
const vtkLightSet::Light& vtkLightSet::GetLight(int index) const
{
  static const Light none = {};
  return index >= 0 && static_cast<std::size_t>(index) < this->Lights.size()
           ? this->Lights[static_cast<std::size_t>(index)]
           : none;
}

//------------------------------------------------------------------------------
int vtkLightSet::GetNumberOfLights() { return static_cast<int>(this->Lights.size()); }

//------------------------------------------------------------------------------
void vtkLightSet::GetDirection(int index, double direction[3])
{
  std::copy_n(this->GetLight(index).Direction, 3, direction);
}

//------------------------------------------------------------------------------
void vtkLightSet::GetIrradiance(int index, double irradiance[3])
{
  std::copy_n(this->GetLight(index).Irradiance, 3, irradiance);
}

//------------------------------------------------------------------------------
double vtkLightSet::GetSolidAngle(int index) { return this->GetLight(index).SolidAngle; }

//------------------------------------------------------------------------------
double vtkLightSet::GetConcentration(int index) { return this->GetLight(index).Concentration; }

//------------------------------------------------------------------------------
double vtkLightSet::GetConcentrationOfVariance(double v)
{
  if (!(v > 0.0))
  {
    return 0.0;
  }
  const double r = std::max(std::sqrt(std::max(1.0 - v, 0.0)), 1e-3);
  return r * (3.0 - r * r) / std::min(v, 1.0);
}

//------------------------------------------------------------------------------
void vtkLightSet::GetTotal(double rgb[3])
{
  std::fill_n(rgb, 3, 0.0);
  for (const Light& light : this->Lights)
  {
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] += light.Irradiance[c];
    }
  }
}

//------------------------------------------------------------------------------
void vtkLightSet::SetLastRegion(int x0, int y0, int x1, int y1)
{
  if (this->Lights.empty() || x0 >= x1 || y0 >= y1)
  {
    vtkErrorMacro("SetLastRegion: no light, or an empty region.");
    return;
  }
  const int region[4] = { x0, y0, x1, y1 };
  std::copy_n(region, 4, this->Lights.back().Region);
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkLightSet::GetRegion(int index, int region[4])
{
  std::copy_n(this->GetLight(index).Region, 4, region);
  return region[0] < region[2];
}

//------------------------------------------------------------------------------
void vtkLightSet::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  double total[3];
  this->GetTotal(total);
  os << indent << "Total: " << total[0] << " " << total[1] << " " << total[2] << "\n";
}
