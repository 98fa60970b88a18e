// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAdaptiveRadianceIntegrator.h"

#include "AdaptiveSum.h"
#include "LocalFrame.h"
#include "ReflectionGuide.h"
#include "TexelTree.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

vtkStandardNewMacro(vtkAdaptiveRadianceIntegrator);

//------------------------------------------------------------------------------
struct vtkAdaptiveRadianceIntegrator::Internals
{
  Internals(vtkEnvironment* environment, vtkBRDF* brdf)
    : Texels(environment)
    , Guide(brdf)
  {
  }
  measuredbrdf::TexelTree Texels;
  measuredbrdf::ReflectionGuide Guide;
};

//------------------------------------------------------------------------------
vtkAdaptiveRadianceIntegrator::vtkAdaptiveRadianceIntegrator() = default;
vtkAdaptiveRadianceIntegrator::~vtkAdaptiveRadianceIntegrator() = default;

//------------------------------------------------------------------------------
bool vtkAdaptiveRadianceIntegrator::Begin()
{
  vtkEnvironment* environment = this->Environment;
  if (!environment || environment->GetPixels().empty())
  {
    vtkErrorMacro("Integrate: there is no environment, or it is empty.");
    return false;
  }
  this->Prepared = std::make_unique<Internals>(environment->GetSubdivided(), this->BRDF);
  return true;
}

//------------------------------------------------------------------------------
void vtkAdaptiveRadianceIntegrator::IntegratePart(
  int vtkNotUsed(part), const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = measuredbrdf::ToLocal(frame, glm::make_vec3(o));
  thread_local measuredbrdf::AdaptiveSum sum; // keeps its memory
  const glm::dvec3 result = sum.Run(
    this->Prepared->Texels, this->Prepared->Guide, this->BRDF, frame, view, this->Tolerance);
  this->Evaluations += sum.GetNumberOfEvaluations();
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] += result[c];
  }
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
