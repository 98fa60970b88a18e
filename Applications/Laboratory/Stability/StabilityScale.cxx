// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stability: very small, very large, very many.
#include "Meshes.h"
#include "Progress.h"
#include "Stability.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTabulatedBRDF.h"

#include <dlfcn.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

using namespace tool::stability;

namespace
{
// Drivers compile and allocate for a few frames.
constexpr int WarmUpFrames = 3;

// Small blocks that threads keep for themselves count as in use. A leak of 100 materials' textures
// is 20 MB a frame.
constexpr double LargestGrowth = 1.0; // MB

// OpenGL's names are small numbers, and drivers give those that are free again.
constexpr unsigned int LargestName = 1 << 14;

//------------------------------------------------------------------------------
// VTK's own loader of OpenGL has another name in each of its versions, so the library is asked.
void* FindOpenGLFunction(const char* name)
{
  for (const char* library : { "libOpenGL.so.0", "libGL.so.1" })
  {
    void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL); // kept: it stays loaded anyway
    void* function = handle ? dlsym(handle, name) : nullptr;
    if (function)
    {
      return function;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
// MB that are allocated and not freed, in all threads; 0 where the C library does not tell. On a
// software renderer textures are among them. The size of the process would also follow the
// allocator, the driver's threads and what else the machine does.
double GetHeapInUse()
{
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) * 1e-6;
#else
  return 0.0;
#endif
}

//------------------------------------------------------------------------------
// MB by which the heap grows while something is repeated, from what was in use at the beginning and
// after each repetition. A leak adds in every part of the run; what the C library, the driver or
// its threads set up at a time of their own adds in one. So the run is cut into up to five equal
// parts, and the median of their growths counts for each.
double GetGrowth(const std::vector<double>& inUse)
{
  const std::size_t repetitions = inUse.empty() ? 0 : inUse.size() - 1;
  const std::size_t parts = std::min<std::size_t>(repetitions, 5);
  std::vector<double> growths;
  for (std::size_t k = 0; k < parts; ++k)
  {
    growths.push_back(inUse[(k + 1) * repetitions / parts] - inUse[k * repetitions / parts]);
  }
  if (growths.empty())
  {
    return 0.0;
  }
  const auto median = growths.begin() + static_cast<std::ptrdiff_t>(parts / 2);
  std::nth_element(growths.begin(), median, growths.end());
  return *median * static_cast<double>(parts);
}

//------------------------------------------------------------------------------
// Textures, buffers, framebuffers, renderbuffers, vertex arrays, programs and shaders of the
// current OpenGL context; -1 where that can't be asked.
int CountOpenGLObjects()
{
  int count = 0;
  for (const char* name : { "glIsTexture", "glIsBuffer", "glIsFramebuffer", "glIsRenderbuffer",
         "glIsVertexArray", "glIsProgram", "glIsShader" })
  {
    const auto is = reinterpret_cast<unsigned char (*)(unsigned int)>(FindOpenGLFunction(name));
    if (!is)
    {
      return -1;
    }
    for (unsigned int k = 1; k <= LargestName; ++k)
    {
      count += is(k) != 0;
    }
  }
  return count;
}

//------------------------------------------------------------------------------
void RunEnvironmentSizes(Context& context)
{
  const std::vector<std::pair<int, int>> sizes =
    context.Short ? std::vector<std::pair<int, int>>{ { 1, 1 }, { 3, 5 }, { 256, 128 } }
                  : std::vector<std::pair<int, int>>{ { 1, 1 }, { 2, 1 }, { 1, 64 }, { 3, 5 },
                      { 64, 32 }, { 1024, 512 }, { 8192, 4096 } };
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(20.0));
  const Pairs pairs = MakeSpherePairs(100);
  const std::vector<double> reference =
    IntegrateReference(brdf, MakeEnvironment(256, 128, GetSmoothRadiance), pairs);
  for (const auto& [width, height] : sizes)
  {
    const vtkSmartPointer<vtkEnvironment> environment =
      MakeEnvironment(width, height, GetSmoothRadiance);
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    for (const MethodUnderTest& contender : GetMethodsUnderTest())
    {
      const std::vector<double> radiance = Integrate(contender.Make(brdf, environment), pairs);
      context.Add(
        contender.Name, "negative or not finite, map of " + size, CountBad(radiance), 0.0);
      // Smaller maps are another light.
      if (width >= 64)
      {
        context.Add(contender.Name, "error under a smooth map of " + size,
          GetRelativeL1(radiance, reference),
          { 0.05, { { "filtered", 0.1 } }, "few lights under a smooth sky" });
      }
    }
  }
}

//------------------------------------------------------------------------------
void RunPictureSizes(Context& context)
{
  StabilityRenderer offscreen(context);
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  const int large[2] = { context.Short ? 960 : 3840, context.Short ? 540 : 2160 };
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    // A 4K frame of hundreds of lights takes seconds without a graphics card.
    const bool light = contender.Name == "table" || contender.Name == "auto";
    if (context.Short && !contender.Planned)
    {
      continue;
    }
    offscreen.SetIntegrator(contender.Make(brdf, environment));
    offscreen.SetView(30.0, 20.0, 0.9);
    const std::vector<double> usual = GetCovered(offscreen.Draw(128));
    const auto [least, most] = std::minmax_element(usual.begin(), usual.end());
    double outside = 0.0;
    for (const double fill : { 0.01, 0.03, 0.06 })
    {
      offscreen.SetView(30.0, 20.0, fill);
      for (const double value : GetCovered(offscreen.Draw(64)))
      {
        outside += !(value >= 0.9 * *least && value <= 1.1 * *most);
      }
    }
    context.Add(
      contender.Name, "objects of 1 to 3 pixels: values beyond those of a large one", outside, 0.0);
    if (light || context.Short)
    {
      offscreen.SetView(30.0, 20.0, 0.9);
      offscreen.PlaceCamera(large[0], large[1]);
      const std::vector<double> values = GetCovered(offscreen.DrawAsIs(large[0], large[1]));
      const double mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
      const double expected =
        std::accumulate(usual.begin(), usual.end(), 0.0) / static_cast<double>(usual.size());
      context.Add(contender.Name,
        "mean radiance of a window of " + std::to_string(large[0]) + "x" +
          std::to_string(large[1]) + " against one of 128x128, and bad values",
        std::abs(mean - expected) / expected + offscreen.GetNumberOfBad(), 0.02);
    }
  }
}

//------------------------------------------------------------------------------
// The unit sphere's points times a vector, moved; normals by the inverse.
vtkSmartPointer<vtkPolyData> MakeMoved(const Vector& scale, const Vector& offset)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(tool::MakeSphere());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  for (vtkIdType k = 0; k < mesh->GetNumberOfPoints(); ++k)
  {
    double p[3];
    double n[3];
    mesh->GetPoint(k, p);
    normals->GetTuple(k, n);
    for (std::size_t c = 0; c < 3; ++c)
    {
      p[c] = scale[c] * p[c] + offset[c];
      n[c] /= scale[c];
    }
    vtkMath::Normalize(n);
    points->InsertNextPoint(p);
    normals->SetTuple(k, n);
  }
  mesh->SetPoints(points);
  return mesh;
}

//------------------------------------------------------------------------------
void RunWorlds(Context& context)
{
  const int size = 64;
  StabilityRenderer offscreen(context);
  const vtkSmartPointer<vtkBRDF> brdf = context.Choose(MakePlastic(50.0));
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 64);
  for (const MethodUnderTest& contender : GetMethodsUnderTest())
  {
    if (!contender.Planned && contender.Name != "median-cut")
    {
      continue; // the geometry is before the integrator: the others see the same
    }
    offscreen.SetIntegrator(contender.Make(brdf, environment));
    offscreen.SetMesh(tool::MakeSphere());
    const tool::Picture usual = offscreen.Draw(size);
    const auto compare = [&](const std::string& what, const Vector& scale, const Vector& offset)
    {
      offscreen.SetMesh(MakeMoved(scale, offset));
      const tool::Picture picture = offscreen.Draw(size);
      context.Add(contender.Name, "difference, " + what,
        GetPictureDifference(picture, usual) + offscreen.GetNumberOfBad(), { 5e-3, {}, "" });
    };
    compare("coordinates times 1e6", { 1e6, 1e6, 1e6 }, { 0.0, 0.0, 0.0 });
    compare("coordinates times 1e-6", { 1e-6, 1e-6, 1e-6 }, { 0.0, 0.0, 0.0 });
    compare("1e5 radii from the origin", { 1.0, 1.0, 1.0 }, { 1e5, 1e5, -1e5 });

    // An actor's scale against the same in the mesh.
    const Vector scale = { 10.0, 0.1, 1.0 };
    offscreen.SetMesh(MakeMoved(scale, { 0.0, 0.0, 0.0 }));
    const tool::Picture expected = offscreen.Draw(size);
    offscreen.SetMesh(tool::MakeSphere());
    offscreen.GetActor()->SetScale(scale[0], scale[1], scale[2]);
    const tool::Picture scaled = offscreen.DrawAsIs(size, size);
    context.Add(contender.Name, "difference, an actor's scale of 10, 0.1, 1",
      GetPictureDifference(scaled, expected) + offscreen.GetNumberOfBad(), 5e-3);
    offscreen.GetActor()->SetScale(1.0);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> MakeTableBRDF(int index)
{
  const int dimensions[3] = { 8, 32, 128 };
  std::vector<float> rgb(3 * 8 * 32 * 128);
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    rgb[k] = 0.1f + 0.01f * static_cast<float>((k * 7 + static_cast<std::size_t>(index)) % 13);
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, std::move(rgb));
  return table;
}

//------------------------------------------------------------------------------
// One mapper, a new material each frame.
void RunMaterialChanges(Context& context)
{
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 32);
  struct Kind
  {
    std::string Name;
    int Changes;
    std::function<vtkSmartPointer<vtkBRDF>(int)> Make;
    bool Plans;
  };
  // The planner keeps 16 MB of the last materials, which the first half fills.
  const std::vector<Kind> kinds = { { "light-set", context.Short ? 150 : 1000, MakeTableBRDF,
                                      false },
    { "auto", context.Short ? 50 : 100, [](int k) { return MakePlastic(5.0 + 0.05 * k); }, true } };
  for (const Kind& kind : kinds)
  {
    StabilityRenderer offscreen(context);
    vtkMeasuredBRDFMapper* mapper = offscreen.GetMapper();
    mapper->SetEnvironment(environment);
    mapper->SetIntegrator(kind.Plans ? nullptr : MakeLightLoop(16).Get());
    std::vector<double> heap;
    int objects = 0;
    std::vector<double> times;
    std::set<vtkIdType> bytes;
    for (int k = 0; k < kind.Changes; ++k)
    {
      const auto begin = std::chrono::steady_clock::now();
      mapper->SetBRDF(kind.Make(k));
      offscreen.Draw(32);
      times.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      bytes.insert(mapper->GetTextureBytes());
      // What is set up once is there by then.
      if (k == kind.Changes / 2)
      {
        objects = CountOpenGLObjects();
      }
      if (k >= kind.Changes / 2)
      {
        heap.push_back(GetHeapInUse());
      }
    }
    const std::string what =
      "the second half of " + std::to_string(kind.Changes) + " material changes adds";
    context.Add(kind.Name, "MB in use that " + what, GetGrowth(heap), LargestGrowth,
      std::to_string(*bytes.rbegin()) + " bytes of textures at most");
    context.Add(kind.Name, "OpenGL objects that " + what, CountOpenGLObjects() - objects, 0.0,
      std::to_string(objects) + " objects");
    if (!context.Short && !kind.Plans)
    {
      const auto half = static_cast<std::ptrdiff_t>(times.size() / 4);
      std::nth_element(
        times.begin() + half, times.begin() + half + half / 2, times.begin() + 2 * half);
      const double early = times[static_cast<std::size_t>(half + half / 2)];
      std::nth_element(times.end() - half, times.end() - half / 2, times.end());
      context
        .Add(kind.Name, "time of a change in the last quarter over that in the second",
          *(times.end() - half / 2) / early, 1.5)
        .KnownUpTo(3.0, "other work on the machine");
    }
  }
}

//------------------------------------------------------------------------------
// A crowd: actors side by side, each with its own mapper.
double DrawCrowd(Context& context, int actors, int materials, int frames,
  StabilityRenderer& offscreen, std::set<vtkIdType>& bytes)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(12);
  sphere->SetPhiResolution(8);
  sphere->Update();
  const vtkSmartPointer<vtkEnvironment> environment = context.MakeEnvironment("sky", 32);
  std::vector<vtkSmartPointer<vtkBRDF>> brdfs;
  for (int k = 0; k < materials; ++k)
  {
    brdfs.push_back(materials == 1 ? MakePlastic(10.0) : MakeTableBRDF(k));
  }
  const int side = static_cast<int>(std::ceil(std::sqrt(actors)));
  std::vector<vtkSmartPointer<vtkMeasuredBRDFMapper>> mappers;
  const vtkSmartPointer<vtkRadianceIntegrator> lights = MakeLightLoop(16);
  for (int k = 0; k < actors; ++k)
  {
    auto mapper = vtkSmartPointer<vtkMeasuredBRDFMapper>::New();
    mapper->SetInputConnection(sphere->GetOutputPort());
    mapper->SetBRDF(brdfs[static_cast<std::size_t>(k % materials)]);
    mapper->SetEnvironment(environment);
    mapper->SetIntegrator(materials == 1 ? nullptr : lights.Get());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    const int row = k / side;
    actor->SetPosition(k % side - 0.5 * side, row - 0.5 * side, 0.0);
    offscreen.GetRenderer()->AddActor(actor);
    mappers.push_back(mapper);
  }
  offscreen.GetActor()->VisibilityOff();
  offscreen.PlaceCamera(128, 128);
  offscreen.GetRenderer()->ResetCamera();
  double bad = 0.0;
  for (int k = 0; k < WarmUpFrames; ++k)
  {
    offscreen.DrawAsIs(128, 128);
    bad += offscreen.GetNumberOfBad();
  }
  const int objects = CountOpenGLObjects();
  std::vector<double> heap;
  heap.push_back(GetHeapInUse());
  for (int k = 0; k < frames; ++k)
  {
    offscreen.DrawAsIs(128, 128);
    bad += offscreen.GetNumberOfBad();
    heap.push_back(GetHeapInUse());
  }
  for (const auto& mapper : mappers)
  {
    bytes.insert(mapper->GetTextureBytes());
  }
  context.Add(materials == 1 ? "auto" : "light-set",
    std::to_string(actors) + " actors, " + std::to_string(materials) +
      " materials: negative or not finite",
    bad, 0.0);
  context.Add(materials == 1 ? "auto" : "light-set",
    std::to_string(actors) + " actors, " + std::to_string(materials) +
      " materials: OpenGL objects that later frames add",
    CountOpenGLObjects() - objects, 0.0, std::to_string(objects) + " objects");
  return GetGrowth(heap);
}

//------------------------------------------------------------------------------
void RunCrowds(Context& context)
{
  const int frames = context.Short ? 3 : 10;
  {
    StabilityRenderer offscreen(context);
    std::set<vtkIdType> bytes;
    context.Add("light-set", "MB in use that later frames add, 100 materials",
      DrawCrowd(context, 100, 100, frames, offscreen, bytes), LargestGrowth);
  }
  StabilityRenderer offscreen(context);
  const int actors = context.Short ? 100 : 1000;
  const double start = GetHeapInUse();
  std::set<vtkIdType> bytes;
  context.Add("auto", "MB in use that later frames add, " + std::to_string(actors) + " actors",
    DrawCrowd(context, actors, 1, frames, offscreen, bytes), LargestGrowth);
  context.Add("auto",
    "kB in use that an actor adds, " + std::to_string(actors) + " actors of one material",
    1e3 * (GetHeapInUse() - start) / actors, 400.0,
    "one plan for all, " + std::to_string(*bytes.begin()) + " bytes of textures");
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
void AddScaleCases(std::vector<Case>& cases)
{
  cases.push_back(
    { "environment-sizes", "scale", "environments from 1x1 to 8192x4096", RunEnvironmentSizes });
  cases.push_back(
    { "picture-sizes", "scale", "objects of a pixel, windows of 4K", RunPictureSizes });
  cases.push_back({ "worlds", "scale", "coordinates and actors far from 1", RunWorlds });
  cases.push_back(
    { "material-changes", "scale", "a new material each frame: leaks", RunMaterialChanges });
  cases.push_back({ "crowds", "scale", "100 materials, 1000 actors", RunCrowds });
}
} // namespace tool::stability
