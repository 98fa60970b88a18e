// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Stability.h"

#include "LocalFrame.h"
#include "Methods.h"
#include "Surface.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"
#include "vtkRadiancePlanner.h"
#include "vtkSumBRDF.h"
#include "vtkTableRadianceIntegrator.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tool::stability
{
namespace
{
//------------------------------------------------------------------------------
template <typename T>
vtkSmartPointer<T> MakeFor(vtkBRDF* brdf, vtkEnvironment* environment)
{
  auto integrator = vtkSmartPointer<T>::New();
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  return integrator;
}

//------------------------------------------------------------------------------
Integrator Plan(vtkBRDF* brdf, vtkEnvironment* environment)
{
  const auto planner = MakeFor<vtkRadiancePlanner>(brdf, environment);
  if (!planner->Update())
  {
    throw Error("planning: " + TakeErrorText());
  }
  return Integrator::Take(planner->NewIntegrator());
}

//------------------------------------------------------------------------------
Make MakeLights(const std::string& method, int count = 64, bool soft = false)
{
  return [=](vtkBRDF* brdf, vtkEnvironment* environment)
  { return MakeLightLoop(brdf, environment, method, count, soft); };
}

//------------------------------------------------------------------------------
Radiance ToArray(const std::vector<double>& values)
{
  return Eigen::Map<const Radiance>(values.data(), static_cast<Eigen::Index>(values.size()));
}
}

//------------------------------------------------------------------------------
std::string Finding::GetStatus() const
{
  if (!std::isfinite(this->Value) || this->Value > this->Bound)
  {
    return "fail";
  }
  return this->Value <= this->Threshold ? "pass" : "known limit";
}

//------------------------------------------------------------------------------
Environment Context::MakeLight(const std::string& otherwise, int width) const
{
  return Shrink(this->Light ? this->Light : LoadEnvironment(otherwise), width);
}

//------------------------------------------------------------------------------
void Context::Add(const std::string& method, const std::string& figure, double value,
  const Limits& limits, const std::string& note)
{
  const auto known = limits.Known.find(method);
  const double bound = known == limits.Known.end() ? limits.Threshold : known->second;
  Finding finding = { method, figure, value, limits.Threshold, bound, note };
  if (finding.GetStatus() == "known limit")
  {
    finding.Note += (note.empty() ? "" : "; ") + limits.Why;
  }
  this->Findings.push_back(finding);
}

//------------------------------------------------------------------------------
const std::vector<std::pair<std::string, Make>>& GetMethods()
{
  static const std::vector<std::pair<std::string, Make>> methods = []()
  {
    std::vector<std::pair<std::string, Make>> made = {
      { "median-cut", MakeLights("median-cut") },
      { "importance", MakeLights("importance") },
      { "variance", MakeLights("variance") },
      { "thesis",
        [](vtkBRDF* brdf, vtkEnvironment* environment)
        {
          return MakeLightLoop(
            Project(brdf, vtkBasisBRDF::SPHERICAL_HARMONICS, 6), environment, "median-cut", 64);
        } },
      { "soft-lights", MakeLights("variance", 256, true) }, // as planned where anisotropic
      { "filtered", [](vtkBRDF* brdf, vtkEnvironment* environment)
        { return MakeFiltered(brdf, environment, 16); } }, // the planner's number
      { "table", [](vtkBRDF* brdf, vtkEnvironment* environment)
        { return MakeTable(brdf, environment, 65, 12, 16); } },
      { "auto", Plan },
    };
    for (const auto& method : vtkRadianceMethods::GetMethods())
    {
      const std::string name = method->GetMethodName();
      if (!IsOnCpuOnly(name) && name != "light-set" && name != "filtered" && name != "table")
      {
        made.emplace_back(name,
          [method](vtkBRDF* brdf, vtkEnvironment* environment)
          {
            const auto copy = Integrator::Take(method->NewCopy());
            copy->SetBRDF(brdf);
            copy->SetEnvironment(environment);
            return copy;
          });
      }
    }
    return made;
  }();
  return methods;
}

//------------------------------------------------------------------------------
Integrator MakeLightLoop(vtkBRDF* brdf, vtkEnvironment* environment, const std::string& method,
  int count, bool soft, int seed)
{
  const LightSetOptions options{ count, method, static_cast<unsigned int>(seed) };
  const auto integrator = MakeFor<vtkLightSetRadianceIntegrator>(brdf, environment);
  integrator->SetLightSet(MakeLightSet(environment, options));
  integrator->SetSoftLights(soft);
  return integrator;
}

//------------------------------------------------------------------------------
Integrator MakeTable(
  vtkBRDF* brdf, vtkEnvironment* environment, int rows, int viewAngles, int azimuths)
{
  const auto integrator = MakeFor<vtkTableRadianceIntegrator>(brdf, environment);
  integrator->SetNumberOfRows(rows);
  integrator->SetNumberOfViewAngles(viewAngles);
  integrator->SetNumberOfAzimuths(azimuths);
  return integrator;
}

//------------------------------------------------------------------------------
Integrator MakeFiltered(vtkBRDF* brdf, vtkEnvironment* environment, int samples)
{
  const auto integrator = MakeFor<vtkFilteredRadianceIntegrator>(brdf, environment);
  integrator->SetNumberOfSamples(samples);
  return integrator;
}

//------------------------------------------------------------------------------
BRDF MakePlastic(double exponent)
{
  const auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(MakeLambert(0.3));
  sum->AddTerm(MakeLobe(exponent));
  return sum;
}

//------------------------------------------------------------------------------
BRDF MakeLobe(double exponent)
{
  const auto lobe = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  lobe->SetExponent(exponent);
  return lobe;
}

//------------------------------------------------------------------------------
BRDF MakeLambert(double albedo)
{
  const auto lambert = vtkSmartPointer<vtkLambertBRDF>::New();
  lambert->SetAlbedo(albedo, albedo, albedo);
  return lambert;
}

//------------------------------------------------------------------------------
BRDF Project(vtkBRDF* brdf, int basis, int order)
{
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(brdf);
  projector->SetBasis(basis);
  projector->SetOrder(order);
  if (!projector->Project())
  {
    throw Error("projection: " + TakeErrorText());
  }
  return projector->GetOutput();
}

//------------------------------------------------------------------------------
Environment MakeEnvironment(
  int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance)
{
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 direction;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, &direction.x);
      const glm::vec3 rgb(radiance(direction));
      pixels.insert(pixels.end(), { rgb.r, rgb.g, rgb.b });
    }
  }
  auto environment = Environment::New();
  environment->SetPixels(width, height, std::move(pixels));
  return environment;
}

//------------------------------------------------------------------------------
Environment Shrink(vtkEnvironment* environment, int width)
{
  const int columns = environment->GetWidth();
  const int rows = environment->GetHeight();
  const int height = std::max(width / 2, 1);
  if (columns <= width || rows <= height)
  {
    return environment;
  }
  // A block covers texels of about one solid angle, so that their plain mean is its radiance.
  return MakeEnvironment(width, height,
    [&](const glm::dvec3& direction)
    {
      double u = 0.0;
      double v = 0.0;
      vtkEnvironment::GetCoordinates(&direction.x, u, v);
      const int x0 = static_cast<int>(u * width) * columns / width;
      const int y0 = static_cast<int>(v * height) * rows / height;
      glm::dvec3 sum(0.0);
      double weight = 0.0;
      for (int y = y0; y < y0 + rows / height; ++y)
      {
        for (int x = x0; x < x0 + columns / width; ++x)
        {
          glm::dvec3 rgb;
          environment->GetPixel(x, y, &rgb.x);
          sum += environment->GetTexelSolidAngle(y) * rgb;
          weight += environment->GetTexelSolidAngle(y);
        }
      }
      return sum / weight;
    });
}

//------------------------------------------------------------------------------
Environment Roll(vtkEnvironment* environment, double columns)
{
  const Backdrop map(environment);
  const int width = environment->GetWidth();
  return MakeEnvironment(width, environment->GetHeight(),
    [&](const glm::dvec3& direction)
    {
      double u = 0.0;
      double v = 0.0;
      vtkEnvironment::GetCoordinates(&direction.x, u, v);
      u -= columns / width;
      glm::dvec3 from;
      vtkEnvironment::GetDirection(u - std::floor(u), v, &from.x);
      return map.Look(from);
    });
}

//------------------------------------------------------------------------------
glm::dvec3 GetSmoothRadiance(const glm::dvec3& d)
{
  return { 1.0 + 0.6 * d.y + 0.3 * d.x * d.z, 1.0 + 0.5 * d.x, 1.0 + 0.4 * d.y * d.z };
}

//------------------------------------------------------------------------------
void Pairs::Add(const glm::dvec3& normal, const glm::dvec3& view)
{
  this->Normals.insert(this->Normals.end(), { normal.x, normal.y, normal.z });
  this->Views.insert(this->Views.end(), { view.x, view.y, view.z });
}

//------------------------------------------------------------------------------
Pairs MakeSpherePairs(int count)
{
  const double azimuth = glm::radians(30.0);
  const double elevation = glm::radians(20.0);
  const glm::dvec3 view(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
    std::cos(elevation) * std::cos(azimuth));
  const measuredbrdf::Frame frame = measuredbrdf::FrameAbout(view);
  Pairs pairs;
  for (int k = 0; k < count; ++k)
  {
    // Sunflower seeds: evenly over the disc, within the rim by a pixel of 500.
    const double r = 0.996 * std::sqrt((k + 0.5) / count);
    const double phi = glm::pi<double>() * (3.0 - std::sqrt(5.0)) * k;
    pairs.Add(frame * measuredbrdf::ToDirection(std::sqrt(1.0 - r * r), phi), view);
  }
  return pairs;
}

//------------------------------------------------------------------------------
Pairs Move(const Pairs& pairs, const std::function<void(glm::dvec3&, glm::dvec3&)>& move)
{
  Pairs moved;
  for (std::size_t k = 0; k < pairs.Normals.size(); k += 3)
  {
    glm::dvec3 normal = glm::make_vec3(&pairs.Normals[k]);
    glm::dvec3 view = glm::make_vec3(&pairs.Views[k]);
    move(normal, view);
    moved.Add(normal, view);
  }
  return moved;
}

//------------------------------------------------------------------------------
Radiance Integrate(vtkRadianceIntegrator* integrator, const Pairs& pairs)
{
  return ToArray(IntegratePairs(integrator, pairs.Normals, pairs.Views));
}

//------------------------------------------------------------------------------
Radiance IntegrateReference(vtkBRDF* brdf, vtkEnvironment* environment, const Pairs& pairs)
{
  const auto reference = MakeFor<vtkAdaptiveRadianceIntegrator>(brdf, environment);
  reference->SetTolerance(2e-4); // slopes of errors need it
  return Integrate(reference, pairs);
}

//------------------------------------------------------------------------------
Radiance Draw(vtkRadianceIntegrator* integrator, const Pairs& pairs)
{
  return ToArray(DrawPairs(integrator, pairs.Normals, pairs.Views));
}

//------------------------------------------------------------------------------
double GetRelativeL1(const Radiance& x, const Radiance& reference)
{
  const double difference = (x - reference).abs().sum();
  return difference == 0.0 ? 0.0 : difference / reference.sum();
}

//------------------------------------------------------------------------------
double CountBad(const Radiance& x)
{
  return static_cast<double>(x.size() - (x.isFinite() && x >= 0.0).count());
}

//------------------------------------------------------------------------------
void AddErrors(Context& context, const std::string& figure, vtkBRDF* brdf,
  vtkEnvironment* environment, const Pairs& pairs, const Limits& limits)
{
  const Radiance reference = IntegrateReference(brdf, environment, pairs);
  for (const auto& [name, make] : GetMethods())
  {
    context.Add(
      name, figure, GetRelativeL1(Integrate(make(brdf, environment), pairs), reference), limits);
  }
}

//------------------------------------------------------------------------------
std::string Say(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}
} // namespace tool::stability
