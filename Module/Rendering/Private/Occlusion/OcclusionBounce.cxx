// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionBounce.h"

#include "BouncedLight.h"
#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "UniformVectors.h"
#include "vtkBRDFBouncedLight.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr double LeastHidden = 1e-3;
}

OcclusionBounce::OcclusionBounce(const std::vector<glm::dvec3>& lambert,
  const std::vector<glm::dvec3>& lobe, const sky::Colors& light)
  : Lambert(lambert)
  , Lobe(lobe)
  , Albedo(0.0)
  , Light(light)
{
  // The mean of directional albedos, views weighted by their cosine and solid angle.
  double all = 0.0;
  for (std::size_t k = 0; k < Views; ++k)
  {
    const double theta = std::acos(MinimumViewCosine) * static_cast<double>(k) / (Views - 1);
    const double weight = std::sin(2.0 * theta);
    this->Albedo += weight * (Pi * lambert[k] + lobe[k]);
    all += weight;
  }
  this->Albedo = glm::clamp(this->Albedo / all, 0.0, 1.0);
}

glm::dvec3 OcclusionBounce::GetRadiance(const glm::dvec3& irradiance, const glm::dvec3& lambert,
  const glm::dvec3& lobe, double share, double hidden)
{
  return irradiance * (lambert + lobe * (share / (Pi * std::max(hidden, LeastHidden))));
}

std::string OcclusionBounce::Declare(bool twoSided)
{
  return std::string("in vec3 brdfBounce;\n") + (twoSided ? "in vec3 brdfBounceBack;\n" : "") +
         vtkBRDFBouncedLight;
}

std::string OcclusionBounce::DeclareMember(std::size_t member)
{
  const std::string m = std::to_string(member);
  const std::string views = "[" + std::to_string(Views) + "];\n";
  return "uniform vec3 brdfBouncedLight" + m + "[" + std::to_string(BouncedLight::Harmonics) +
         "];\nuniform vec3 brdfBouncedLambert" + m + views + "uniform vec3 brdfBouncedLobe" + m +
         views;
}

std::string OcclusionBounce::MakeMemberCode(
  std::size_t member, const std::string& side, const std::string& share)
{
  const std::string m = std::to_string(member);
  const auto atView = [&m](const std::string& name)
  { return "mix(" + name + m + "[brdfSkyKnot], " + name + m + "[brdfSkyKnot + 1], brdfSkyView)"; };
  return "  brdfBounced" + side + m +
         "VSOutput = brdfBouncedRadiance(brdfBouncedIrradiance(brdfBounce" + side +
         ", brdfBouncedLight" + m + "),\n    " + atView("brdfBouncedLambert") + ", " +
         atView("brdfBouncedLobe") + ", " + share + ", brdfSkyHidden);\n";
}

void OcclusionBounce::SetUniforms(
  vtkShaderProgram* program, std::size_t member, const glm::dmat3& toEnvironment) const
{
  const std::string m = std::to_string(member);
  const sky::Colors turned = sky::Rotate(this->Light, toEnvironment);
  const double root = BouncedLight::RootStep * BouncedLight::RootStep;
  std::vector<glm::dvec3> light;
  for (std::size_t j = 0; j < BouncedLight::Harmonics; ++j)
  {
    light.push_back(this->Albedo * turned[j] * (j == 0 ? root : root * BouncedLight::RatioStep));
  }
  SetVectors(program, "brdfBouncedLight" + m, light);
  SetVectors(program, "brdfBouncedLambert" + m, this->Lambert);
  SetVectors(program, "brdfBouncedLobe" + m, this->Lobe);
}
} // namespace measuredbrdf
