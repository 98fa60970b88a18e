// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVarianceLightSetGenerator.h"

#include "LightTree.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkVarianceLightSetGenerator);

//------------------------------------------------------------------------------
bool vtkVarianceLightSetGenerator::Generate(
  vtkEnvironment* environment, int count, vtkLightSet* output)
{
  if (!this->CheckArguments(environment, count, output))
  {
    return false;
  }
  const measuredbrdf::LightTree tree(
    environment->GetSubdivided(), measuredbrdf::TexelChanges(), count, []() { return true; });
  tree.FillLightSet(count, output);
  return true;
}
