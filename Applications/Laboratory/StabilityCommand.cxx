// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Known ways to fail: each case provokes one and measures what every method makes of it. What is
// particular to a case's materials and light stands in its function; thresholds stand beside the
// figures that they judge.
#include "Files.h"
#include "Inputs.h"
#include "JsonReport.h"
#include "Laboratory.h"
#include "LocalFrame.h"
#include "Meshes.h"
#include "Methods.h"
#include "Picture.h"
#include "Program.h"
#include "Progress.h"
#include "Scenes.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkLobeBRDFFitter.h"
#include "vtkNew.h"
#include "vtkRadianceMethods.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <CLI/CLI.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <set>

namespace
{
using namespace laboratory;
using BRDF = vtkSmartPointer<vtkBRDF>;
using Integrator = vtkSmartPointer<vtkRadianceIntegrator>;
using Json = nlohmann::ordered_json;

constexpr double LargestNegativeMass = 0.05; // that an extrapolation may have
constexpr int ErrorPairs = 1 << 14;

//------------------------------------------------------------------------------
std::string Say(double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

//------------------------------------------------------------------------------
// 0.3 Lambert + 0.1 Blinn-Phong of an exponent; the lobe alone; Lambert alone.
BRDF MakeLobe(double exponent)
{
  const auto lobe = vtkSmartPointer<vtkBlinnPhongBRDF>::New();
  lobe->SetExponent(exponent);
  return lobe;
}

BRDF MakeMatte(double albedo)
{
  const auto lambert = vtkSmartPointer<vtkLambertBRDF>::New();
  lambert->SetAlbedo(albedo, albedo, albedo);
  return lambert;
}

BRDF MakePlastic(double exponent)
{
  const auto sum = vtkSmartPointer<vtkSumBRDF>::New();
  sum->AddTerm(MakeMatte(0.3));
  sum->AddTerm(MakeLobe(exponent));
  return sum;
}

//------------------------------------------------------------------------------
// A gray sky that varies slowly, without anything small in it.
glm::dvec3 GetSmoothRadiance(const glm::dvec3& d)
{
  return { 1.0 + 0.6 * d.y + 0.3 * d.x * d.z, 1.0 + 0.5 * d.x, 1.0 + 0.4 * d.y * d.z };
}

//------------------------------------------------------------------------------
// Each pair of normal and view made another one.
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
tool::MethodOptions UseLights(const std::string& set, int count = 64, bool soft = false)
{
  tool::MethodOptions options;
  options.Method = "light-set";
  options.Lights = { count, set, 1, soft };
  return options;
}

tool::MethodOptions UseSizes(const std::string& method, const std::string& sizes)
{
  tool::MethodOptions options;
  options.Method = method;
  options.Sizes = sizes;
  return options;
}

//------------------------------------------------------------------------------
Integrator MakeBy(const tool::MethodOptions& options, vtkBRDF* brdf, vtkEnvironment* environment)
{
  tool::Material material;
  material.BRDF = brdf;
  return tool::MakeIntegrator(options, material, environment);
}

/// A way to integrate an environment's light.
using Make = std::function<Integrator(vtkBRDF*, vtkEnvironment*)>;

//------------------------------------------------------------------------------
// All of them by name, each at the size that it is mostly used with; the thesis's is median cut
// over the material in harmonics of order 6.
const std::vector<std::pair<std::string, Make>>& GetMethods()
{
  static const std::vector<std::pair<std::string, Make>> methods = []()
  {
    std::vector<std::pair<std::string, Make>> made;
    const auto add = [&made](const std::string& name, const tool::MethodOptions& options)
    {
      made.emplace_back(name, [options](vtkBRDF* brdf, vtkEnvironment* environment)
        { return MakeBy(options, brdf, environment); });
    };
    for (const char* set : { "median-cut", "importance", "variance" })
    {
      add(set, UseLights(set));
    }
    made.emplace_back("thesis",
      [](vtkBRDF* brdf, vtkEnvironment* environment)
      {
        const BRDF projected =
          ProjectOnto(brdf, vtkBasisBRDF::SPHERICAL_HARMONICS, 6, tool::DeviceZone, "thesis");
        return MakeBy(UseLights("median-cut"), projected, environment);
      });
    add("soft-lights", UseLights("variance", 256, true)); // as planned where anisotropic
    add("filtered", UseSizes("filtered", "16"));          // the planner's number
    add("table", UseSizes("table", "65,12,16"));
    add("auto", UseSizes("auto", ""));
    for (const auto& method : vtkRadianceMethods::GetMethods())
    {
      const std::string name = method->GetMethodName();
      if (!tool::IsOnCpuOnly(name) && name != "light-set" && name != "filtered" && name != "table")
      {
        add(name, UseSizes(name, ""));
      }
    }
    return made;
  }();
  return methods;
}

/// The threshold of a figure: one for all methods, and how far some are known to miss it.
struct Limits
{
  double Threshold;
  std::map<std::string, double> Known = {}; // method -> bound
  std::string Why = "";                     // they miss it
};

/// What cases are given and what they find.
struct Context
{
  /// The user's material or else a plastic.
  BRDF ChoosePlastic(double exponent) const
  {
    return this->Material ? this->Material : MakePlastic(exponent);
  }

  /// The user's environment, else "sky" or "hall", averaged down to width x width / 2.
  Environment MakeLight(const std::string& otherwise, int width) const
  {
    return Shrink(this->Light ? this->Light : tool::LoadEnvironment(otherwise), width);
  }

  int Pick(int whenShort, int whenLong) const { return this->Short ? whenShort : whenLong; }

  /// A figure passes at or below its threshold, is a known limit up to its bound, and fails beyond
  /// that or where it is not finite.
  void Add(const std::string& method, const std::string& figure, double value, const Limits& limits,
    std::string note = "")
  {
    const auto known = limits.Known.find(method);
    const double bound = known == limits.Known.end() ? limits.Threshold : known->second;
    const std::string status = !std::isfinite(value) || value > bound ? "fail"
                               : value <= limits.Threshold            ? "pass"
                                                                      : "known limit";
    note += status == "known limit" ? (note.empty() ? "" : "; ") + limits.Why : "";
    this->Findings.push_back({ { "method", method }, { "figure", figure }, { "value", value },
      { "threshold", limits.Threshold }, { "known_limit", bound != limits.Threshold },
      { "bound", bound }, { "status", status }, { "note", note } });
  }

  /// A figure of each method.
  void AddEach(const std::string& figure, const Limits& limits,
    const std::function<double(const Make& make)>& measure)
  {
    for (const auto& [name, make] : GetMethods())
    {
      this->Add(name, figure, measure(make), limits);
    }
  }

  /// Relative L1 errors of all methods for the pairs.
  void AddErrors(const std::string& figure, vtkBRDF* brdf, vtkEnvironment* environment,
    const Pairs& pairs, const Limits& limits)
  {
    const Radiance reference = IntegrateReference(brdf, environment, pairs);
    this->AddEach(figure, limits,
      [&](const Make& make)
      { return GetRelativeL1(Integrate(make(brdf, environment), pairs), reference); });
  }

  BRDF Material;     // the user's, or null
  Environment Light; // the user's, or null
  bool Short = false;
  Json Findings = Json::array();
};

//------------------------------------------------------------------------------
std::string Name(int basis, int order)
{
  static const char* const names[] = { "harmonics", "hemispherical", "zonal", "Leg.xFourier" };
  return std::string(names[basis]) + " " + std::to_string(order);
}

//------------------------------------------------------------------------------
void RunRinging(Context& context)
{
  for (const double exponent : { 5.0, 20.0, 100.0 })
  {
    const BRDF lobe = MakeLobe(exponent);
    for (int basis = 0; basis < 4; ++basis)
    {
      for (const int order : context.Short ? std::vector<int>{ 6 } : std::vector<int>{ 2, 6, 12 })
      {
        const auto projected = ProjectOnto(lobe, basis, order, AllAngles, "lobe");
        context.Add(Name(basis, order), "negative mass before the clamp, exponent " + Say(exponent),
          projected->GetNegativeMass(AllAngles, AllAngles, ErrorPairs),
          { LargestNegativeMass, { { Name(basis, order), 0.5 } }, "order too low for the lobe" },
          "relative L2 error " +
            Say(vtkBRDFResampler::GetRelativeL2Error(lobe, projected, ErrorPairs)));
      }
    }
    // The tool's answer: the advice takes a fit where a basis would ring.
    const tool::Advice advice = tool::Advise(lobe, 6);
    context.Add("advisor", "a ringing basis recommended, exponent " + Say(exponent),
      advice.IsBasis && advice.NegativeMass > LargestNegativeMass, { 0.0 }, advice.Reason);
  }
}

//------------------------------------------------------------------------------
// Functions of an azimuth must vanish where it means nothing: along the normal.
void RunZenith(Context& context)
{
  const BRDF lobe = context.ChoosePlastic(50.0);
  for (int basis = 0; basis < 4; ++basis)
  {
    const BRDF projected = ProjectOnto(lobe, basis, 6, AllAngles, "lobe");
    double worst = 0.0;
    for (const double degrees : { 10.0, 30.0, 60.0 })
    {
      const glm::dvec3 o = measuredbrdf::ToDirection(std::cos(glm::radians(degrees)), 0.0);
      Eigen::Array<double, 16, 1> values;
      for (int k = 0; k < 16; ++k)
      {
        const glm::dvec3 i =
          measuredbrdf::ToDirection(1.0 - 5e-9, glm::two_pi<double>() * k / 16.0);
        glm::dvec3 f;
        projected->Evaluate(&i.x, &o.x, &f.x);
        values[k] = f.x;
      }
      worst = std::max(worst, (values.maxCoeff() - values.minCoeff()) / values.maxCoeff());
    }
    context.Add(Name(basis, 6), "jump where light passes along the normal, relative", worst,
      { 0.01, { { Name(vtkBasisBRDF::LEGENDRE_FOURIER, 6), 1.0 } },
        "Legendre x Fourier does not vanish at a zone's edges, nor at the zenith" });
  }
}

//------------------------------------------------------------------------------
// Texels of a smooth sky made much brighter.
Environment MakeSkyWith(int width, float radiance, const std::vector<std::size_t>& texels)
{
  const Environment sky = MakeEnvironment(width, width / 2, GetSmoothRadiance);
  std::vector<float> pixels = sky->GetPixels();
  for (const std::size_t texel : texels)
  {
    std::fill_n(&pixels[3 * texel], 3, radiance);
  }
  sky->SetPixels(width, width / 2, std::move(pixels));
  return sky;
}

//------------------------------------------------------------------------------
// 2e5 times the mean is what photographs of the sky hold.
void RunSun(Context& context)
{
  const int width = context.Pick(64, 256);
  const Environment sky =
    MakeSkyWith(width, 2e5f, { static_cast<std::size_t>(width * (width * 3 / 8) + width * 2 / 3) });
  const Pairs pairs = MakeSpherePairs(context.Pick(80, 300));
  const Limits limits = { 0.05, { { "thesis", 0.15 } }, "the basis rings under one light" };
  context.AddErrors("error, Lambert", MakeMatte(0.5), sky, pairs, limits);
  context.AddErrors("error, plastic, exponent 50", MakePlastic(50.0), sky, pairs, limits);
}

//------------------------------------------------------------------------------
void RunDots(Context& context)
{
  const std::string tooFew = "too few lights, functions or samples for so sharp a lobe";
  const BRDF brdf = context.ChoosePlastic(500.0);
  const Environment environment = context.MakeLight("hall", 128);
  const Pairs pairs = MakeSpherePairs(context.Pick(80, 500));
  const Radiance reference = IntegrateReference(brdf, environment, pairs);
  for (const auto& [name, make] : GetMethods())
  {
    const Radiance difference = (Integrate(make(brdf, environment), pairs) - reference).abs();
    context.Add(name, "RMS error, exponent 500",
      std::sqrt(difference.square().mean()) / reference.mean(),
      { 0.1,
        { { "median-cut", 1.0 }, { "importance", 1.0 }, { "variance", 0.4 }, { "thesis", 1.2 },
          { "filtered", 0.4 } },
        tooFew });
    Radiance errors = (reference > 0.0).select(difference / reference, 0.0);
    std::nth_element(
      errors.data(), errors.data() + errors.size() / 2, errors.data() + errors.size());
    context.Add(name, "median error, exponent 500", errors[errors.size() / 2],
      { 0.02,
        { { "median-cut", 0.15 }, { "importance", 0.2 }, { "variance", 0.12 }, { "thesis", 0.5 },
          { "filtered", 0.2 } },
        tooFew });
  }
}

//------------------------------------------------------------------------------
void RunFireflies(Context& context)
{
  const Environment sky = MakeSkyWith(64, 2e4f, { 211, 954, 1697, 392 });
  const BRDF brdf = context.ChoosePlastic(20.0);
  const Pairs pairs = MakeSpherePairs(context.Pick(100, 600));
  const Radiance reference = IntegrateReference(brdf, sky, pairs);
  context.AddEach("largest excess over the mean radiance", { 0.5 },
    [&](const Make& make)
    { return (Integrate(make(brdf, sky), pairs) - reference).maxCoeff() / reference.mean(); });
}

//------------------------------------------------------------------------------
// A strip of light along the horizon of a level surface.
void RunHorizon(Context& context)
{
  const int width = context.Pick(64, 128);
  const Environment strip = MakeEnvironment(
    width, width / 2, [](const glm::dvec3& d) { return glm::dvec3(std::exp(-400.0 * d.y * d.y)); });
  Pairs pairs;
  for (int k = 0; k < 150; ++k)
  {
    // Normals within 6 degrees of the pole, views 10 to 80 degrees from it.
    const double tilt = glm::radians(6.0) * std::sqrt((k + 0.5) / 150.0);
    const double phi = 2.4 * k;
    const double angle = glm::radians(10.0 + 70.0 * ((k * 37) % 150) / 150.0);
    pairs.Add({ std::sin(tilt) * std::cos(phi), std::cos(tilt), std::sin(tilt) * std::sin(phi) },
      { std::sin(angle), std::cos(angle), 0.0 });
  }
  context.AddErrors("error, a strip of light on the horizon", context.ChoosePlastic(50.0), strip,
    pairs,
    { 0.05,
      { { "median-cut", 0.15 }, { "importance", 0.3 }, { "variance", 0.3 }, { "thesis", 0.3 },
        { "filtered", 10.0 } },
      "cells and wide samples carry light across the horizon" });
}

//------------------------------------------------------------------------------
// Views at 80 to 89.9 degrees.
void RunGrazing(Context& context)
{
  const Pairs sphere = MakeSpherePairs(context.Pick(50, 200));
  for (const double degrees : context.Short ? std::vector<double>{ 85.0, 89.9 }
                                            : std::vector<double>{ 80.0, 85.0, 88.0, 89.0, 89.9 })
  {
    const double cosine = std::cos(glm::radians(degrees));
    const Pairs pairs = Move(sphere,
      [&](glm::dvec3& n, glm::dvec3& v)
      {
        const glm::dvec3 across = glm::normalize(v - glm::dot(n, v) * n);
        v = cosine * n + std::sqrt(1.0 - cosine * cosine) * across;
      });
    context.AddErrors("error at " + Say(degrees) + " degrees", context.ChoosePlastic(50.0),
      context.MakeLight("sky", 64), pairs,
      { 0.05, { { "thesis", 0.4 } }, "harmonics are worst at grazing angles" });
  }
}

//------------------------------------------------------------------------------
// Normals that cross the poles of the map, its seam, and the view itself.
void RunPoles(Context& context)
{
  const BRDF brdf = context.ChoosePlastic(30.0);
  const Environment environment = context.MakeLight("sky", 64);
  const glm::dvec3 view(-0.48, 0.6, 0.64);
  struct Path
  {
    std::string Name;
    glm::dvec3 Middle;
    glm::dvec3 Along;
  };
  const std::array<Path, 3> paths = { { { "pole", { 0.0, 1.0, 0.0 }, { 0.8, 0.0, 0.6 } },
    { "seam", { -1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } },
    { "normal along the view", view, { 0.8, 0.0, 0.6 } } } };
  const auto getLargestStep = [](const Radiance& x)
  { return (x.tail(x.size() - 3) - x.head(x.size() - 3)).abs().maxCoeff(); };
  for (const Path& path : paths)
  {
    Pairs pairs;
    for (int k = -40; k < 40; ++k) // 0.1 degree steps, none at the pole itself
    {
      const double angle = glm::radians(0.1 * (k + 0.5));
      pairs.Add(glm::normalize(std::cos(angle) * path.Middle + std::sin(angle) * path.Along), view);
    }
    const double step = getLargestStep(IntegrateReference(brdf, environment, pairs));
    context.AddEach("largest step over that of the reference, across the " + path.Name,
      { 1.5,
        { { "median-cut", 6.0 }, { "importance", 4.0 }, { "variance", 4.0 }, { "thesis", 6.0 },
          { "filtered", 12.0 } },
        "dots of few lights and rays of few samples, not the map" },
      [&](const Make& make)
      { return getLargestStep(Integrate(make(brdf, environment), pairs)) / step; });
  }
}

//------------------------------------------------------------------------------
glm::dvec3 TurnY(const glm::dvec3& v, double degrees)
{
  const double c = std::cos(glm::radians(degrees));
  const double s = std::sin(glm::radians(degrees));
  return { c * v.x + s * v.z, v.y, c * v.z - s * v.x };
}

struct Movement
{
  std::string Name;
  double Rotation; // of the environment, degrees per frame
  std::function<void(int frame, glm::dvec3& normal, glm::dvec3& view)> Move;
};

const std::vector<Movement> Movements = {
  { "environment by 1 degree", 1.0, [](int, glm::dvec3&, glm::dvec3&) {} },
  { "object by 1 degree", 0.0, [](int t, glm::dvec3& n, glm::dvec3&) { n = TurnY(n, t); } },
  { "camera orbit by 1 degree", 0.0, [](int t, glm::dvec3&, glm::dvec3& v) { v = TurnY(v, t); } },
  // The sphere's own points, seen by a camera that comes nearer.
  { "zoom by 5 %", 0.0,
    [](int t, glm::dvec3& n, glm::dvec3& v)
    { v = glm::normalize(6.0 * std::pow(0.95, t) * v - n); } },
  { "environment by 0.1 degree", 0.1, [](int, glm::dvec3&, glm::dvec3&) {} },
  { "object by 0.1 degree", 0.0, [](int t, glm::dvec3& n, glm::dvec3&) { n = TurnY(n, 0.1 * t); } }
};

//------------------------------------------------------------------------------
// Light that small sets, tables and samples all have trouble with: a sun low above the horizon.
glm::dvec3 GetLowSun(const glm::dvec3& d)
{
  const double sun = 200.0 * std::exp(300.0 * (glm::dot(glm::dvec3(0.8, 0.1, 0.5916), d) - 1.0));
  return 0.4 * d.y + glm::dvec3(0.5, 0.5, 0.6) + sun * glm::dvec3(1.0, 0.8, 0.5);
}

//------------------------------------------------------------------------------
void RunMotion(Context& context)
{
  struct Lit
  {
    std::string Name;
    BRDF Material;
    Environment Light;
  };
  std::vector<Lit> scenes = { { "low sun, exponent 50", MakePlastic(50.0),
                                MakeEnvironment(128, 64, GetLowSun) },
    { "sky, exponent 300", MakePlastic(300.0), context.MakeLight("sky", 128) } };
  if (!context.Short)
  {
    scenes.push_back(
      { "sky, exponent 50", context.ChoosePlastic(50.0), context.MakeLight("sky", 128) });
  }
  const Pairs sphere = MakeSpherePairs(context.Pick(60, 250));
  for (const Lit& scene : scenes)
  {
    for (int m = 0; m < context.Pick(3, 6); ++m)
    {
      const Movement& movement = Movements[static_cast<std::size_t>(m)];
      const auto advance = [&](int t)
      {
        scene.Light->SetRotationY(movement.Rotation * t);
        return Move(sphere, [&](glm::dvec3& n, glm::dvec3& v) { movement.Move(t, n, v); });
      };
      // The mean change from frame to frame.
      const auto getChange = [&](const std::function<Radiance(const Pairs&)>& integrate)
      {
        Radiance last = integrate(advance(0));
        double change = 0.0;
        for (int t = 1; t < context.Pick(4, 9); ++t)
        {
          const Radiance now = integrate(advance(t));
          change += (now - last).abs().sum();
          last = now;
        }
        return change;
      };
      const double expected = getChange(
        [&](const Pairs& pairs) { return IntegrateReference(scene.Material, scene.Light, pairs); });
      context.AddEach("flicker ratio, " + scene.Name + ", " + movement.Name,
        { 1.1,
          { { "median-cut", 2.0 }, { "importance", 2.0 }, { "variance", 2.0 }, { "thesis", 4.0 } },
          "dots and rings that pass over the surface" },
        [&](const Make& make)
        {
          scene.Light->SetRotationY(0.0);
          const Integrator integrator = make(scene.Material, scene.Light);
          return getChange([&](const Pairs& pairs) { return Integrate(integrator, pairs); }) /
                 expected;
        });
      scene.Light->SetRotationY(0.0);
    }
  }
}

//------------------------------------------------------------------------------
// A table of a plastic, each cell changed: (cell, its value) -> value.
BRDF MakeOddTable(
  const std::function<double(int, double)>& change, int range = vtkTabulatedBRDF::HALF_TURN)
{
  const BRDF plastic = MakePlastic(20.0);
  const int dimensions[3] = { 12, 24, 32 };
  std::vector<float> rgb;
  for (int cell = 0; cell < 12 * 24 * 32; ++cell)
  {
    glm::dvec3 i;
    glm::dvec3 o;
    glm::dvec3 f(0.1);
    if (vtkTabulatedBRDF::GetCellDirections(vtkTabulatedBRDF::HALF_DIFFERENCE, range, dimensions,
          cell % 12, cell / 12 % 24, cell / (12 * 24), &i.x, &o.x))
    {
      plastic->Evaluate(&i.x, &o.x, &f.x);
    }
    for (int c = 0; c < 3; ++c)
    {
      rgb.push_back(static_cast<float>(change(cell, f[c])));
    }
  }
  const auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, range, dimensions, std::move(rgb));
  return table;
}

//------------------------------------------------------------------------------
// Materials that no sample can be.
void RunOddities(Context& context)
{
  struct Oddity
  {
    std::string Name;
    BRDF Material;
    Limits Error = { 0.1 };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto hash = [](int cell) { return std::fmod(0.6180339887498949 * cell, 1.0); };
  std::vector<Oddity> oddities = {
    { "no mirror symmetry",
      MakeOddTable([](int cell, double value) { return value * (cell % 12 < 6 ? 1.6 : 0.4); },
        vtkTabulatedBRDF::FULL_TURN),
      { 0.1, { { "table", 0.8 } },
        "taken as symmetric about the plane of incidence; the planner tries and refuses it" } },
    { "negative cells",
      MakeOddTable([&](int cell, double value) { return value - (hash(cell) < 0.2 ? 0.3 : 0.0); }),
      { 0.1, { { "thesis", 0.4 }, { "table", 0.4 } },
        "noise from cell to cell is finer than rows, view angles and functions" } },
    { "missing cells",
      MakeOddTable([&](int cell, double value) { return hash(cell) < 0.3 ? nan : value; }) },
    { "no valid cell", MakeOddTable([&](int, double) { return nan; }) }
  };
  if (!context.Short)
  {
    oddities.push_back({ "albedo 4", MakeMatte(4.0) });
    oddities.push_back({ "not reciprocal",
      MakeOddTable([](int cell, double value) { return value * ((cell + 3) % 12 < 6 ? 1.6 : 0.4); },
        vtkTabulatedBRDF::FULL_TURN) });
    oddities.push_back(
      { "values of 1e30", MakeOddTable([](int, double value) { return 1e30 * value; }) });
    oddities.push_back({ "zero", MakeOddTable([](int, double) { return 0.0; }) });
  }
  const auto countBad = [](const Radiance& x)
  { return static_cast<double>(x.size() - (x.isFinite() && x >= 0.0).count()); };
  const Environment environment = context.MakeLight("sky", 128);
  const Pairs pairs = MakeSpherePairs(context.Pick(50, 100));
  for (const Oddity& oddity : oddities)
  {
    const Radiance reference = IntegrateReference(oddity.Material, environment, pairs);
    for (const auto& [name, make] : GetMethods())
    {
      const Integrator integrator = make(oddity.Material, environment);
      const Radiance radiance = Integrate(integrator, pairs);
      context.Add(name, "negative or not finite: " + oddity.Name, countBad(radiance), { 0.0 });
      context.Add(name, "error: " + oddity.Name, GetRelativeL1(radiance, reference), oddity.Error);
    }
  }
}

/// Sizes of a method whose errors are to fall as size^-Order.
struct Series
{
  std::string Method;
  std::string Unit;
  std::vector<int> Sizes;
  double Order;
  std::string Why;
  std::function<tool::MethodOptions(int size)> Use;
  double Exponent = 20.0; // of the plastic: where errors stay above those of the reference
};

//------------------------------------------------------------------------------
std::vector<Series> GetSeries(bool isShort)
{
  const std::string cells = "midpoints of cells in two dimensions";
  const auto lights =
    [&](const std::string& name, const std::string& set, double order, const std::string& why)
  {
    return Series{ name, "lights", { 16, 64, 256, 1024 }, order, why,
      [=](int size) { return UseLights(set, size, name == "soft-lights"); } };
  };
  return { lights("median-cut", "median-cut", 1.0, cells),
    lights("variance", "variance", 1.0, cells),
    lights("importance", "importance", 0.5, "random; strata help"),
    lights("soft-lights", "variance", 1.0, cells),
    { "filtered", "samples", { 8, 32, 128, 512 }, 0.5, "GPU Gems 3, ch. 20: at least random",
      [](int size) { return UseSizes("filtered", std::to_string(size)); } },
    { "table", "rows, all sizes in proportion",
      isShort ? std::vector<int>{ 9, 13, 17 } : std::vector<int>{ 9, 11, 13, 17 }, 1.0,
      "linear interpolation of smooth radiance: 2, until the 9 bits of the texels show at 0.04 %",
      [](int size)
      {
        return UseSizes("table",
          std::to_string(size) + "," + std::to_string(2 * size / 3) + "," + std::to_string(size));
      },
      100.0 } };
}

//------------------------------------------------------------------------------
// The slope of log error against log size, by least squares.
void RunConvergence(Context& context)
{
  const Environment environment =
    context.Light ? Shrink(context.Light, 128) : MakeEnvironment(128, 64, GetSmoothRadiance);
  const Pairs pairs = MakeSpherePairs(context.Pick(80, 300));
  for (const Series& series : GetSeries(context.Short))
  {
    const BRDF brdf = context.ChoosePlastic(series.Exponent);
    const Radiance reference = IntegrateReference(brdf, environment, pairs);
    const auto count = static_cast<Eigen::Index>(series.Sizes.size());
    Eigen::ArrayXd x(count);
    Eigen::ArrayXd y(count);
    std::string text;
    for (Eigen::Index k = 0; k < count; ++k)
    {
      const int size = series.Sizes[static_cast<std::size_t>(k)];
      const Integrator integrator = MakeBy(series.Use(size), brdf, environment);
      const double error = GetRelativeL1(Integrate(integrator, pairs), reference);
      x[k] = std::log(size);
      y[k] = std::log(std::max(error, 1e-300));
      text += (text.empty() ? "" : ", ") + Say(100.0 * error) + " %";
    }
    x -= x.mean();
    context.Add(series.Method, "slope of log error against log " + series.Unit,
      (x * y).sum() / x.square().sum(), { -0.75 * series.Order },
      "theory -" + Say(series.Order) + " (" + series.Why + "); " + text);
  }
}

//------------------------------------------------------------------------------
// The share of the runs, each with other pairs, whose result is another material than the best of
// them: what differs by more than 5 % of L2 is another optimum.
void RunFits(Context& context)
{
  const int runs = context.Pick(6, 100);
  const BRDF material =
    context.Material ? context.Material : BRDF::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  std::vector<std::pair<std::string, vtkSmartPointer<vtkBRDFFitter>>> kinds;
  const auto addLobes = [&kinds](const std::string& name, int shape, int lobes)
  {
    const auto fitter = vtkSmartPointer<vtkLobeBRDFFitter>::New();
    fitter->SetShape(shape);
    fitter->SetNumberOfLobes(lobes);
    kinds.emplace_back(name, fitter);
  };
  addLobes("A.-S., 1 lobe", vtkLobeBRDFFitter::ASHIKHMIN_SHIRLEY, 1);
  addLobes("A.-S., 2 lobes", vtkLobeBRDFFitter::ASHIKHMIN_SHIRLEY, 2);
  addLobes("Blinn-Phong", vtkLobeBRDFFitter::BLINN_PHONG, 1);
  kinds.emplace_back("D-BRDF", vtkSmartPointer<vtkDistributionBRDFFitter>::New());
  for (const auto& [name, fitter] : kinds)
  {
    std::vector<std::pair<double, BRDF>> results;
    for (int seed = 1; seed <= runs; ++seed)
    {
      tool::Interruptible::Check();
      fitter->SetInput(material);
      fitter->SetNumberOfSamples(4096);
      fitter->SetSeed(static_cast<unsigned int>(seed));
      if (!fitter->Fit())
      {
        throw tool::Error("fit: " + tool::TakeErrorText());
      }
      results.emplace_back(fitter->GetResidual(), fitter->GetOutput());
    }
    const auto best = std::min_element(results.begin(), results.end(),
      [](const auto& a, const auto& b) { return a.first < b.first; });
    double others = 0.0;
    double farthest = 0.0;
    for (const auto& result : results)
    {
      const double distance =
        vtkBRDFResampler::GetRelativeL2Error(best->second, result.second, 1 << 12);
      others += distance > 0.05;
      farthest = std::max(farthest, distance);
    }
    context.Add(name,
      "share of " + std::to_string(runs) + " draws of the pairs that end at another optimum",
      others / runs,
      { 0.05, { { "D-BRDF", 1.0 } },
        "a tabulated p(h) follows the 4096 pairs that each seed draws" },
      "farthest " + Say(100.0 * farthest) + " % of L2 from the best");
  }
}

struct Case
{
  std::string Name;
  std::string Group;
  void (*Run)(Context&);
};

// In the order of docs/stability.md.
const std::vector<Case> Cases = { { "ringing", "bases", RunRinging },
  { "zenith", "bases", RunZenith }, { "sun", "range", RunSun }, { "dots", "sampling", RunDots },
  { "fireflies", "sampling", RunFireflies }, { "horizon", "sampling", RunHorizon },
  { "grazing", "geometry", RunGrazing }, { "poles", "geometry", RunPoles },
  { "motion", "temporal", RunMotion }, { "oddities", "data", RunOddities },
  { "convergence", "convergence", RunConvergence }, { "fits", "numeric", RunFits } };

struct StabilityOptions
{
  std::string File;
  std::string Environment;
  std::vector<std::string> Cases;
  bool Short = false;
  std::string Output;
};

//------------------------------------------------------------------------------
// The wanted cases in their own order. Names are of cases or of groups.
std::vector<Case> Select(const std::vector<std::string>& names)
{
  std::string known;
  std::string group;
  std::vector<Case> wanted;
  std::set<std::string> unknown(names.begin(), names.end());
  for (const Case& one : Cases)
  {
    known += one.Group == group ? ", " : (known.empty() ? "" : "; ") + one.Group + ": ";
    known += one.Name;
    group = one.Group;
    unknown.erase(one.Name);
    unknown.erase(one.Group);
    if (names.empty() || std::count(names.begin(), names.end(), one.Name) > 0 ||
        std::count(names.begin(), names.end(), one.Group) > 0)
    {
      wanted.push_back(one);
    }
  }
  if (!unknown.empty())
  {
    throw tool::UsageError(
      "--case: there is neither a case nor a group '" + *unknown.begin() + "'; " + known);
  }
  return wanted;
}

//------------------------------------------------------------------------------
// A case that breaks down is a case that fails; only Ctrl-C ends the run.
void RunCase(const Case& one, Context& context)
{
  try
  {
    one.Run(context);
  }
  catch (const std::exception& problem)
  {
    tool::Interruptible::Check();
    context.Add("", "broke down", 1.0, { 0.0 }, problem.what());
  }
  const std::string errors = tool::TakeErrorText();
  if (!errors.empty())
  {
    context.Add("", "errors", 1.0, { 0.0 }, errors);
  }
}

//------------------------------------------------------------------------------
std::string FormatFinding(const std::string& name, const Json& finding)
{
  char row[256];
  std::snprintf(row, sizeof(row), "%-18s %-14s %10.3g %10.3g  %-11s  ", name.c_str(),
    finding["method"].get<std::string>().c_str(), finding["value"].get<double>(),
    finding["threshold"].get<double>(), finding["status"].get<std::string>().c_str());
  const std::string note = finding["note"];
  return row + finding["figure"].get<std::string>() + (note.empty() ? "" : " (" + note + ")") +
         "\n";
}

//------------------------------------------------------------------------------
void RunStability(const StabilityOptions& options)
{
  const std::vector<Case> cases = Select(options.Cases);
  const std::string path = options.Output + "/stability.json";
  tool::MakeFolder(options.Output);
  tool::CheckWritable(path);
  const tool::Interruptible interruptible;
  Context inputs;
  inputs.Short = options.Short;
  if (!options.File.empty())
  {
    inputs.Material = tool::LoadMaterial(options.File).BRDF;
  }
  if (!options.Environment.empty())
  {
    inputs.Light = tool::LoadEnvironment(options.Environment);
  }

  Json findings = Json::array();
  Json seconds;
  std::map<std::string, int> counts;
  tool::PrintOut("CASE               METHOD              VALUE  THRESHOLD  STATUS       FIGURE\n");
  for (const Case& one : cases)
  {
    tool::Interruptible::Check();
    Context context = inputs;
    const auto begin = std::chrono::steady_clock::now();
    {
      tool::ProgressBar bar("case " + std::to_string(seconds.size() + 1) + " of " +
                            std::to_string(cases.size()) + ", " + one.Name);
      bar.Update(static_cast<double>(seconds.size()) / static_cast<double>(cases.size()));
      RunCase(one, context);
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    seconds[one.Name] = std::round(100.0 * taken.count()) / 100.0;
    for (const Json& finding : context.Findings)
    {
      tool::PrintOut(FormatFinding(one.Name, finding));
      findings.push_back({ { "name", one.Name }, { "group", one.Group } });
      findings.back().update(finding);
      ++counts[finding["status"]];
    }
  }
  tool::Scene window;
  window.SetMesh(tool::MakeSphere());
  window.Open(64, 64);
  const Json machine = tool::DescribeMachine();
  tool::WriteReport(path,
    { { "version", machine["program"] }, { "vtk", machine["vtk"] },
      { "machine", machine["processor"].get<std::string>() + ", " + machine["threads"].dump() +
                     " threads, " + machine["system"].get<std::string>() },
      { "renderer", window.GetRendererName() }, { "short", options.Short },
      { "material", options.File.empty() ? "each case's own" : options.File },
      { "environment", options.Environment.empty() ? "each case's own" : options.Environment },
      { "seconds", seconds }, { "cases", findings } });
  tool::PrintOut(std::to_string(counts["pass"]) + " pass, " +
                 std::to_string(counts["known limit"]) + " known limits, " +
                 std::to_string(counts["fail"]) + " fail\n");
  if (counts["fail"] > 0)
  {
    throw tool::Error(std::to_string(counts["fail"]) + " figures are beyond their threshold; " +
                      path + " has them all");
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddStabilityCommand(CLI::App& app)
{
  auto options = std::make_shared<StabilityOptions>();
  CLI::App* command = app.add_subcommand(
    "stability", "Provoke every known way to fail, and measure what each method makes of it");
  command->add_option("FILE", options->File,
    GetMaterialHelp() + ". Takes the place of the cases' own where they leave a choice");
  command->add_option("--environment", options->Environment,
    std::string(EnvironmentHelp) + ". Takes the place of the cases' own likewise");
  AddProjectionOption(command);
  command->add_option("--case", options->Cases,
    "Cases or groups of cases to run, by name (default: all); a wrong name lists them");
  command->add_flag(
    "--short", options->Short, "Fewer steps and smaller sizes: a test, not a study");
  command->add_option("-o,--output", options->Output, "Folder for stability.json")->required();
  command->footer("Exit status 1 where a figure is beyond its threshold and not a known limit.\n\n"
                  "Example:\n  measured-brdf-lab stability --case temporal -o stability\n\n"
                  "Needs OpenGL; without a screen, put 'xvfb-run -a' before it.");
  command->callback([options]() { RunStability(*options); });
}
} // namespace tool
