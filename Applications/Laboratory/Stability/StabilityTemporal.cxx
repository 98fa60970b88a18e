// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: what moves must move as the reference does. Flicker ratio: the mean change from frame
// to frame over that of the reference.
#include "Meshes.h"
#include "Scenes.h"
#include "Stability.h"
#include "Surface.h"
#include "TracedSurface.h"

#include "vtkLightSet.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace tool::stability;

namespace
{
constexpr double Threshold = 1.1;

using Frames = std::vector<std::vector<double>>;

/// Something that moves: the environment's rotation and the pairs, by frame.
struct Motion
{
  std::string Name;
  std::function<double(int)> Rotation; // degrees
  std::function<Pairs(int)> Points;
};

//------------------------------------------------------------------------------
double GetChange(const Frames& frames)
{
  double sum = 0.0;
  for (std::size_t t = 1; t < frames.size(); ++t)
  {
    for (std::size_t k = 0; k < frames[t].size(); ++k)
    {
      sum += std::abs(frames[t][k] - frames[t - 1][k]);
    }
  }
  return sum;
}

double GetFlicker(const Frames& frames, const Frames& reference)
{
  return GetChange(frames) / GetChange(reference);
}

//------------------------------------------------------------------------------
Pairs Move(const Pairs& pairs, const std::function<Vector(const Vector&)>& normal,
  const std::function<Vector(const Vector&, const Vector&)>& view)
{
  Pairs moved;
  for (std::size_t k = 0; k < pairs.Normals.size(); k += 3)
  {
    const Vector n = { pairs.Normals[k], pairs.Normals[k + 1], pairs.Normals[k + 2] };
    const Vector v = { pairs.Views[k], pairs.Views[k + 1], pairs.Views[k + 2] };
    moved.Add(normal(n), view(n, v));
  }
  return moved;
}

//------------------------------------------------------------------------------
// Steps of 0.1 degree are left out where few motions are wanted.
std::vector<Motion> GetMotions(const Pairs& sphere, bool isShort)
{
  const auto same = [](const Vector& v) { return v; };
  const auto still = [](int) { return 0.0; };
  const auto turning = [sphere](double step)
  {
    return [sphere, step](int t)
    {
      return Move(
        sphere, [&](const Vector& n) { return Turn(n, step * t); },
        [](const Vector&, const Vector& v) { return v; });
    };
  };
  std::vector<Motion> motions = {
    { "environment by 0.1 degree", [](int t) { return 0.1 * t; },
      [sphere](int) { return sphere; } },
    { "environment by 1 degree", [](int t) { return 1.0 * t; }, [sphere](int) { return sphere; } },
    { "object by 0.1 degree", still, turning(0.1) },
    { "object by 1 degree", still, turning(1.0) },
    { "camera orbit by 1 degree", still,
      [sphere, same](int t) {
        return Move(sphere, same, [&](const Vector&, const Vector& v) { return Turn(v, 1.0 * t); });
      } },
    { "zoom by 5 %", still,
      [sphere, same](int t)
      {
        // The sphere's own points, seen by a camera that comes nearer.
        const double distance = 6.0 * std::pow(0.95, t);
        return Move(sphere, same,
          [&](const Vector& n, const Vector& v)
          {
            Vector view;
            for (std::size_t c = 0; c < 3; ++c)
            {
              view[c] = distance * v[c] - n[c];
            }
            vtkMath::Normalize(view.data());
            return view;
          });
      } },
  };
  if (isShort)
  {
    motions.erase(
      std::remove_if(motions.begin(), motions.end(),
        [](const Motion& motion) { return motion.Name.find("0.1 degree") != std::string::npos; }),
      motions.end());
  }
  return motions;
}

//------------------------------------------------------------------------------
// Light that small sets, tables and samples all have trouble with: a sun low above the horizon.
vtkSmartPointer<vtkEnvironment> MakeLowSun(int width)
{
  return MakeEnvironment(width, width / 2,
    [](const Vector& d)
    {
      const double sun = 200.0 * std::exp(300.0 * (0.8 * d[0] + 0.1 * d[1] + 0.5916 * d[2] - 1.0));
      return Vector{ 0.5 + 0.4 * d[1] + sun, 0.5 + 0.4 * d[1] + 0.8 * sun,
        0.6 + 0.4 * d[1] + 0.5 * sun };
    });
}

//------------------------------------------------------------------------------
Frames Play(vtkRadianceIntegrator* integrator, const Motion& motion, int frames)
{
  Frames played;
  for (int t = 0; t < frames; ++t)
  {
    integrator->GetEnvironment()->SetRotationY(motion.Rotation(t));
    played.push_back(Integrate(integrator, motion.Points(t)));
  }
  integrator->GetEnvironment()->SetRotationY(0.0);
  return played;
}

Frames PlayExactly(vtkBRDF* brdf, vtkEnvironment* environment, const Motion& motion, int frames)
{
  Frames played;
  for (int t = 0; t < frames; ++t)
  {
    environment->SetRotationY(motion.Rotation(t));
    played.push_back(IntegrateReference(brdf, environment, motion.Points(t)));
  }
  environment->SetRotationY(0.0);
  return played;
}

//------------------------------------------------------------------------------
void RunMotion(Context& context)
{
  const int count = context.Short ? 4 : 9;
  const int width = 128;
  const std::vector<Motion> motions =
    GetMotions(MakeSpherePairs(context.Short ? 100 : 250), context.Short);
  struct Scene
  {
    std::string Name;
    vtkSmartPointer<vtkBRDF> BRDF;
    vtkSmartPointer<vtkEnvironment> Environment;
  };
  std::vector<Scene> scenes = { { "sky, exponent 50", context.Choose(MakePlastic(50.0)),
                                  context.MakeEnvironment("sky", width) },
    { "low sun, exponent 50", MakePlastic(50.0), MakeLowSun(width) },
    { "sky, exponent 300", MakePlastic(300.0), context.MakeEnvironment("sky", width) } };
  if (context.Short) // `remade` and `rendered-motion` have the first scene, too
  {
    scenes.erase(scenes.begin());
  }
  for (const Scene& scene : scenes)
  {
    std::vector<Frames> references;
    for (const Motion& motion : motions)
    {
      references.push_back(PlayExactly(scene.BRDF, scene.Environment, motion, count));
    }
    for (const MethodUnderTest& contender : GetMethodsUnderTest())
    {
      const vtkSmartPointer<vtkRadianceIntegrator> integrator =
        contender.Make(scene.BRDF, scene.Environment);
      for (std::size_t m = 0; m < motions.size(); ++m)
      {
        context.Add(contender.Name, "flicker ratio, " + scene.Name + ", " + motions[m].Name,
          GetFlicker(Play(integrator, motions[m], count), references[m]),
          { Threshold,
            { { "median-cut", 2.0 }, { "importance", 2.0 }, { "variance", 2.0 },
              { "thesis", 4.0 } },
            "dots and rings that pass over the surface" });
      }
    }
  }
}

//------------------------------------------------------------------------------
// The map's own pixels turn, so everything is made anew for each frame.
void RunRemade(Context& context)
{
  const int count = context.Short ? 4 : 9;
  const double step = 0.6; // columns of 128: 1.7 degrees
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 128);
  const Pairs pairs = MakeSpherePairs(context.Short ? 120 : 250);
  std::vector<vtkSmartPointer<vtkEnvironment>> maps;
  Frames reference;
  for (int t = 0; t < count; ++t)
  {
    maps.push_back(Roll(environment, step * t));
    reference.push_back(IntegrateReference(brdf, maps.back(), pairs));
  }
  const auto play = [&](const std::function<vtkSmartPointer<vtkRadianceIntegrator>(int)>& make)
  {
    Frames frames;
    for (int t = 0; t < count; ++t)
    {
      frames.push_back(Integrate(make(t), pairs));
    }
    return GetFlicker(frames, reference);
  };
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    context.Add(contender.Name, "flicker ratio, all made anew for each turned map",
      play([&](int t) { return contender.Make(brdf, maps[static_cast<std::size_t>(t)]); }),
      { Threshold,
        { { "median-cut", 4.0 }, { "importance", 4.0 }, { "thesis", 4.0 }, { "filtered", 2.0 } },
        "cut anew after the map's pixels turned: shown on purpose" });
  }
  context
    .Add("importance", "flicker ratio, lights drawn anew for each frame",
      play(
        [&](int t)
        {
          return MakeLightLoop(brdf, environment,
            MakeLights(maps[static_cast<std::size_t>(t)], "importance", 64,
              static_cast<unsigned int>(t + 1)));
        }),
      Threshold)
    .KnownUpTo(Unlimited, "random sampling re-drawn per frame: shown on purpose");
}

//------------------------------------------------------------------------------
// Plans change where the material or the light does: what shows of that?
void RunPlanSwitches(Context& context)
{
  const int count = context.Short ? 6 : 16;
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const Pairs pairs = MakeSpherePairs(context.Short ? 120 : 250);
  Frames frames;
  Frames reference;
  std::set<std::string> plans;
  for (int t = 0; t < count; ++t)
  {
    const vtkSmartPointer<vtkBRDF> brdf =
      MakePlastic(8.0 * std::pow(16.0, static_cast<double>(t) / (count - 1)));
    vtkNew<vtkRadiancePlanner> planner;
    planner->SetBRDF(brdf);
    planner->SetEnvironment(environment);
    planner->Update();
    plans.insert(planner->GetDescription(planner->GetChoice()));
    const auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
    frames.push_back(Integrate(integrator, pairs));
    reference.push_back(IntegrateReference(brdf, environment, pairs));
  }
  context.Add("auto", "flicker ratio, exponent 8 to 128 by frames, planned for each",
    GetFlicker(frames, reference), Threshold, std::to_string(plans.size()) + " different plans");
}

//------------------------------------------------------------------------------
// The same on the GPU, through the mapper.
void RunMapper(Context& context)
{
  const int frames = context.Short ? 3 : 6;
  const tool::Size size = { 64, 64 };
  const tool::View view = { 30.0, 20.0 };
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const tool::Surface surface = tool::FindSurface(tool::MakeSphere(), view, 0.9, size, 400);
  const Motion motion = { "", [](int t) { return 1.0 * t; },
    [&](int) {
      return Pairs{ surface.Normals, surface.Views };
    } };
  const Frames reference = PlayExactly(brdf, environment, motion, frames);
  StabilityRenderer offscreen(context);
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    offscreen.SetIntegrator(contender.Make(brdf, environment));
    Frames drawn;
    for (int t = 0; t < frames; ++t)
    {
      environment->SetRotationY(motion.Rotation(t));
      drawn.push_back(tool::Pick(offscreen.Draw(size.Width), surface));
    }
    environment->SetRotationY(0.0);
    context.Add(contender.Name, "flicker ratio of rendered frames, environment by 1 degree",
      GetFlicker(drawn, reference),
      { Threshold, { { "median-cut", 2.0 }, { "importance", 2.0 }, { "thesis", 3.0 } },
        "dots and rings that pass over the surface" });
  }
}

//------------------------------------------------------------------------------
// Under what the mesh hides of it. The map turns by a column of texels a frame, so that the traced
// truth, a ray to each texel, has the same directions in all frames.
void RunOccluded(Context& context)
{
  const int frames = context.Short ? 3 : 6;
  const int width = 128;
  const tool::Size size = { 96, 96 };
  const tool::View view = { 14.0, 30.0 };
  const double fill = 0.9;
  const vtkSmartPointer<vtkPolyData> mesh = tool::LoadMesh("ball-on-foot");
  const tool::Surface surface = tool::FindSurface(mesh, view, fill, size, 150);
  tool::TraceOptions everyTexel;
  everyTexel.Samples = 0;
  const auto traced = tool::MakeTracedScene(mesh);
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(mesh);
  std::vector<std::pair<std::string, vtkSmartPointer<vtkBRDF>>> materials = { { "exponent 50",
    context.Choose(MakePlastic(50.0)) } };
  if (!context.Short)
  {
    materials.emplace_back("Lambert", MakeLambert(0.5));
  }
  for (const auto& [name, brdf] : materials)
  {
    const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", width);
    StabilityRenderer offscreen(context);
    offscreen.SetMesh(mesh);
    offscreen.SetView(view.Azimuth, view.Elevation, fill);
    offscreen.PlaceCamera(size.Width, size.Height);
    const auto setRotation = [&](int t) { environment->SetRotationY(360.0 / width * t); };
    Frames truth;
    for (int t = 0; t < frames; ++t)
    {
      setRotation(t);
      truth.push_back(
        tool::TraceSurface(traced, brdf, environment, offscreen, surface, size, everyTexel)
          .Radiance);
    }
    offscreen.GetMapper()->SetInputConnection(filter->GetOutputPort());
    for (const MethodUnderTest& contender : GetMethodsUnderTest())
    {
      if (contender.Name != "table" && contender.Name != "hybrid" && contender.Name != "auto")
      {
        continue;
      }
      offscreen.SetIntegrator(contender.Make(brdf, environment));
      Frames drawn;
      for (int t = 0; t < frames; ++t)
      {
        setRotation(t);
        drawn.push_back(tool::Pick(offscreen.Draw(size.Width), surface));
      }
      context.Add(contender.Name, "flicker ratio with occlusion, " + name + ", environment turns",
        GetFlicker(drawn, truth), Threshold);
    }
    environment->SetRotationY(0.0);
  }
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void AddTemporalCases(std::vector<Case>& cases)
{
  cases.push_back({ "motion", "temporal", "environment, object or camera on the move", RunMotion });
  cases.push_back({ "remade", "temporal", "everything made anew for each frame", RunRemade });
  cases.push_back({ "plan-switches", "temporal", "plans that change on the way", RunPlanSwitches });
  cases.push_back(
    { "rendered-motion", "temporal", "the environment turns, on the GPU", RunMapper });
  cases.push_back({ "occluded-motion", "temporal",
    "the environment turns about a mesh that hides a part of it, on the GPU", RunOccluded });
}
} // namespace tool::stability
