// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExactRadianceIntegrator.h"

#include "DirectionPairs.h"
#include "LocalFrame.h"
#include "TexelTree.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace
{
// Texels a thread sums at a stretch: some tenths of a millisecond.
constexpr std::size_t TexelsPerPart = 8192;
constexpr std::size_t ValuesPerTexel = 6;
} // namespace

vtkStandardNewMacro(vtkExactRadianceIntegrator);

//------------------------------------------------------------------------------
bool vtkExactRadianceIntegrator::Begin()
{
  if (!this->HasLight())
  {
    return false;
  }
  vtkEnvironment* environment = this->Environment->GetSubdivided();
  const measuredbrdf::TexelDirections directions(environment->GetWidth(), environment->GetHeight());
  this->Texels.clear();
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      if (rgb[0] > 0.0 || rgb[1] > 0.0 || rgb[2] > 0.0)
      {
        const glm::dvec3 d = directions.Get(x, y);
        this->Texels.insert(this->Texels.end(),
          { d.x, d.y, d.z, rgb[0] * solidAngle, rgb[1] * solidAngle, rgb[2] * solidAngle });
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkExactRadianceIntegrator::GetNumberOfParts()
{
  const std::size_t texels = this->Texels.size() / ValuesPerTexel;
  return static_cast<int>((texels + TexelsPerPart - 1) / TexelsPerPart);
}

//------------------------------------------------------------------------------
void vtkExactRadianceIntegrator::IntegratePart(
  int part, const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = measuredbrdf::ToLocal(frame, glm::make_vec3(o));
  const std::size_t first = static_cast<std::size_t>(part) * TexelsPerPart * ValuesPerTexel;
  const std::size_t last = std::min(first + TexelsPerPart * ValuesPerTexel, this->Texels.size());
  glm::dvec3 sum(0.0);
  for (std::size_t k = first; k < last; k += ValuesPerTexel)
  {
    const glm::dvec3 direction = glm::make_vec3(&this->Texels[k]);
    const double cosine = glm::dot(frame[2], direction);
    if (cosine > 0.0)
    {
      const glm::dvec3 light = measuredbrdf::ToLocal(frame, direction);
      glm::dvec3 f;
      this->BRDF->Evaluate(&light.x, &view.x, &f.x);
      sum += cosine * f * glm::make_vec3(&this->Texels[k + 3]);
    }
  }
  measuredbrdf::AddRGB(sum, radiance);
}

//------------------------------------------------------------------------------
void vtkExactRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Texels that are not black: " << this->Texels.size() / ValuesPerTexel << "\n";
}
