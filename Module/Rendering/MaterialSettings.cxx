// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialSettings.h"

#include "vtkLightSetGenerator.h"
#include "vtkObject.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr double SmallestTolerance = 1e-3;
constexpr double LargestTolerance = 1.0;
}

bool MaterialSettings::IsMode(vtkObject* self, const char* setter, int value, int count) const
{
  if (value >= 0 && value < count)
  {
    return true;
  }
  vtkErrorWithObjectMacro(self, << setter << ": " << value << " is none of the modes 0 to "
                                << count - 1 << "; the mode stays as it was.");
  return false;
}

void MaterialSettings::SetMethod(vtkObject* self, int method)
{
  if (this->IsMode(self, "SetMethod", method, 2))
  {
    this->Set(this->Method, method);
  }
}

void MaterialSettings::SetPlanningMode(vtkObject* self, int mode)
{
  if (this->IsMode(self, "SetPlanningMode", mode, 3))
  {
    this->Set(this->PlanningMode, mode);
  }
}

void MaterialSettings::SetErrorTolerance(vtkObject* self, double tolerance)
{
  if (std::isnan(tolerance))
  {
    vtkErrorWithObjectMacro(self, "SetErrorTolerance: expected a number, got NaN; the tolerance "
                                  "stays at "
                                    << this->ErrorTolerance << ".");
    return;
  }
  const double clamped = std::clamp(tolerance, SmallestTolerance, LargestTolerance);
  if (clamped != tolerance)
  {
    vtkWarningWithObjectMacro(
      self, "SetErrorTolerance: " << tolerance << " clamped to " << clamped << ".");
  }
  this->Set(this->ErrorTolerance, clamped);
}

void MaterialSettings::SetLightSetMethod(vtkObject* self, int method)
{
  if (this->IsMode(self, "SetLightSetMethod", method, 3))
  {
    this->Set(this->LightSetMethod, method);
  }
}

void MaterialSettings::SetNumberOfLights(vtkObject* self, int count)
{
  const int clamped = std::clamp(count, 1, vtkLightSetGenerator::MaximumNumberOfLights);
  if (clamped != count)
  {
    vtkWarningWithObjectMacro(
      self, "SetNumberOfLights: " << count << " clamped to " << clamped << ".");
  }
  this->Set(this->NumberOfLights, clamped);
}

void MaterialSettings::SetScalarColoringMode(vtkObject* self, int mode)
{
  if (this->IsMode(self, "SetScalarColoringMode", mode, 2))
  {
    this->Set(this->ScalarColoringMode, mode);
  }
}

void MaterialSettings::Copy(const MaterialSettings& other)
{
  *this = other;
  this->Time.Modified();
}

vtkMTimeType MaterialSettings::GetMTime() const
{
  vtkMTimeType time = this->Time.GetMTime();
  const auto add = [&time](vtkObject* object)
  { time = std::max(time, object ? object->GetMTime() : 0); };
  add(this->BRDF);
  add(this->Environment);
  add(this->LightSet);
  add(this->Integrator);
  add(this->Costs);
  for (const auto& [index, brdf] : this->BlocksByIndex)
  {
    add(brdf);
  }
  for (const auto& [name, brdf] : this->BlocksByName)
  {
    add(brdf);
  }
  return time;
}

void MaterialSettings::Print(ostream& os, vtkIndent indent) const
{
  const char* const methods[] = { "auto", "light set" };
  const char* const planning[] = { "foreground", "background", "background from start" };
  const char* const lights[] = { "median cut", "importance sampling", "variance" };
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "LightSet: " << this->LightSet.Get() << "\n";
  os << indent << "Integrator: " << this->Integrator.Get() << "\n";
  os << indent << "CostModel: " << (this->Costs ? this->Costs->GetName() : "default") << "\n";
  os << indent << "Method: " << methods[this->Method] << "\n";
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "PlanningMode: " << planning[this->PlanningMode] << "\n";
  os << indent << "PlanForView: " << (this->PlanForView ? "On" : "Off") << "\n";
  os << indent << "LightSetMethod: " << lights[this->LightSetMethod] << "\n";
  os << indent << "NumberOfLights: " << this->NumberOfLights << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "SoftLights: " << (this->SoftLights ? "On" : "Off") << "\n";
  os << indent << "ScalarColoringMode: " << (this->ScalarColoringMode ? "modulate" : "ignore")
     << "\n";
}
} // namespace measuredbrdf
