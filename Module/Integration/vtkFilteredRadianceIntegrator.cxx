// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFilteredRadianceIntegrator.h"

#include "Candidates.h"
#include "DirectionPairs.h"
#include "EnvironmentPrecomputation.h"
#include "EnvironmentPyramid.h"
#include "HalfVector.h" // for Pi
#include "LobeSampler.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ModuleShader.h"
#include "ParallelFor.h"
#include "Printable.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkBRDFEnvironmentFiltered.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkLightSet.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkWeakPointer.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
// Views are denser towards the horizon, where weights change fast: uniform in 1 - sqrt(1 - angle),
// angle in right angles.
double FromAngle(double angle) { return 1.0 - std::sqrt(std::max(1.0 - angle, 0.0)); }

const double LastView = FromAngle(std::acos(MinimumViewCosine) * 2.0 / Pi);

// A Fibonacci lattice (golden ratio), moved off the square's edge. Each point is the one farthest
// from those before it, so that the first ones, too, are spread evenly: they may be drawn alone.
std::vector<glm::dvec2> MakePoints(int count)
{
  std::vector<glm::dvec2> points;
  for (int k = 0; k < count; ++k)
  {
    points.emplace_back((k + 0.5) / count, Wrap01(0.5 + k * GoldenRatio));
  }
  std::vector<double> room(points.size(), 2.0); // squared distance to the nearest one before
  for (std::size_t last = 0; last + 1 < points.size(); ++last)
  {
    std::size_t next = last + 1;
    for (std::size_t k = last + 1; k < points.size(); ++k)
    {
      const glm::dvec2 apart = glm::abs(points[k] - points[last]);
      const glm::dvec2 around = glm::min(apart, 1.0 - apart);
      room[k] = std::min(room[k], glm::dot(around, around));
      next = room[k] > room[next] ? k : next;
    }
    std::swap(points[last + 1], points[next]);
    std::swap(room[last + 1], room[next]);
  }
  return points;
}
}

class ReflectionSamples
{
public:
  // Views that are tabulated, from the normal to MinimumViewCosine.
  static constexpr int NumberOfViews = 128;

  // Density of f cos in its own integral, in 1/sr, at which half of it is sharp. Lights replace a
  // broad part well, as f hardly varies between them; samples alone miss small panels there.
  // Lambert's peak, 1/pi, lies below. Of 0.5, 0.7, 1, 2, 3 and 10, 1 was the best compromise
  // between studios with small panels and smooth skies.
  static constexpr double Floor = 1.0;

  struct Sample
  {
    glm::vec3 Direction; // to the light, where the view's azimuth is 0; not unit in between
    float Level;         // 1/2 log2 of the share of the sphere that it stands for
    glm::vec3 Weight;    // sharp part of f cos / (N pdf), RGB
    float Limit;         // of the view: sum of the channels of f cos at Floor
  };

  // So many samples of the sharp part of f cos (LobeSampler) for each view. brdf is isotropic and
  // prepared. A raised abort leaves the rest black.
  ReflectionSamples(vtkBRDF* brdf, int count, const std::atomic<bool>& abort)
    : Count(count)
    , Samples(static_cast<std::size_t>(count) * NumberOfViews,
        Sample{ glm::vec3(0.0f, 0.0f, 1.0f), 0.0f, glm::vec3(0.0f), 0.0f })
  {
    const std::vector<glm::dvec2> points = MakePoints(count);
    ParallelForEach(
      NumberOfViews, [&](int view) { this->Tabulate(brdf, points, view); }, &abort);
    // Draws that fall below the horizon weigh nothing, but their neighbors fade towards them: these
    // do so where they are.
    for (int k = 0; k < this->Count; ++k)
    {
      for (int view = 1; view < 2 * NumberOfViews; ++view)
      {
        const bool up = view < NumberOfViews;
        const int to = up ? view : 2 * NumberOfViews - 1 - view;
        const int from = std::clamp(up ? to - 1 : to + 1, 0, NumberOfViews - 1);
        Sample& sample = this->Samples[to * this->Count + k];
        const Sample& other = this->Get(from, k);
        if (sample.Weight == glm::vec3(0.0f) && other.Weight != glm::vec3(0.0f))
        {
          sample.Direction = other.Direction;
          sample.Level = other.Level;
        }
      }
    }
  }

  int GetNumberOfSamples() const { return this->Count; }

  // Tabulated sample k of a view.
  const Sample& Get(int view, int k) const { return this->Samples[view * this->Count + k]; }

  // Sample k for unit o.
  Sample Interpolate(const glm::dvec3& o, int k) const
  {
    const double angle = std::atan2(std::hypot(o.x, o.y), o.z) * 2.0 / Pi;
    const double coordinate = FromAngle(angle) / LastView * (NumberOfViews - 1);
    const int view = std::clamp(static_cast<int>(coordinate), 0, NumberOfViews - 2);
    const float t = static_cast<float>(std::min(coordinate - view, 1.0));
    const Sample& a = this->Get(view, k);
    const Sample& b = this->Get(view + 1, k);
    return { a.Direction + t * (b.Direction - a.Direction), a.Level + t * (b.Level - a.Level),
      a.Weight + t * (b.Weight - a.Weight), a.Limit + t * (b.Limit - a.Limit) };
  }

  // Share of f cos (RGB) that the samples have (LobeSampler).
  static double GetSharpShare(const glm::dvec3& f, double limit)
  {
    return LobeSampler::GetSharpShare(f.x + f.y + f.z, limit);
  }

private:
  void Tabulate(vtkBRDF* brdf, const std::vector<glm::dvec2>& points, int view)
  {
    const double rest = 1.0 - LastView * view / (NumberOfViews - 1);
    const double theta = 0.5 * Pi * (1.0 - rest * rest);
    const glm::dvec3 o(std::sin(theta), 0.0, std::cos(theta));
    const LobeSampler lobe(brdf, o, Floor);
    const float limit = static_cast<float>(lobe.GetLimit());
    Sample* sample = &this->Samples[view * this->Count];
    for (const glm::dvec2& point : points)
    {
      double density = 0.0;
      const glm::dvec3 i = lobe.IsBlack() ? glm::dvec3(0.0) : lobe.Sample(point, density);
      sample->Limit = limit;
      if (i.z > 0.0 && density > 0.0)
      {
        density *= this->Count;
        glm::dvec3 f;
        brdf->Evaluate(&i.x, &o.x, &f.x);
        f *= i.z;
        sample->Direction = i;
        sample->Level = static_cast<float>(-0.5 * std::log2(4.0 * Pi * density));
        sample->Weight = f * (GetSharpShare(f, limit) / density);
      }
      ++sample;
    }
  }

  int Count;
  std::vector<Sample> Samples;
};
} // namespace measuredbrdf

using namespace measuredbrdf;

vtkStandardNewMacro(vtkFilteredRadianceIntegrator);

// The samples depend on the material alone and are kept while it stays. All else is of all
// materials.
struct vtkFilteredRadianceIntegrator::Internals
{
  std::unique_ptr<ReflectionSamples> Samples;
  vtkWeakPointer<vtkBRDF> SampledBRDF;
  vtkTimeStamp SamplesTime;
  std::shared_ptr<const EnvironmentPrecomputation::Lamps> Lamps;
  std::shared_ptr<const EnvironmentPyramid> Pyramid; // of the rest, as the lights
  vtkSmartPointer<vtkLightSet> Lights;
};

namespace
{
constexpr int MaximumNumberOfLamps = 64; // that are taken out

constexpr float LargestTexel = 32768.0f; // of 16-bit floats, with room to spare
// A peak over the mean up to which 16-bit floats, which lose digits below 6e-5, hold the dark
// parts.
constexpr double MostContrast = 65536.0;

// Scaled to its peak, whatever the unit of the light is; returns what undoes that.
float AddPyramid(const EnvironmentPyramid& pyramid, vtkBRDFShaderInputs::Term& term)
{
  float peak = 0.0f;
  double sum = 0.0;
  for (const glm::vec4& texel : pyramid.GetAtlas())
  {
    const float value = std::max({ texel.r, texel.g, texel.b });
    peak = std::max(peak, value);
    sum += static_cast<double>(value);
  }
  const float scale = peak > 0.0f ? peak / LargestTexel : 1.0f;
  vtkBRDFShaderInputs::Texture& texture =
    AddTexture(term, "brdfPyramidMap", pyramid.GetAtlasWidth(), pyramid.GetAtlasHeight());
  for (const glm::vec4& texel : pyramid.GetAtlas())
  {
    texture.Data.insert(texture.Data.end(), { texel.r / scale, texel.g / scale, texel.b / scale });
  }
  texture.HalfFloat = static_cast<double>(peak) * static_cast<double>(pyramid.GetAtlas().size()) <=
                      MostContrast * sum;
  return scale;
}

// By sample and view: direction and level, or weight and limit.
template <typename GetTexel>
void AddSamples(const char* name, const ReflectionSamples& samples, const GetTexel& getTexel,
  vtkBRDFShaderInputs::Term& term)
{
  vtkBRDFShaderInputs::Texture& texture =
    AddTexture(term, name, samples.GetNumberOfSamples(), ReflectionSamples::NumberOfViews);
  texture.Components = 4;
  for (int view = 0; view < ReflectionSamples::NumberOfViews; ++view)
  {
    for (int k = 0; k < samples.GetNumberOfSamples(); ++k)
    {
      const glm::vec4 texel = getTexel(samples.Get(view, k));
      texture.Data.insert(texture.Data.end(), { texel.x, texel.y, texel.z, texel.w });
    }
  }
}

// A column per sample: a light's direction, its irradiance below. Missing lights are black.
// Neighbors in the set are neighbors in the sky: steps of the golden ratio spread them, so that the
// first columns, which may be drawn alone, have some from everywhere.
void AddLights(vtkLightSet* lights, int count, vtkBRDFShaderInputs::Term& term)
{
  vtkBRDFShaderInputs::Texture& texture = AddTexture(term, "brdfLights", count, 2);
  texture.Data.resize(6 * count, 0.0f);
  std::vector<std::pair<double, int>> columns;
  for (int k = 0; k < lights->GetNumberOfLights(); ++k)
  {
    columns.emplace_back(Wrap01(k * GoldenRatio), k);
  }
  std::sort(columns.begin(), columns.end());
  for (std::size_t column = 0; column < columns.size(); ++column)
  {
    double direction[3], irradiance[3];
    lights->GetDirection(columns[column].second, direction);
    lights->GetIrradiance(columns[column].second, irradiance);
    std::copy_n(direction, 3, &texture.Data[3 * column]);
    std::copy_n(irradiance, 3, &texture.Data[3 * (count + column)]);
  }
}
}

//------------------------------------------------------------------------------
vtkFilteredRadianceIntegrator::vtkFilteredRadianceIntegrator()
  : Impl(new Internals)
{
}

//------------------------------------------------------------------------------
vtkFilteredRadianceIntegrator::~vtkFilteredRadianceIntegrator() = default;

//------------------------------------------------------------------------------
int vtkFilteredRadianceIntegrator::GetNumberOfExtractedLights()
{
  return this->Impl->Lamps ? static_cast<int>(this->Impl->Lamps->Lights.size()) : 0;
}

//------------------------------------------------------------------------------
bool vtkFilteredRadianceIntegrator::Begin()
{
  if (!this->HasLight() || !this->IsIsotropic("filtered samples"))
  {
    return false;
  }
  Internals& impl = *this->Impl;
  if (!impl.Samples || impl.SampledBRDF.GetPointer() != this->BRDF.Get() ||
      impl.SamplesTime < this->BRDF->GetMTime() ||
      impl.Samples->GetNumberOfSamples() != this->NumberOfSamples)
  {
    auto samples =
      std::make_unique<ReflectionSamples>(this->BRDF, this->NumberOfSamples, this->Abort);
    if (this->Abort)
    {
      vtkErrorMacro("Integrate: aborted.");
      return false;
    }
    impl.Samples = std::move(samples);
    impl.SampledBRDF = this->BRDF.Get();
    impl.SamplesTime.Modified();
  }
  EnvironmentPrecomputation& parts = this->Environment->GetParts();
  const auto goOn = [this]() { return this->Report(0.0); };
  const auto lamps = parts.GetExtractedEmitters(
    this->Environment, ExtractedEmitters::DefaultShare, MaximumNumberOfLamps, goOn);
  const auto pyramid = lamps ? parts.GetPyramid(this->Environment, lamps->Rest, goOn) : nullptr;
  const auto lights =
    pyramid ? parts.GetLightSet(this->Environment, lamps->Rest, this->NumberOfSamples, goOn)
            : nullptr;
  if (!lights)
  {
    vtkErrorMacro("Integrate: aborted.");
    return false;
  }
  impl.Lamps = lamps;
  impl.Pyramid = pyramid;
  impl.Lights = lights;
  return true;
}

//------------------------------------------------------------------------------
void vtkFilteredRadianceIntegrator::IntegratePair(
  const double n[3], const double o[3], const double t[3], double radiance[3])
{
  const Frame frame = FrameAbout(glm::make_vec3(n), glm::make_vec3(t));
  const glm::dvec3 view = LiftView(ToLocal(frame, glm::make_vec3(o)));
  const double s = std::hypot(view.x, view.y);
  const glm::dvec2 a = s > 1e-6 ? glm::dvec2(view) / s : glm::dvec2(1.0, 0.0);
  const Frame turned(frame * glm::dvec3(a, 0.0), frame * glm::dvec3(-a.y, a.x, 0.0), frame[2]);

  const Internals& impl = *this->Impl;
  const float level = impl.Pyramid->GetLevel(4.0 * Pi);
  const auto reflect = [&](const glm::dvec3& direction) // f cos
  {
    const glm::dvec3 i = ToLocal(frame, direction);
    glm::dvec3 f(0.0);
    if (i.z > 0.0)
    {
      this->BRDF->Evaluate(&i.x, &view.x, &f.x);
    }
    return i.z * f;
  };
  glm::dvec3 sum(0.0);
  for (int k = 0; k < impl.Samples->GetNumberOfSamples(); ++k)
  {
    const ReflectionSamples::Sample sample = impl.Samples->Interpolate(view, k);
    const glm::dvec3 d = turned * glm::normalize(glm::dvec3(sample.Direction));
    sum += glm::dvec3(sample.Weight * impl.Pyramid->Sample(d, sample.Level + level));
    if (k < impl.Lights->GetNumberOfLights())
    {
      glm::dvec3 light, irradiance;
      impl.Lights->GetDirection(k, &light.x);
      impl.Lights->GetIrradiance(k, &irradiance.x);
      const glm::dvec3 f = reflect(light);
      sum += f * (1.0 - ReflectionSamples::GetSharpShare(f, sample.Limit)) * irradiance;
    }
  }
  for (const ExtractedEmitters::Light& lamp : impl.Lamps->Lights)
  {
    sum += reflect(lamp.Direction) * lamp.Irradiance;
  }
  AddRGB(sum, radiance);
}

//------------------------------------------------------------------------------
bool vtkFilteredRadianceIntegrator::GetShaderInputs(vtkBRDFShaderInputs& inputs)
{
  if (!this->Prepare())
  {
    return false;
  }
  const EnvironmentPyramid& pyramid = *this->Impl->Pyramid;
  const ReflectionSamples& samples = *this->Impl->Samples;
  const int count = samples.GetNumberOfSamples();
  vtkBRDFShaderInputs::Term term;
  SetModuleShader(term, "vtkBRDFEnvironmentFiltered", vtkBRDFEnvironmentFiltered);
  term.Uniforms.push_back({ "brdfLevel", { pyramid.GetLevel(4.0 * Pi) } });
  term.Fetches = 6 * count; // direction and level, weight, two levels of the map, a light's two
  term.Evaluations = count;
  const float scale = AddPyramid(pyramid, term);
  const bool half = term.Textures.back().HalfFloat;
  AddSamples(
    "brdfDirections", samples,
    [](const ReflectionSamples::Sample& sample)
    { return glm::vec4(sample.Direction, sample.Level); },
    term);
  AddSamples(
    "brdfWeights", samples,
    [scale](const ReflectionSamples::Sample& sample)
    { return glm::vec4(scale * sample.Weight, sample.Limit); },
    term);
  AddLights(this->Impl->Lights, count, term);

  vtkBRDFShaderInputs result;
  if (this->Impl->Lamps->Set)
  {
    vtkNew<vtkLightSetRadianceIntegrator> loop;
    loop->SetBRDF(this->BRDF);
    loop->SetLightSet(this->Impl->Lamps->Set);
    loop->GetShaderInputs(result);
  }
  result.Terms.insert(result.Terms.begin(), std::move(term));
  result.QuantizationError = half ? 0x1p-11 : 0x1p-23;
  result.Description =
    std::to_string(count) + " samples of a map of " + std::to_string(pyramid.GetSize()) + " x " +
    std::to_string(pyramid.GetSize()) + " texels (" + (half ? "16" : "32") + "-bit), " +
    std::to_string(this->GetNumberOfExtractedLights()) + " directional lights";
  inputs = std::move(result);
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkFilteredRadianceIntegrator, NumberOfSamples, int, 1, 1024);

//------------------------------------------------------------------------------
std::string vtkFilteredRadianceIntegrator::GetMethodDescription()
{
  return "samples of the environment, blurred to their spacing, and as many lights";
}

//------------------------------------------------------------------------------
std::vector<vtkRadianceIntegrator::Size> vtkFilteredRadianceIntegrator::GetSizes()
{
  return { { "samples", 1, 1024, this->NumberOfSamples,
    [this](int value) { this->SetNumberOfSamples(value); } } };
}

//------------------------------------------------------------------------------
std::vector<std::vector<int>> vtkFilteredRadianceIntegrator::GetCandidateSizes(bool)
{
  return this->BRDF->IsIsotropic() ? std::vector<std::vector<int>>{ { 16 }, { 64 }, { 256 } }
                                   : std::vector<std::vector<int>>();
}

//------------------------------------------------------------------------------
double vtkFilteredRadianceIntegrator::EstimateCost()
{
  return PixelCosts::Pixel + (PixelCosts::Sample + PixelCosts::Light) * this->NumberOfSamples +
         PixelCosts::Light * this->GetNumberOfExtractedLights();
}

//------------------------------------------------------------------------------
vtkIdType vtkFilteredRadianceIntegrator::EstimateTextureBytes()
{
  // Two RGBA tables by sample and view, and the lights.
  constexpr vtkIdType sample = 2 * 16 * ReflectionSamples::NumberOfViews + 2 * 12;
  return this->Environment
           ? EnvironmentPyramid::EstimateBytes(this->Environment) + sample * this->NumberOfSamples +
               32 * this->GetNumberOfExtractedLights()
           : 0;
}

//------------------------------------------------------------------------------
void vtkFilteredRadianceIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Extracted lights: " << this->GetNumberOfExtractedLights() << "\n";
}
