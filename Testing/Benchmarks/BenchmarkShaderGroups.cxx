// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a pixel of a radiance table pays: frames with one group of the shader's instructions
// replaced by next to nothing, beside the whole shader and VTK's PBR, drawn in turns. The tables of
// docs/methods/pixel-cost.md and docs/graphics-card.md.
//
//   BenchmarkShaderGroups [ROUNDS [pixels]]
//
// Frames are for software renderers: processor time of the process, of all its threads, so that
// other programs' load matters little. `pixels` is for graphics cards: wall-clock time of layers of
// squares in a large window, of which all pixels are shaded. Needs an OpenGL context.
#include "FrameScene.h"
#include "SquareLayers.h"
#include "vtkBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkShaderProperty.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{
constexpr int Frames = 4; // a turn
constexpr int Layers = 16;

struct View
{
  int Width, Height;
  double Radius; // what the window shows to either side, up and down
  bool IsProcessorTime;
};

// Text of the shader, and what stands in its place.
using Replacements = std::vector<std::pair<std::string, std::string>>;

struct Group
{
  std::string Name;
  Replacements Texts;
};

// Of lamps beside a table.
const std::vector<Group>& GetLampGroups()
{
  static const std::vector<Group> groups{
    { "the material's values",
      { { "brdfMember0Evaluate(i.z > 0.0 ? i : vec3(0.0, 0.0, 1.0), o)", "i" } } },
    { "lamps after the first that is found", { { "while (found != 0)", "while (false)" } } },
    { "lamps", { { "brdfAddLamps0(frame, o, d, lambert)", "vec3(0.0)" } } },
  };
  return groups;
}

const std::vector<Group>& GetTableGroups()
{
  static const Group fetches{ "two fetches of the table",
    { { "texture(brdfTableRadiance0, at).rgb", "at" } } };
  static const Group irradiance{ "the fetch of irradiance, and its octahedron",
    { { "texture(brdfTableIrradiance0, normalAt).rgb", "vec3(0.5)" } } };
  static const Group profile{ "the profile's texels",
    { { "texelFetch(brdfTableProfile0, ivec2(view, 0), 0)", "vec4(rest)" },
      { "texelFetch(brdfTableProfile0, ivec2(view, 1), 0)", "vec4(0.5)" } } };
  static const Group view{ "the view's angle: an arc tangent, a root, a power",
    { { "max(1.0 - brdfQuadrant(sine, o.z) / brdfTableLastView0, 0.0)", "o.z" },
      { "(1.0 - sqrt(rest))", "rest" }, { "pow(rest, 2.0 / 3.0)", "rest" } } };
  static const Group azimuth{ "the axis' azimuth and polar angle: two arc tangents",
    { { "return vec2(brdfTurn(azimuth), 0.5 * (d.y >= 0.0 ? polar : 2.0 - polar));",
      "return azimuth;" } } };
  static const Group turn{ "psi: an arc tangent",
    { { "float psi = brdfTurn(turn);", "float psi = turn.x;" } } };
  static const Group tone{ "the output's powers",
    { { "pow(brdfRadiance, vec3(1.0 / 2.2))", "brdfRadiance" } } };
  static const Group all{ "all of these", {} };
  static const std::vector<Group> groups = [&]()
  {
    std::vector<Group> list{ fetches, irradiance, profile, view, azimuth, turn, tone, all };
    for (std::size_t k = 0; k + 1 < list.size(); ++k)
    {
      list.back().Texts.insert(list.back().Texts.end(), list[k].Texts.begin(), list[k].Texts.end());
    }
    return list;
  }();
  return groups;
}

class Picture : public FrameScene
{
public:
  Picture(vtkPolyDataMapper* mapper, vtkPolyData* surface, const View& view)
    : FrameScene(view.Width, view.Height, view.Radius)
    , IsProcessorTime(view.IsProcessorTime)
  {
    mapper->SetInputData(surface);
    this->Actor->SetMapper(mapper);
    this->Renderer->ResetCameraClippingRange();
  }

  // ms a frame.
  void Draw(bool counts)
  {
    this->Window->Render(); // another window came before: this one does not count
    this->Window->WaitForCompletion();
    const double start = this->GetNow();
    for (int frame = 0; frame < Frames; ++frame)
    {
      this->Window->Render();
      this->Window->WaitForCompletion();
    }
    if (counts)
    {
      this->Times.push_back((this->GetNow() - start) / Frames);
    }
  }

  double GetTime()
  {
    std::sort(this->Times.begin(), this->Times.end());
    return this->Times[this->Times.size() / 2];
  }

private:
  // ms
  double GetNow() const
  {
    using Milliseconds = std::chrono::duration<double, std::milli>;
    return this->IsProcessorTime
             ? 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC
             : Milliseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  bool IsProcessorTime;
  std::vector<double> Times;
};

std::unique_ptr<Picture> MakePBR(
  vtkEnvironment* environment, vtkPolyData* surface, const View& view)
{
  vtkNew<vtkPolyDataMapper> mapper;
  auto picture = std::make_unique<Picture>(mapper, surface, view);
  picture->ShadeByPBR(environment);
  return picture;
}

struct Case
{
  std::string Title;
  std::string Material;
  int Lights;
  const std::vector<Group>& Groups;
};

std::unique_ptr<Picture> MakeMeasured(vtkEnvironment* environment, vtkPolyData* surface,
  const View& view, vtkRadianceIntegrator* integrator, const std::string& material,
  const Replacements& texts)
{
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetBRDF(GetEmbedded(material));
  mapper->SetEnvironment(environment);
  mapper->SetIntegrator(integrator);
  auto picture = std::make_unique<Picture>(mapper, surface, view);
  for (const auto& [text, replacement] : texts)
  {
    picture->Actor->GetShaderProperty()->AddFragmentShaderReplacement(
      text, false, replacement, true);
  }
  return picture;
}

// Median ms of a frame with VTK's PBR, with the whole shader, and without each group.
std::vector<double> TimeGroups(
  const Case& which, vtkPolyData* surface, const View& view, int rounds)
{
  const auto hall =
    vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("hall"));
  vtkNew<vtkHybridRadianceIntegrator> table;
  table->SetSizes({ 33, 12, 16, 0, which.Lights, 12 });
  std::vector<std::unique_ptr<Picture>> pictures;
  pictures.push_back(MakePBR(hall, surface, view));
  pictures.push_back(MakeMeasured(hall, surface, view, table, which.Material, {}));
  for (const Group& group : which.Groups)
  {
    pictures.push_back(MakeMeasured(hall, surface, view, table, which.Material, group.Texts));
  }
  for (int round = -1; round < rounds; ++round)
  {
    for (auto& picture : pictures)
    {
      picture->Draw(round >= 0);
    }
  }
  std::vector<double> times;
  for (auto& picture : pictures)
  {
    times.push_back(picture->GetTime());
  }
  return times;
}

void Print(const Case& which, const std::string& title, const std::string& unit,
  const std::vector<double>& times)
{
  std::cout << "\n"
            << which.Title << ": " << title << "\n\n| | " << unit
            << " | relative to PBR | share of the whole |\n|---|---|---|---|\n"
            << std::setprecision(3);
  for (std::size_t k = 0; k < times.size(); ++k)
  {
    const std::string name = k == 0   ? "VTK's PBR"
                             : k == 1 ? "whole"
                                      : "without " + which.Groups[k - 2].Name;
    std::cout << "| " << name << " | " << times[k] << " | " << times[k] / times[0] << " | "
              << 100.0 * (times[1] - times[k]) / times[1] << " % |\n";
  }
  std::cout << std::flush;
}

void PrintFrames(const Case& which, vtkPolyData* surface, int rounds)
{
  Print(which,
    "frames of a sphere of " + std::to_string(surface->GetNumberOfPolys()) + " triangles",
    "ms of processor time", TimeGroups(which, surface, { 500, 500, 0.5, true }, rounds));
}

// The first layer holds what a frame takes besides.
void PrintPixels(const Case& which, int rounds)
{
  constexpr View view{ 1920, 1080, 1.0, false };
  const std::vector<double> one =
    TimeGroups(which, measuredbrdf::MakeSquareLayers(1, 2.0), view, rounds);
  std::vector<double> times =
    TimeGroups(which, measuredbrdf::MakeSquareLayers(Layers, 2.0), view, rounds);
  for (std::size_t k = 0; k < times.size(); ++k)
  {
    times[k] = 1e6 * (times[k] - one[k]) / (1.0 * view.Width * view.Height * (Layers - 1));
  }
  Print(which, "a pixel, of " + std::to_string(Layers) + " layers", "ns", times);
}
}

int main(int argc, char** argv)
{
  const int rounds = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 15;
  const bool isPixels = argc > 2 && std::string(argv[2]) == "pixels";
  const Case cases[] = { { "A table", "gold-paint", 0, GetTableGroups() },
    { "A table and lamps", "nickel", 16, GetLampGroups() } };
  for (const Case& which : cases)
  {
    if (isPixels)
    {
      PrintPixels(which, rounds);
      continue;
    }
    PrintFrames(which, MakeSphere(0.5), rounds);
    PrintFrames(which, MakeBumps(0.5, 0.03, 25.0, 20.0), rounds);
  }
  return 0;
}
