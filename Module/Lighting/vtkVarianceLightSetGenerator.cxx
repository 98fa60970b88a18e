// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVarianceLightSetGenerator.h"

#include "LightTree.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkVarianceLightSetGenerator);

namespace
{
constexpr int LeastTreeSize = 1024; // lights, for which a tree is made at first
}

struct vtkVarianceLightSetGenerator::Internals
{
  // What the tree was made from. Modification times are never used twice: a recycled address does
  // no harm.
  std::pair<vtkEnvironment*, vtkMTimeType> MadeFrom;
  std::unique_ptr<measuredbrdf::LightTree> Tree;
};

//------------------------------------------------------------------------------
vtkVarianceLightSetGenerator::vtkVarianceLightSetGenerator()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkVarianceLightSetGenerator::~vtkVarianceLightSetGenerator() = default;

//------------------------------------------------------------------------------
bool vtkVarianceLightSetGenerator::Grow(vtkEnvironment* environment, int count)
{
  using measuredbrdf::LightTree;
  environment = environment->GetSubdivided();
  const std::pair key(environment, environment->GetPixelsMTime());
  std::unique_ptr<LightTree>& tree = this->Impl->Tree;
  if (!tree || this->Impl->MadeFrom != key)
  {
    tree = std::make_unique<LightTree>(environment);
    this->Impl->MadeFrom = key;
  }
  else if (count <= tree->GetNumberOfCells() || tree->IsComplete())
  {
    return true;
  }
  // Each growth goes over all nodes: few and large ones.
  const int size = std::max(
    { count, LeastTreeSize, std::min(2 * tree->GetNumberOfCells(), MaximumNumberOfLights) });
  const bool grown = tree->Grow(environment, size,
    [this](double progress)
    {
      this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
      return !this->Abort;
    });
  if (!grown)
  {
    tree.reset();
    vtkErrorMacro("Generate: aborted.");
  }
  return grown;
}

//------------------------------------------------------------------------------
bool vtkVarianceLightSetGenerator::Generate(
  vtkEnvironment* environment, int count, vtkLightSet* output)
{
  this->Abort = false;
  if (!this->CheckArguments(environment, count, output) || !this->Grow(environment, count))
  {
    return false;
  }
  const measuredbrdf::LightTree& tree = *this->Impl->Tree;
  this->ResidualVariance = tree.GetResidual(std::min(count, tree.GetNumberOfCells()));
  tree.FillLightSet(count, output);
  return true;
}

//------------------------------------------------------------------------------
int vtkVarianceLightSetGenerator::GetNumberOfLightsForVariance(
  vtkEnvironment* environment, double target)
{
  this->Abort = false;
  if (!environment || environment->GetPixels().empty() || !(target >= 0.0))
  {
    vtkErrorMacro("GetNumberOfLightsForVariance: an environment and a target >= 0 are needed, not "
                  << target << ".");
    return 0;
  }
  int count = 1;
  while (this->Grow(environment, count))
  {
    const measuredbrdf::LightTree& tree = *this->Impl->Tree;
    for (count = std::min(count, tree.GetNumberOfCells());
         count < tree.GetNumberOfCells() && tree.GetResidual(count) > target; ++count)
    {
    }
    if (tree.GetResidual(count) <= target || tree.IsComplete() || count >= MaximumNumberOfLights)
    {
      return count;
    }
    ++count;
  }
  return 0;
}

//------------------------------------------------------------------------------
void vtkVarianceLightSetGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ResidualVariance: " << this->ResidualVariance << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
