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
  /// Take a value, or say for `self` why not: what is no number and what is no enumerator is
  /// refused, numbers out of range are clamped (Setters.h).
  void SetPlanningMode(vtkObject* self, int mode);
  void SetErrorTolerance(vtkObject* self, double tolerance);
  void SetMaximumCost(vtkObject* self, double cost);
  void SetScalarColoringMode(vtkObject* self, int mode);
  void SetOcclusionMode(vtkObject* self, int mode);
  void SetPlanForView(vtkObject* self, bool view);
  ///@}

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

private:
  // The one rule of Setters.h, for properties that are no members of the object that speaks.
  template <typename T>
  void SetClamped(vtkObject* self, const char* name, T& property, T value, T low, T high);
  void SetMode(vtkObject* self, const char* name, int& property, int value, int count);
};
} // namespace measuredbrdf

///@{
/// A mapper's Set and Get of a property that its Impl->Settings keep: any, and one that may be
/// refused. They do not call Modified(), which would rebuild vertex buffers and shaders: every
/// render compares what it used last with what is asked for.
#define measuredbrdfSettingMacro(Class, Name, Type)             \
  void Class::Set##Name(Type value)                             \
  {                                                             \
    this->Impl->Settings.Set(this->Impl->Settings.Name, value); \
  }                                                             \
  Type Class::Get##Name() { return this->Impl->Settings.Name; }

#define measuredbrdfCheckedSettingMacro(Class, Name, Type)                           \
  void Class::Set##Name(Type value) { this->Impl->Settings.Set##Name(this, value); } \
  Type Class::Get##Name() { return this->Impl->Settings.Name; }
///@}

#endif
