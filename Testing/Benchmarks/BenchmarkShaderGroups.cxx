// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What a pixel of a radiance table pays: frames with one group of the shader's instructions
// replaced by next to nothing, beside the whole shader and VTK's PBR, drawn in turns. Processor
// time of the process, of all its threads: other programs' load matters little. The table of
// docs/methods.md.
//
// usage: BenchmarkShaderGroups [ROUNDS]. Needs an OpenGL context (llvmpipe).
#include "FrameScene.h"
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
constexpr int Side = 500;
constexpr int Frames = 4; // a turn

// Text of the shader, and what stands in its place.
using Replacements = std::vector<std::pair<std::string, std::string>>;

struct Group
{
  std::string Name;
  Replacements Texts;
};

const std::vector<Group>& GetGroups()
{
  static const Group fetches{ "two fetches of the table",
    { { "texture(brdfTableRadiance0, at).rgb", "at" } } };
  static const Group irradiance{ "the fetch of irradiance, and its octahedron",
    { { "texture(brdfTableIrradiance0, normalAt).rgb", "vec3(0.5)" } } };
  static const Group profile{ "the profile's texel, and taking it apart",
    { { "texelFetch(brdfTableProfile0, ivec2(view, 0), 0)", "vec4(rest)" },
      { "floor(pairs.rgb)", "vec3(0.5)" } } };
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
  Picture(vtkPolyDataMapper* mapper, vtkPolyData* surface)
    : FrameScene(Side, Side, 0.5)
  {
    mapper->SetInputData(surface);
    this->Actor->SetMapper(mapper);
    this->Renderer->ResetCameraClippingRange();
  }

  // ms of processor time a frame.
  void Draw(bool counts)
  {
    const std::clock_t start = std::clock();
    for (int frame = 0; frame < Frames; ++frame)
    {
      this->Window->Render();
      this->Window->WaitForCompletion();
    }
    if (counts)
    {
      this->Times.push_back(
        1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / Frames);
    }
  }

  double GetTime()
  {
    std::sort(this->Times.begin(), this->Times.end());
    return this->Times[this->Times.size() / 2];
  }

private:
  std::vector<double> Times;
};

std::unique_ptr<Picture> MakePBR(vtkEnvironment* environment, vtkPolyData* surface)
{
  vtkNew<vtkPolyDataMapper> mapper;
  auto picture = std::make_unique<Picture>(mapper, surface);
  picture->ShadeByPBR(environment);
  return picture;
}

std::unique_ptr<Picture> MakeMeasured(vtkEnvironment* environment, vtkPolyData* surface,
  vtkRadianceIntegrator* integrator, const Replacements& texts)
{
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetBRDF(GetEmbedded("gold-paint"));
  mapper->SetEnvironment(environment);
  mapper->SetIntegrator(integrator);
  auto picture = std::make_unique<Picture>(mapper, surface);
  for (const auto& [text, replacement] : texts)
  {
    picture->Actor->GetShaderProperty()->AddFragmentShaderReplacement(
      text, false, replacement, true);
  }
  return picture;
}

void Measure(const std::string& title, bool isLarge, int rounds)
{
  const auto surface = isLarge ? MakeBumps(0.5, 0.03, 25.0, 20.0) : MakeSphere(0.5);
  const auto hall =
    vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("hall"));
  vtkNew<vtkHybridRadianceIntegrator> table;
  table->SetSizes({ 33, 12, 16, 0, 0, 12 });
  std::vector<std::pair<std::string, std::unique_ptr<Picture>>> pictures;
  pictures.emplace_back("VTK's PBR", MakePBR(hall, surface));
  pictures.emplace_back("whole", MakeMeasured(hall, surface, table, {}));
  for (const Group& group : GetGroups())
  {
    pictures.emplace_back("without " + group.Name, MakeMeasured(hall, surface, table, group.Texts));
  }
  for (int round = -1; round < rounds; ++round)
  {
    for (auto& [name, picture] : pictures)
    {
      picture->Draw(round >= 0);
    }
  }
  const double base = pictures[0].second->GetTime();
  const double whole = pictures[1].second->GetTime();
  std::cout << "\n"
            << title << ", " << surface->GetNumberOfPolys() << " triangles\n\n"
            << "| | ms | relative to PBR | share of the whole |\n|---|---|---|---|\n"
            << std::setprecision(3);
  for (auto& [name, picture] : pictures)
  {
    const double time = picture->GetTime();
    std::cout << "| " << name << " | " << time << " | " << time / base << " | "
              << 100.0 * (whole - time) / whole << " % |\n";
  }
}
}

int main(int argc, char** argv)
{
  const int rounds = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 15;
  Measure("A sphere", false, rounds);
  Measure("A sphere with bumps", true, rounds);
  return 0;
}
