// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLightSetGenerator.h"

#include "vtkEnvironment.h"
#include "vtkLightSet.h"

//------------------------------------------------------------------------------
bool vtkLightSetGenerator::CheckArguments(
  vtkEnvironment* environment, int count, vtkLightSet* output)
{
  if (!environment || environment->GetPixels().empty())
  {
    vtkErrorMacro("Generate: there is no environment, or it is empty.");
    return false;
  }
  if (!output)
  {
    vtkErrorMacro("Generate: there is no light set to fill.");
    return false;
  }
  if (count < 1 || count > MaximumNumberOfLights)
  {
    vtkErrorMacro("Generate: the number of lights must be in [1, " << MaximumNumberOfLights
                                                                   << "], not " << count << ".");
    return false;
  }
  return true;
}
