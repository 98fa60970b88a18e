// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a program sets on a mapper of measured materials; the plain and the composite mapper have
 * the same properties, described in vtkMeasuredBRDFMapper.h.
 */

#ifndef MaterialSettings_h
#define MaterialSettings_h

#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkMaterialMap.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"

#include <map>
#include <string>

class vtkObject;

namespace measuredbrdf
{
constexpr double LargestTolerance = 1.0; // of the error, that planners take

struct MaterialSettings
{
  vtkSmartPointer<vtkBRDF> BRDF;
  vtkSmartPointer<vtkMaterialMap> MaterialMap;
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkSmartPointer<vtkRadianceIntegrator> Integrator;
  int PlanningMode = 0;
  bool PlanForView = false;
  double ErrorTolerance = 0.02;
  double MaximumCost = 150.0;
  int ScalarColoringMode = 1;
  bool UseSceneLights = true;
  int OcclusionMode = 1;
  bool OcclusionBounce = false;

  // The composite mapper's materials of single blocks; a null one draws that block as the
  // superclass does.
  std::map<unsigned int, vtkSmartPointer<vtkBRDF>> BlocksByIndex;
  std::map<std::string, vtkSmartPointer<vtkBRDF>> BlocksByName;

  vtkTimeStamp Time;     // when a property last changed
  vtkTimeStamp ViewTime; // when PlanForView was last set, which looks anew

  ///@{
  /// Take a value of the property of that name, or say for `self` why not: what is no number and
  /// what is no enumerator is refused, numbers out of range are clamped (Setters.h).
  void SetClamped(
    vtkObject* self, const char* name, double& property, double value, double low, double high);
  void SetMode(vtkObject* self, const char* name, int& property, int value, int count);
  ///@}

  /// Look anew where it is switched on again.
  void SetPlanForView(bool view);

  /// Any other property.
  template <typename Property, typename Value>
  void Set(Property& property, const Value& value)
  {
    if (property != value)
    {
      property = value;
      this->Time.Modified();
    }
  }

  bool HasBlockMaterials() const
  {
    return !this->BlocksByIndex.empty() || !this->BlocksByName.empty();
  }

  /// All properties of another mapper.
  void Copy(const MaterialSettings& other);

  /// When anything last changed that pictures depend on: a property, or an object behind one.
  vtkMTimeType GetMTime() const;

  void Print(ostream& os, vtkIndent indent) const;
};
} // namespace measuredbrdf

/// A mapper's Set and Get of a property that its Impl->Settings keep, here and in the list of all.
/// They do not call Modified(), which would rebuild vertex buffers and shaders: every render
/// compares what it used last with what is asked for.
#define measuredbrdfSettingMacro(Class, Name, Type, set) \
  void Class::Set##Name(Type value)                      \
  {                                                      \
    auto& settings = this->Impl->Settings;               \
    set;                                                 \
  }                                                      \
  Type Class::Get##Name() { return this->Impl->Settings.Name; }
#define measuredbrdfAnySettingMacro(Class, Name, Type) \
  measuredbrdfSettingMacro(Class, Name, Type, settings.Set(settings.Name, value))
#define measuredbrdfNumberSettingMacro(Class, Name, low, high) \
  measuredbrdfSettingMacro(                                    \
    Class, Name, double, settings.SetClamped(this, #Name, settings.Name, value, low, high))
#define measuredbrdfModeSettingMacro(Class, Name, count) \
  measuredbrdfSettingMacro(                              \
    Class, Name, int, settings.SetMode(this, #Name, settings.Name, value, count))
#define measuredbrdfAllSettingsMacro(Class)                                           \
  measuredbrdfAnySettingMacro(Class, BRDF, vtkBRDF*);                                 \
  measuredbrdfAnySettingMacro(Class, MaterialMap, vtkMaterialMap*);                   \
  measuredbrdfAnySettingMacro(Class, Environment, vtkEnvironment*);                   \
  measuredbrdfAnySettingMacro(Class, Integrator, vtkRadianceIntegrator*);             \
  measuredbrdfAnySettingMacro(Class, UseSceneLights, bool);                           \
  measuredbrdfAnySettingMacro(Class, OcclusionBounce, bool);                          \
  measuredbrdfSettingMacro(Class, PlanForView, bool, settings.SetPlanForView(value)); \
  measuredbrdfNumberSettingMacro(Class, ErrorTolerance, 1e-3, LargestTolerance);      \
  measuredbrdfNumberSettingMacro(Class, MaximumCost, 1.0, 1e6);                       \
  measuredbrdfModeSettingMacro(Class, PlanningMode, 3);                               \
  measuredbrdfModeSettingMacro(Class, ScalarColoringMode, 2);                         \
  measuredbrdfModeSettingMacro(Class, OcclusionMode, 4)

/// What both mappers ask of their Impl->Drawing.
#define measuredbrdfDrawingMacro(Class)                                                      \
  bool Class::GetPlanPending() { return this->Impl->Drawing->IsPending(); }                  \
  bool Class::GetPlanReady() { return this->Impl->Drawing->IsReady(); }                      \
  void Class::SetAbortPlanning(bool abort) { this->Impl->Drawing->SetAbortPlanning(abort); } \
  bool Class::GetAbortPlanning() { return this->Impl->Drawing->GetAbortPlanning(); }         \
  double Class::FitProperty(vtkProperty* property)                                           \
  {                                                                                          \
    return vtkPBRPropertyFitter::Fit(this->GetBRDF(), property);                             \
  }

#endif
