// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLightSetGenerator
 * @brief   environment -> light set (abstract)
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
   * Largest number of lights that can be asked for.
   */
  static constexpr int MaximumNumberOfLights = 1 << 20;

  /**
   * Replace output's lights by about `count` that stand for the environment (unrotated: directions
   * in its own frame). Their luminance adds up to the environment's. An all-black environment gives
   * no lights. Returns false with an error event, output unchanged, when environment is empty or
   * count is not in [1, MaximumNumberOfLights] or not one the generator can make.
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
