// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The setters and getters that the plain and the composite mapper share: both keep their properties
 * in MaterialSettings. Private to the rendering room.
 */

#ifndef MapperProperties_h
#define MapperProperties_h

#include "MaterialSettings.h"

// A property that is taken as it is.
#define MEASUREDBRDF_PROPERTY(Class, settings, Name, Setting, Type)                \
  void Class::Set##Name(Type value) { (settings).Set((settings).Setting, value); } \
  Type Class::Get##Name() { return (settings).Setting; }

// One whose values are checked.
#define MEASUREDBRDF_CHECKED_PROPERTY(Class, settings, Name, Type)         \
  void Class::Set##Name(Type value) { (settings).Set##Name(this, value); } \
  Type Class::Get##Name() { return (settings).Name; }

#define MEASUREDBRDF_MAPPER_PROPERTIES(Class, settings)                                  \
  MEASUREDBRDF_PROPERTY(Class, settings, BRDF, BRDF, vtkBRDF*)                           \
  MEASUREDBRDF_PROPERTY(Class, settings, MaterialMap, MaterialMap, vtkMaterialMap*)      \
  MEASUREDBRDF_PROPERTY(Class, settings, Environment, Environment, vtkEnvironment*)      \
  MEASUREDBRDF_PROPERTY(Class, settings, Integrator, Integrator, vtkRadianceIntegrator*) \
  MEASUREDBRDF_PROPERTY(Class, settings, PlanForView, PlanForView, bool)                 \
  MEASUREDBRDF_PROPERTY(Class, settings, UseSceneLights, UseSceneLights, bool)           \
  MEASUREDBRDF_PROPERTY(Class, settings, OcclusionBounce, OcclusionBounce, bool)         \
  MEASUREDBRDF_CHECKED_PROPERTY(Class, settings, PlanningMode, int)                      \
  MEASUREDBRDF_CHECKED_PROPERTY(Class, settings, ErrorTolerance, double)                 \
  MEASUREDBRDF_CHECKED_PROPERTY(Class, settings, MaximumCost, double)                    \
  MEASUREDBRDF_CHECKED_PROPERTY(Class, settings, ScalarColoringMode, int)                \
  MEASUREDBRDF_CHECKED_PROPERTY(Class, settings, OcclusionMode, int)

#endif
