// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialSettings.h"

#include "Setters.h"
#include "vtkObject.h"

#include <algorithm>

namespace measuredbrdf
{
void MaterialSettings::SetClamped(
  vtkObject* self, const char* name, double& property, double value, double low, double high)
{
  if (!IsFinite(value))
  {
    vtkErrorWithObjectMacro(self, << "Set" << name << ": found " << value
                                  << ", expected a number from " << low << " to " << high << "; "
                                  << property << " stays.");
    return;
  }
  const double clamped = std::clamp(value, low, high);
  if (clamped != value)
  {
    vtkWarningWithObjectMacro(self, << "Set" << name << ": " << value << " is not from " << low
                                    << " to " << high << "; " << clamped << " is taken.");
  }
  this->Set(property, clamped);
}

void MaterialSettings::SetMode(
  vtkObject* self, const char* name, int& property, int value, int count)
{
  if (value < 0 || value >= count)
  {
    vtkErrorWithObjectMacro(self, << "Set" << name << ": found " << value
                                  << ", expected a number from 0 to " << count - 1 << "; "
                                  << property << " stays.");
    return;
  }
  this->Set(property, value);
}

void MaterialSettings::SetPlanForView(bool view)
{
  if (view || this->PlanForView)
  {
    this->PlanForView = view;
    this->ViewTime.Modified();
    this->Time.Modified();
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
  add(this->MaterialMap);
  add(this->Environment);
  time = std::max(time, this->Integrator ? this->Integrator->GetInputsMTime() : 0);
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
  const char* const planning[] = { "foreground", "background", "background from start" };
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "MaterialMap: " << this->MaterialMap.Get() << "\n";
  os << indent << "Environment: " << this->Environment.Get() << "\n";
  os << indent << "Integrator: " << this->Integrator.Get() << "\n";
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "MaximumCost: " << this->MaximumCost << "\n";
  os << indent << "PlanningMode: " << planning[this->PlanningMode] << "\n";
  os << indent << "PlanForView: " << (this->PlanForView ? "On" : "Off") << "\n";
  os << indent << "ScalarColoringMode: " << (this->ScalarColoringMode ? "modulate" : "ignore")
     << "\n";
  const char* const occlusion[] = { "off", "auto", "on", "arrays" };
  os << indent << "OcclusionMode: " << occlusion[this->OcclusionMode] << "\n";
  os << indent << "OcclusionBounce: " << (this->OcclusionBounce ? "On" : "Off") << "\n";
  os << indent << "UseSceneLights: " << (this->UseSceneLights ? "On" : "Off") << "\n";
}
} // namespace measuredbrdf
