// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Each case provokes one known way to fail. What is particular to a case's materials and light
// stands in its function; thresholds stand beside the figures that they judge.
#include "LocalFrame.h"
#include "Meshes.h"
#include "Methods.h"
#include "Progress.h"
#include "Sheets.h"
#include "Stability.h"
#include "Surface.h"
#include "Tool.h"

#include "vtkBRDFResampler.h"
#include "vtkBasisBRDF.h"
#include "vtkDistributionBRDFFitter.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkLobeBRDFFitter.h"
#include "vtkNew.h"
#include "vtkTabulatedBRDF.h"

#include <Eigen/Eigenvalues>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tool::stability
{
namespace
{
constexpr double StabilityZone[2] = { 9.0, 57.0 }; // of the device, Ghosh et al. 2007
constexpr double AllAngles[2] = { 0.0, 90.0 };
constexpr double LargestNegativeMass = 0.05; // that an extrapolation may have
constexpr int ErrorPairs = 1 << 14;
constexpr int SheetTile = 128;

//------------------------------------------------------------------------------
std::string Name(int basis, int order)
{
  static const char* const names[] = { "harmonics", "hemispherical", "zonal", "Leg.xFourier" };
  return std::string(names[basis]) + " " + std::to_string(order);
}

//------------------------------------------------------------------------------
// A sphere's tile of a sheet; black where there is no sphere.
Picture MakeTile(const Surface& surface, const Radiance& radiance, double exposure)
{
  Picture tile = MakePaper(SheetTile, SheetTile);
  for (std::size_t k = 0; k < tile.Pixels.size(); ++k)
  {
    tile.Pixels[k] = k % 4 == 3 ? 1.0f : 0.0f;
  }
  for (std::size_t k = 0; k < surface.Pixels.size(); ++k)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      tile.Pixels[4 * static_cast<std::size_t>(surface.Pixels[k]) + c] = static_cast<float>(
        RollOff(exposure * std::max(0.0, radiance[static_cast<Eigen::Index>(3 * k + c)])));
    }
  }
  return tile;
}

Surface FindTileSurface()
{
  return FindSurface(
    MakeSphere(), { 30.0, 20.0 }, 0.9, { SheetTile, SheetTile }, SheetTile * SheetTile);
}

//------------------------------------------------------------------------------
// One light above, as in the thesis's 2.3.4: the lobe itself is what shows, as its square root.
void DrawRinging(Context& context)
{
  vtkNew<vtkLightSet> light;
  const double direction[3] = { 0.61, 0.61, 0.5 };
  const double irradiance[3] = { 1.0, 1.0, 1.0 };
  light->AddLight(direction, irradiance);
  const std::array<int, 4> orders = { 0, 2, 6, 12 };
  const std::array<double, 3> exponents = { 5.0, 20.0, 100.0 };
  const Surface surface = FindTileSurface();
  ContactSheet sheet("Harmonics ring: one light, order x sharpness", orders.size(),
    exponents.size(), SheetTile, SheetTile);
  for (std::size_t row = 0; row < exponents.size(); ++row)
  {
    double exposure = 0.0;
    for (std::size_t column = 0; column < orders.size(); ++column)
    {
      const int order = orders[column];
      const BRDF lobe = MakeLobe(exponents[row]);
      vtkNew<vtkLightSetRadianceIntegrator> loop;
      loop->SetBRDF(
        order > 0 ? Project(lobe, vtkBasisBRDF::SPHERICAL_HARMONICS, order).Get() : lobe.Get());
      loop->SetLightSet(light);
      const Radiance radiance = Integrate(loop, { surface.Normals, surface.Views });
      exposure = order > 0 ? exposure : 0.9 / radiance.maxCoeff();
      sheet.Add(static_cast<int>(column), static_cast<int>(row),
        MakeTile(surface, (exposure * radiance).max(0.0).sqrt(), 1.0),
        order > 0 ? "order " + std::to_string(order) : "exponent " + Say(exponents[row]),
        order > 0 ? "" : "exact");
    }
  }
  context.Shown = sheet.GetPicture();
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
        const BRDF projected = Project(lobe, basis, order);
        context.Add(Name(basis, order), "negative mass before the clamp, exponent " + Say(exponent),
          vtkBasisBRDF::SafeDownCast(projected)->GetNegativeMass(AllAngles, AllAngles, ErrorPairs),
          { LargestNegativeMass, { { Name(basis, order), 0.5 } }, "order too low for the lobe" },
          "relative L2 error " +
            Say(vtkBRDFResampler::GetRelativeL2Error(lobe, projected, ErrorPairs)));
      }
    }
    // The tool's answer: the advice takes a fit where a basis would ring.
    const tool::Advice advice = tool::Advise(lobe, 6);
    context.Add("advisor", "a ringing basis recommended, exponent " + Say(exponent),
      advice.IsBasis && advice.NegativeMass > LargestNegativeMass, 0.0, advice.Reason);
  }
  DrawRinging(context);
}

//------------------------------------------------------------------------------
// Functions of an azimuth must vanish where it means nothing: along the normal.
void RunZenith(Context& context)
{
  const BRDF lobe = context.Choose(MakePlastic(50.0));
  for (int basis = 0; basis < 4; ++basis)
  {
    const BRDF projected = Project(lobe, basis, 6);
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
  const Pairs pairs = MakeSpherePairs(context.Pick(150, 300));
  const Limits limits = { 0.05, { { "thesis", 0.15 } }, "the basis rings under one light" };
  AddErrors(context, "error, Lambert", MakeLambert(0.5), sky, pairs, limits);
  AddErrors(context, "error, plastic, exponent 50", MakePlastic(50.0), sky, pairs, limits);
}

//------------------------------------------------------------------------------
// A sphere by each method, and by the reference, under one exposure.
void DrawDots(Context& context, vtkBRDF* brdf, vtkEnvironment* environment)
{
  const Surface surface = FindTileSurface();
  const Pairs pairs = { surface.Normals, surface.Views };
  const Radiance reference = IntegrateReference(brdf, environment, pairs);
  Radiance sorted = reference;
  std::sort(sorted.data(), sorted.data() + sorted.size());
  const double exposure = 0.9 / std::max(sorted[sorted.size() * 99 / 100], 1e-30);
  const auto& methods = GetMethods();
  const int columns = 5;
  ContactSheet sheet("Few lights draw a sharp lobe as dots (exponent 500, built-in hall)", columns,
    static_cast<int>(methods.size()) / columns + 1, SheetTile, SheetTile);
  sheet.Add(0, 0, MakeTile(surface, reference, exposure), "reference", "");
  for (int k = 1; k <= static_cast<int>(methods.size()); ++k)
  {
    const auto& [name, make] = methods[static_cast<std::size_t>(k) - 1];
    const Radiance radiance = Integrate(make(brdf, environment), pairs);
    sheet.Add(k % columns, k / columns, MakeTile(surface, radiance, exposure), name,
      "error " + Say(100.0 * GetRelativeL1(radiance, reference)) + " %");
  }
  context.Shown = sheet.GetPicture();
}

//------------------------------------------------------------------------------
void RunDots(Context& context)
{
  const std::string tooFew = "too few lights, functions or samples for so sharp a lobe";
  const BRDF brdf = context.Choose(MakePlastic(500.0));
  const Environment environment = context.MakeLight("hall", 128);
  const Pairs pairs = MakeSpherePairs(context.Pick(150, 500));
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
  DrawDots(context, brdf, context.MakeLight("hall", 64));
}

//------------------------------------------------------------------------------
void RunFireflies(Context& context)
{
  const Environment sky = MakeSkyWith(64, 2e4f, { 211, 954, 1697, 392 });
  const BRDF brdf = context.Choose(MakePlastic(20.0));
  const Pairs pairs = MakeSpherePairs(context.Pick(200, 600));
  const Radiance reference = IntegrateReference(brdf, sky, pairs);
  for (const auto& [name, make] : GetMethods())
  {
    context.Add(name, "largest excess over the mean radiance",
      (Integrate(make(brdf, sky), pairs) - reference).maxCoeff() / reference.mean(), 0.5);
  }
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
  AddErrors(context, "error, a strip of light on the horizon", context.Choose(MakePlastic(50.0)),
    strip, pairs,
    { 0.05,
      { { "median-cut", 0.15 }, { "importance", 0.3 }, { "variance", 0.3 }, { "thesis", 0.3 },
        { "filtered", 10.0 } },
      "cells and wide samples carry light across the horizon" });
}

//------------------------------------------------------------------------------
void RunGrazing(Context& context)
{
  const BRDF brdf = context.Choose(MakePlastic(50.0));
  const Environment environment = context.MakeLight("sky", 64);
  const Pairs sphere = MakeSpherePairs(context.Pick(80, 200));
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
    AddErrors(context, "error at " + Say(degrees) + " degrees", brdf, environment, pairs,
      { 0.05, { { "thesis", 0.4 } }, "harmonics are worst at grazing angles" });
  }
}

//------------------------------------------------------------------------------
// Normals that cross the poles of the map, its seam, and the view itself, on the GPU.
void RunPoles(Context& context)
{
  const BRDF brdf = context.Choose(MakePlastic(30.0));
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
    for (const auto& [name, make] : GetMethods())
    {
      context.Add(name, "largest step over that of the reference, across the " + path.Name,
        getLargestStep(Draw(make(brdf, environment), pairs)) / step,
        { 1.5,
          { { "median-cut", 6.0 }, { "importance", 4.0 }, { "variance", 4.0 }, { "thesis", 6.0 },
            { "filtered", 12.0 } },
          "dots of few lights and rays of few samples, not the map" });
    }
  }
}

//------------------------------------------------------------------------------
// The same light with the brightest texel on the map's seam: nothing may change.
void RunSeams(Context& context)
{
  const std::string figure = "difference by where the map's seam lies";
  const BRDF brdf = context.Choose(MakePlastic(30.0));
  const Environment environment = context.MakeLight("sky", 128);
  const Pairs pairs = MakeSpherePairs(150);
  const int width = environment->GetWidth();
  const std::vector<float>& pixels = environment->GetPixels();
  const auto brightest =
    static_cast<int>((std::max_element(pixels.begin(), pixels.end()) - pixels.begin()) / 3 % width);
  const Environment rolled = Roll(environment, width - brightest);
  rolled->SetRotationY(360.0 * (width - brightest) / width);
  context.Add("reference", figure,
    GetRelativeL1(
      IntegrateReference(brdf, rolled, pairs), IntegrateReference(brdf, environment, pairs)),
    2e-3, "the sun moved onto the seam and turned back");
  for (const auto& [name, make] : GetMethods())
  {
    context.Add(name, figure,
      GetRelativeL1(
        Integrate(make(brdf, rolled), pairs), Integrate(make(brdf, environment), pairs)),
      { 0.02, { { "median-cut", 0.06 }, { "importance", 0.1 }, { "thesis", 0.06 } },
        "cuts and draws begin at the seam: other lights" });
  }
}

//------------------------------------------------------------------------------
// The mean change from frame to frame over that of the reference.
double GetFlicker(const std::function<Radiance(int)>& draw, const std::vector<Radiance>& reference)
{
  Radiance last = draw(0);
  double change = 0.0;
  double expected = 0.0;
  for (std::size_t t = 1; t < reference.size(); ++t)
  {
    const Radiance now = draw(static_cast<int>(t));
    change += (now - last).abs().sum();
    expected += (reference[t] - reference[t - 1]).abs().sum();
    last = now;
  }
  return change / expected;
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
  if (!context.Short) // `remade` has this scene, too
  {
    scenes.push_back(
      { "sky, exponent 50", context.Choose(MakePlastic(50.0)), context.MakeLight("sky", 128) });
  }
  const Pairs sphere = MakeSpherePairs(context.Pick(100, 250));
  const auto frames = static_cast<std::size_t>(context.Pick(4, 9));
  for (const Lit& scene : scenes)
  {
    for (int m = 0; m < context.Pick(4, 6); ++m)
    {
      const Movement& movement = Movements[static_cast<std::size_t>(m)];
      const auto advance = [&](int t)
      {
        scene.Light->SetRotationY(movement.Rotation * t);
        return Move(sphere, [&](glm::dvec3& n, glm::dvec3& v) { movement.Move(t, n, v); });
      };
      std::vector<Radiance> reference;
      while (reference.size() < frames)
      {
        const Pairs pairs = advance(static_cast<int>(reference.size()));
        reference.push_back(IntegrateReference(scene.Material, scene.Light, pairs));
      }
      for (const auto& [name, make] : GetMethods())
      {
        scene.Light->SetRotationY(0.0);
        const Integrator integrator = make(scene.Material, scene.Light);
        context.Add(name, "flicker ratio, " + scene.Name + ", " + movement.Name,
          GetFlicker([&](int t) { return Integrate(integrator, advance(t)); }, reference),
          { 1.1,
            { { "median-cut", 2.0 }, { "importance", 2.0 }, { "variance", 2.0 },
              { "thesis", 4.0 } },
            "dots and rings that pass over the surface" });
      }
      scene.Light->SetRotationY(0.0);
    }
  }
}

//------------------------------------------------------------------------------
// The map's own pixels turn, so everything is made anew for each frame.
void RunRemade(Context& context)
{
  const double step = 0.6; // columns of 128: 1.7 degrees
  const BRDF brdf = context.Choose(MakePlastic(50.0));
  const Environment environment = context.MakeLight("sky", 128);
  const Pairs pairs = MakeSpherePairs(context.Pick(120, 250));
  std::vector<Radiance> reference;
  while (static_cast<int>(reference.size()) < context.Pick(4, 9))
  {
    const Environment rolled = Roll(environment, step * static_cast<double>(reference.size()));
    reference.push_back(IntegrateReference(brdf, rolled, pairs));
  }
  for (const auto& [name, make] : GetMethods())
  {
    const auto draw = [&, &remake = make](int t)
    { return Integrate(remake(brdf, Roll(environment, step * t)), pairs); };
    context.Add(name, "flicker ratio, all made anew for each turned map",
      GetFlicker(draw, reference),
      { 1.1,
        { { "median-cut", 4.0 }, { "importance", 4.0 }, { "thesis", 4.0 }, { "filtered", 2.0 } },
        "cut anew after the map's pixels turned: shown on purpose" });
  }
  const auto draw = [&](int t)
  {
    const Environment rolled = Roll(environment, step * t);
    return Integrate(MakeLightLoop(brdf, rolled, "importance", 64, false, t + 1), pairs);
  };
  context.Add("importance", "flicker ratio, lights drawn anew for each frame",
    GetFlicker(draw, reference),
    { 1.1, { { "importance", Unlimited } },
      "random sampling re-drawn per frame: shown on purpose" });
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
    Limits Error = 0.1;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto hash = [](int cell) { return std::fmod(0.6180339887498949 * cell, 1.0); };
  std::vector<Oddity> oddities = {
    { "no mirror symmetry",
      MakeOddTable([](int cell, double value) { return value * (cell % 12 < 6 ? 1.6 : 0.4); },
        vtkTabulatedBRDF::FULL_TURN),
      { 0.1, { { "table", 0.8 }, { "factored", 0.8 } },
        "taken as symmetric about the plane of incidence; the planner tries and refuses it" } },
    { "negative cells",
      MakeOddTable([&](int cell, double value) { return value - (hash(cell) < 0.2 ? 0.3 : 0.0); }),
      { 0.1,
        { { "thesis", 0.4 }, { "table", 0.4 }, { "factored", 0.4 }, { "anisotropic-table", 0.4 } },
        "noise from cell to cell is finer than rows, view angles and functions" } },
    { "missing cells",
      MakeOddTable([&](int cell, double value) { return hash(cell) < 0.3 ? nan : value; }) },
    { "no valid cell", MakeOddTable([&](int, double) { return nan; }) }
  };
  if (!context.Short)
  {
    oddities.push_back({ "albedo 4", MakeLambert(4.0) });
    oddities.push_back({ "not reciprocal",
      MakeOddTable([](int cell, double value) { return value * ((cell + 3) % 12 < 6 ? 1.6 : 0.4); },
        vtkTabulatedBRDF::FULL_TURN) });
    oddities.push_back(
      { "values of 1e30", MakeOddTable([](int, double value) { return 1e30 * value; }) });
    oddities.push_back({ "zero", MakeOddTable([](int, double) { return 0.0; }) });
  }
  const Environment environment = context.MakeLight("sky", 128);
  const Pairs pairs = MakeSpherePairs(100);
  for (const Oddity& oddity : oddities)
  {
    const Radiance reference = IntegrateReference(oddity.Material, environment, pairs);
    for (const auto& [name, make] : GetMethods())
    {
      const Integrator integrator = make(oddity.Material, environment);
      const Radiance radiance = Integrate(integrator, pairs);
      context.Add(name, "negative or not finite: " + oddity.Name,
        CountBad(radiance) + CountBad(Draw(integrator, pairs)), 0.0);
      context.Add(name, "error: " + oddity.Name, GetRelativeL1(radiance, reference), oddity.Error);
    }
  }
}

struct Series
{
  std::string Method;
  std::string Unit;
  std::vector<int> Sizes;
  double Order; // theory: error ~ size^-Order
  std::string Why;
  std::function<Integrator(vtkBRDF*, vtkEnvironment*, int size, int seed)> MakeOf;
  double Exponent = 20.0; // of the plastic: where errors stay above those of the reference
};

//------------------------------------------------------------------------------
std::vector<Series> GetSeries(bool isShort)
{
  const auto lights =
    [](const std::string& name, const std::string& method, double order, const std::string& why)
  {
    return Series{ name, "lights", { 16, 64, 256, 1024 }, order, why,
      [=](vtkBRDF* brdf, vtkEnvironment* environment, int size, int seed)
      { return MakeLightLoop(brdf, environment, method, size, name == "soft-lights", seed); } };
  };
  const std::string cells = "midpoints of cells in two dimensions";
  return {
    lights("median-cut", "median-cut", 1.0, cells),
    lights("variance", "variance", 1.0, cells),
    lights("importance", "importance", 0.5, "random; strata help"),
    lights("soft-lights", "variance", 1.0, cells),
    { "filtered", "samples", { 8, 32, 128, 512 }, 0.5, "GPU Gems 3, ch. 20: at least random",
      [](vtkBRDF* brdf, vtkEnvironment* environment, int size, int)
      { return MakeFiltered(brdf, environment, size); } },
    { "table", "rows, all sizes in proportion",
      isShort ? std::vector<int>{ 9, 13, 17 } : std::vector<int>{ 9, 11, 13, 17 }, 1.0,
      "linear interpolation of smooth radiance: 2, until the 9 bits of the texels show at 0.04 %",
      [](vtkBRDF* brdf, vtkEnvironment* environment, int size, int)
      { return MakeTable(brdf, environment, size, 2 * size / 3, size); },
      100.0 },
  };
}

//------------------------------------------------------------------------------
// The slope of log error against log size, by least squares.
void RunConvergence(Context& context)
{
  const Environment environment =
    context.Light ? Shrink(context.Light, 128) : MakeEnvironment(128, 64, GetSmoothRadiance);
  const Pairs pairs = MakeSpherePairs(context.Pick(120, 300));
  for (const Series& series : GetSeries(context.Short))
  {
    const BRDF brdf = context.Choose(MakePlastic(series.Exponent));
    const Radiance reference = IntegrateReference(brdf, environment, pairs);
    const auto count = static_cast<Eigen::Index>(series.Sizes.size());
    Eigen::ArrayXd x(count);
    Eigen::ArrayXd y(count);
    std::string text;
    const int seeds = series.Method == "importance" ? 4 : 1;
    for (Eigen::Index k = 0; k < count; ++k)
    {
      const int size = series.Sizes[static_cast<std::size_t>(k)];
      double error = 0.0;
      for (int seed = 1; seed <= seeds; ++seed)
      {
        error +=
          GetRelativeL1(Integrate(series.MakeOf(brdf, environment, size, seed), pairs), reference);
      }
      x[k] = std::log(size);
      y[k] = std::log(std::max(error / seeds, 1e-300));
      text += (text.empty() ? "" : ", ") + Say(100.0 * error / seeds) + " %";
    }
    x -= x.mean();
    context.Add(series.Method, "slope of log error against log " + series.Unit,
      (x * y).sum() / x.square().sum(), -0.75 * series.Order,
      "theory -" + Say(series.Order) + " (" + series.Why + "); " + text);
  }
}

//------------------------------------------------------------------------------
// The condition of the Gram matrix of a basis' functions over polar angles in degrees, with a
// penalty lambda (l(l+1))^2.
double GetCondition(int basis, int order, const double zone[2], double lambda)
{
  const int rows = 96;
  const int columns = 4 * order + 4;
  const Eigen::Index n = (order + 1) * (order + 1);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  const double near = std::cos(glm::radians(zone[0]));
  const double far = std::cos(glm::radians(zone[1]));
  const double weight = (near - far) / rows * glm::two_pi<double>() / columns;
  for (int k = 0; k < rows * columns; ++k)
  {
    const glm::dvec3 direction =
      measuredbrdf::ToDirection(far + (near - far) * (k / columns + 0.5) / rows,
        glm::two_pi<double>() * (k % columns + 0.5) / columns);
    const std::vector<double> values =
      vtkBasisBRDF::EvaluateBasis(basis, order, zone, &direction.x);
    const Eigen::Map<const Eigen::VectorXd> vector(values.data(), n);
    gram += weight * vector * vector.transpose();
  }
  for (Eigen::Index a = 0; a < n; ++a)
  {
    const double l = std::floor(std::sqrt(static_cast<double>(a)));
    gram(a, a) += lambda * l * l * (l + 1.0) * (l + 1.0);
  }
  const Eigen::VectorXd values =
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  return values.maxCoeff() / std::max(values.minCoeff(), 1e-300);
}

//------------------------------------------------------------------------------
// 32-bit coefficients keep three digits at a condition of 1e4.
void RunGram(Context& context)
{
  struct Row
  {
    std::string Name;
    int Basis;
    const double* Angles;
    double Penalty;
  };
  const std::vector<Row> rows = { { "zonal", vtkBasisBRDF::ZONAL, StabilityZone, 0.0 },
    { "Leg.xFourier", vtkBasisBRDF::LEGENDRE_FOURIER, StabilityZone, 0.0 },
    { "hemisph.", vtkBasisBRDF::HEMISPHERICAL, AllAngles, 0.0 },
    { "harm.", vtkBasisBRDF::SPHERICAL_HARMONICS, AllAngles, 0.0 },
    { "harm.", vtkBasisBRDF::SPHERICAL_HARMONICS, StabilityZone, 0.0 },
    { "harm.+pen.", vtkBasisBRDF::SPHERICAL_HARMONICS, AllAngles, 1e-6 },
    { "harm.+pen.", vtkBasisBRDF::SPHERICAL_HARMONICS, StabilityZone, 1e-5 } };
  for (const int order : context.Short ? std::vector<int>{ 4 } : std::vector<int>{ 4, 6 })
  {
    const std::string suffix = " " + std::to_string(order);
    for (const Row& row : rows)
    {
      context.Add(row.Name + suffix,
        std::string("condition of the Gram matrix, ") +
          (row.Angles == StabilityZone ? "9 to 57 degrees" : "hemisphere"),
        GetCondition(row.Basis, order, row.Angles, row.Penalty),
        { 1e4, { { "harm." + suffix, Unlimited }, { "harm.+pen." + suffix, Unlimited } },
          "not orthogonal there; the product adds a penalty" });
    }
  }
}

vtkSmartPointer<vtkBRDFFitter> NewLobeFitter(int shape, int lobes)
{
  const auto fitter = vtkSmartPointer<vtkLobeBRDFFitter>::New();
  fitter->SetShape(shape);
  fitter->SetNumberOfLobes(lobes);
  return fitter;
}

//------------------------------------------------------------------------------
// The share of the runs, each with other pairs, whose result is another material than the best of
// them: what differs by more than 5 % of L2 is another optimum.
void RunFits(Context& context)
{
  const int runs = context.Pick(6, 100);
  const BRDF material = context.Choose(BRDF::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint")));
  const std::vector<std::pair<std::string, vtkSmartPointer<vtkBRDFFitter>>> kinds = {
    { "A.-S., 1 lobe", NewLobeFitter(vtkLobeBRDFFitter::ASHIKHMIN_SHIRLEY, 1) },
    { "A.-S., 2 lobes", NewLobeFitter(vtkLobeBRDFFitter::ASHIKHMIN_SHIRLEY, 2) },
    { "Blinn-Phong", NewLobeFitter(vtkLobeBRDFFitter::BLINN_PHONG, 1) },
    { "D-BRDF", vtkSmartPointer<vtkDistributionBRDFFitter>::New() }
  };
  for (const auto& [name, fitter] : kinds)
  {
    std::vector<std::pair<double, BRDF>> results;
    for (int seed = 1; seed <= runs; ++seed)
    {
      Interruptible::Check();
      fitter->SetInput(material);
      fitter->SetNumberOfSamples(4096);
      fitter->SetSeed(static_cast<unsigned int>(seed));
      if (!fitter->Fit())
      {
        throw Error("fit: " + TakeErrorText());
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
}

//------------------------------------------------------------------------------
const std::vector<Case>& GetCases()
{
  static const std::vector<Case> cases = {
    { "ringing", "bases", "harmonics of low order on sharp lobes", RunRinging },
    { "zenith", "bases", "light along the normal, where azimuths mean nothing", RunZenith },
    { "sun", "range", "one texel of 2e5 times the mean", RunSun },
    { "dots", "sampling", "few lights on a sharp lobe", RunDots },
    { "fireflies", "sampling", "bright texels that samples hit or miss", RunFireflies },
    { "horizon", "sampling", "light along the horizon", RunHorizon },
    { "grazing", "geometry", "views at 80 to 89.9 degrees", RunGrazing },
    { "poles", "geometry", "poles and seams of maps and tables", RunPoles },
    { "seams", "geometry", "a sun on the map's seam", RunSeams },
    { "motion", "temporal", "environment, object or camera on the move", RunMotion },
    { "remade", "temporal", "everything made anew for each frame", RunRemade },
    { "oddities", "data", "asymmetry, negative, missing and very large values", RunOddities },
    { "convergence", "convergence", "order of convergence of every method", RunConvergence },
    { "gram", "numeric", "how well bases are conditioned", RunGram },
    { "fits", "numeric", "fits from many starts: the same optimum?", RunFits },
  };
  return cases;
}
} // namespace tool::stability
