// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLightSetGenerator
 * @brief   abstract class that makes a light set from an environment
 */

#ifndef vtkLightSetGenerator_h
#define vtkLightSetGenerator_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

class vtkEnvironment;
class vtkLightSet;

class VTKMEASUREDBRDF_EXPORT vtkLightSetGenerator : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkLightSetGenerator, vtkObject);

  /**
   * Largest number of lights that can be requested.
   */
  static constexpr int MaximumNumberOfLights = 1 << 20;

  /**
   * Replace output's lights by about `count` lights that represent the environment (without its
   * rotation: in its own frame). Their luminance adds up to the environment's. An all-black
   * environment gives no lights. Returns false with an error event and leaves output unchanged when
   * environment is empty, or when count is not in [1, MaximumNumberOfLights] or not a number that
   * the generator can make.
   */
  virtual bool Generate(vtkEnvironment* environment, int count, vtkLightSet* output) = 0;

protected:
  vtkLightSetGenerator() = default;
  ~vtkLightSetGenerator() override = default;

  bool CheckArguments(vtkEnvironment* environment, int count, vtkLightSet* output);

private:
  vtkLightSetGenerator(const vtkLightSetGenerator&) = delete;
  void operator=(const vtkLightSetGenerator&) = delete;
};

#endif
