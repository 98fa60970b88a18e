// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAdaptiveRadianceIntegrator.h"

#include "AdaptiveSum.h"
#include "DirectionPairs.h"
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "TexelTree.h"
#include "vtkBRDF.h"
#include "vtkDataArray.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

vtkStandardNewMacro(vtkAdaptiveRadianceIntegrator);

namespace
{
// How far the mirror directions of a four may be from the first one's, in radians.
constexpr double MostApart = measuredbrdf::ReflectionGuide::Peaks::GetResolution();
constexpr int PairsTogether = 4;
using AdaptiveSumOfFour = measuredbrdf::AdaptiveSum<PairsTogether>;
constexpr double SingleShare = 0.7; // of the tolerance: one pair is as exact then as four together
}

//------------------------------------------------------------------------------
struct vtkAdaptiveRadianceIntegrator::Internals
{
  // What it is made of; the tolerance changes nothing here.
  using Key = std::tuple<vtkEnvironment*, vtkMTimeType, vtkBRDF*, vtkMTimeType>;
  Key Inputs;
  measuredbrdf::TexelTree Texels;
  measuredbrdf::ReflectionGuide Guide;
};

//------------------------------------------------------------------------------
vtkAdaptiveRadianceIntegrator::vtkAdaptiveRadianceIntegrator() = default;
vtkAdaptiveRadianceIntegrator::~vtkAdaptiveRadianceIntegrator() = default;

//------------------------------------------------------------------------------
bool vtkAdaptiveRadianceIntegrator::Begin()
{
  if (!this->HasLight())
  {
    return false;
  }
  const Internals::Key inputs(
    this->Environment, this->Environment->GetMTime(), this->BRDF, this->BRDF->GetMTime());
  if (!this->Prepared || this->Prepared->Inputs != inputs)
  {
    this->Prepared.reset(
      new Internals{ inputs, measuredbrdf::TexelTree(this->Environment->GetSubdivided()),
        measuredbrdf::ReflectionGuide(this->BRDF) });
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::IntegratePair(
  const double n[3], const double o[3], const double t[3], double radiance[3])
{
  this->SumPair(
    { glm::make_vec3(n), glm::make_vec3(o), glm::make_vec3(t) }, this->Tolerance, radiance);
}

//------------------------------------------------------------------------------
// Adds what it reflects.
void vtkAdaptiveRadianceIntegrator::SumPair(
  const vtkDirectionPair& pair, double tolerance, double* radiance)
{
  const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(pair.Normal, pair.Tangent);
  const measuredbrdf::AdaptiveSum<1>::Pair one{ frame, measuredbrdf::ToLocal(frame, pair.View) };
  thread_local measuredbrdf::AdaptiveSum<1> sum; // keeps its memory
  glm::dvec3 result;
  sum.Run(this->Prepared->Texels, this->Prepared->Guide, this->BRDF, &one, tolerance, &result);
  this->Evaluations += sum.GetNumberOfEvaluations();
  measuredbrdf::AddRGB(result, radiance);
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::IntegrateFour(const vtkDirectionPair* pairs, double* radiance)
{
  const bool areNear = std::all_of(pairs, pairs + PairsTogether,
    [pairs](const vtkDirectionPair& pair)
    {
      const double apart =
        2.0 * glm::distance(pair.Normal, pairs->Normal) + glm::distance(pair.View, pairs->View);
      return apart <= MostApart && glm::dot(pair.Normal, pair.View) > 0.0;
    });
  if (!areNear)
  {
    for (int k = 0; k < PairsTogether; ++k)
    {
      const vtkDirectionPair& pair = pairs[k];
      const auto isSame = [&pair](const vtkDirectionPair& other)
      { return other.Normal == pair.Normal && other.View == pair.View; };
      const auto same = std::find_if(pairs, pairs + k, isSame);
      if (same != pairs + k) // it fills the four up
      {
        std::copy_n(radiance + 3 * (same - pairs), 3, radiance + 3 * k);
      }
      else if (glm::dot(pair.Normal, pair.View) > 0.0)
      {
        this->SumPair(pair, SingleShare * this->Tolerance, radiance + 3 * k);
      }
    }
    return;
  }
  std::array<AdaptiveSumOfFour::Pair, PairsTogether> group;
  for (std::size_t k = 0; k < group.size(); ++k)
  {
    const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(pairs[k].Normal, pairs[k].Tangent);
    group[k] = { frame, measuredbrdf::ToLocal(frame, pairs[k].View) };
  }
  std::array<glm::dvec3, PairsTogether> results;
  thread_local AdaptiveSumOfFour sum; // keeps its memory
  sum.Run(this->Prepared->Texels, this->Prepared->Guide, this->BRDF, group.data(), this->Tolerance,
    results.data());
  this->Evaluations += sum.GetNumberOfEvaluations();
  for (std::size_t k = 0; k < group.size(); ++k)
  {
    std::copy_n(&results[k].x, 3, radiance + 3 * k);
  }
}

//------------------------------------------------------------------------------
bool vtkAdaptiveRadianceIntegrator::IntegrateNeighbors(
  vtkDataArray* normals, vtkDataArray* views, vtkDataArray* radiance)
{
  if (this->BRDF && !this->BRDF->IsIsotropic())
  {
    vtkErrorMacro("IntegrateNeighbors: found an anisotropic BRDF, expected an isotropic one.");
    return false;
  }
  const auto sumFours = [this](const vtkDirectionPair* pairs, vtkIdType fours, double* sums)
  {
    measuredbrdf::ParallelForEach(
      fours,
      [&](vtkIdType four)
      { this->IntegrateFour(pairs + PairsTogether * four, sums + 3 * PairsTogether * four); },
      &this->Abort, 0);
  };
  return this->IntegrateGroups(
    "IntegrateNeighbors", normals, views, radiance, nullptr, PairsTogether, sumFours);
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::CopyProperties(vtkRadianceIntegrator* source)
{
  this->Superclass::CopyProperties(source);
  if (auto* adaptive = vtkAdaptiveRadianceIntegrator::SafeDownCast(source))
  {
    this->SetTolerance(adaptive->Tolerance);
  }
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Evaluations: " << this->Evaluations << "\n";
}
