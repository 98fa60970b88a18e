// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Frames of every method beside VTK's PBR under image-based light, on the renderer at hand, frames
// taken in turns: a sphere of 64,000 triangles and a mesh of half a million in windows of several
// sizes (wall-clock time of a frame, as an application waits for it), and what one pixel costs.
// A frame on a graphics card takes most of its time on the processor. So a pixel's cost comes from
// layers of squares, each nearer than the one before, of which all pixels are shaded.
// Prints the tables of docs/graphics-card.md. Needs an OpenGL context.
//
//   BenchmarkFrames [ROUNDS [LARGEST [PART]]]
//
// ROUNDS: frames of each kind in turns (default 15). LARGEST: height of the largest window
// (default 2160); 500 is enough for a software renderer. PART: occlusion, sphere, bumps or pixels.
#include "BrushedMetal.h"
#include "FrameScene.h"
#include "SquareLayers.h"
#include "vtkBRDF.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEnvironment.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMedianCutLightSetGenerator.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceVisibilityFilter.h"
#include "vtkTableRadianceIntegrator.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
struct Method
{
  std::string Name;
  vtkSmartPointer<vtkBRDF> BRDF;                     // none: VTK's PBR
  vtkSmartPointer<vtkRadianceIntegrator> Integrator; // none: the planner's choice
};

vtkSmartPointer<vtkEnvironment> GetHall()
{
  return vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("hall"));
}

vtkSmartPointer<vtkRadianceIntegrator> MakeTable(std::vector<int> sizes, int maps, int lights)
{
  auto table = vtkSmartPointer<vtkHybridRadianceIntegrator>::New();
  table->SetNumberOfMaps(maps);
  table->SetSizes(std::move(sizes));
  table->SetMaximumNumberOfLights(lights);
  return table;
}

vtkSmartPointer<vtkRadianceIntegrator> MakeSamples(int number)
{
  auto samples = vtkSmartPointer<vtkFilteredRadianceIntegrator>::New();
  samples->SetNumberOfSamples(number);
  return samples;
}

vtkSmartPointer<vtkRadianceIntegrator> MakeLights(int number, bool isSoft = false)
{
  auto lights = vtkSmartPointer<vtkLightSetRadianceIntegrator>::New();
  if (!isSoft)
  {
    lights->SetGenerator(vtkNew<vtkMedianCutLightSetGenerator>());
  }
  lights->SetNumberOfLights(number);
  lights->SetSoftLights(isSoft);
  return lights;
}

vtkSmartPointer<vtkRadianceIntegrator> MakeAnisotropicTable()
{
  auto table = vtkSmartPointer<vtkTableRadianceIntegrator>::New();
  table->SetSizes({ 33, 8, 32, 8 });
  return table;
}

const std::vector<Method>& GetMethods()
{
  static const auto paint = GetEmbedded("gold-paint");
  static const auto nickel = GetEmbedded("nickel");
  static const auto volume = MakeLargeTable();
  static const vtkSmartPointer<vtkBRDF> brushed = NewBrushedMetal(0.1, 0.4);
  static const std::vector<Method> methods = {
    { "VTK's PBR", nullptr, nullptr },
    { "AUTO, gold paint", paint, nullptr },
    { "AUTO, nickel", nickel, nullptr },
    { "AUTO, Lambert", vtkSmartPointer<vtkLambertBRDF>::New(), nullptr },
    { "table, 33 x 12 x 16", paint, MakeTable({ 33, 12, 16, 0, 0, 12 }, 0, 0) },
    { "table, 129 x 20 x 16", paint, MakeTable({ 129, 20, 16, 0, 0, 12 }, 0, 0) },
    { "table and 16 lamps", nickel, MakeTable({ 33, 12, 16, 0, 0, 12 }, 0, 16) },
    { "table, 16 maps and 16 lamps", nickel, MakeTable({ 128, 12, 8 }, 16, 16) },
    { "anisotropic table, 33 x 8 x 32 x 8", brushed, MakeAnisotropicTable() },
    { "16 filtered samples", paint, MakeSamples(16) },
    { "64 filtered samples", paint, MakeSamples(64) },
    { "16 lights, closed form", paint, MakeLights(16) },
    { "64 lights, closed form", paint, MakeLights(64) },
    { "256 lights, closed form", paint, MakeLights(256) },
    { "64 lights, table of MERL's size", volume, MakeLights(64) },
    { "64 lights, thesis, order 6", MakeBasis(6), MakeLights(64) },
    { "64 soft lights, brushed", brushed, MakeLights(64, true) },
  };
  return methods;
}

constexpr double WindowWidth = 2.0; // of layers: more than any window is wide

vtkSmartPointer<vtkPolyData> GetBumps() { return MakeBumps(1.0, 0.05, 12.0, 10.0); }

class Picture : public FrameScene
{
public:
  Picture(const Method& method, vtkPolyData* surface, int width, int height)
    : FrameScene(width, height, 1.0)
  {
    vtkSmartPointer<vtkPolyDataMapper> mapper;
    this->Hall = GetHall();
    if (method.BRDF)
    {
      this->Measured = vtkSmartPointer<vtkMeasuredBRDFMapper>::New();
      this->Measured->GlobalWarningDisplayOff(); // brushed metal on surfaces without tangents
      this->Measured->SetBRDF(method.BRDF);
      this->Measured->SetEnvironment(this->Hall);
      if (method.Integrator)
      {
        this->Measured->SetIntegrator(method.Integrator);
      }
      mapper = this->Measured;
    }
    else
    {
      mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
      this->ShadeByPBR(this->Hall);
    }
    mapper->SetInputData(surface);
    this->Actor->SetMapper(mapper);
    this->Renderer->ResetCameraClippingRange();
  }

  std::string GetRendererName()
  {
    this->Draw(); // makes the context
    std::istringstream lines(this->Window->ReportCapabilities());
    for (std::string line; std::getline(lines, line);)
    {
      if (line.rfind("OpenGL renderer string:", 0) == 0)
      {
        return line.substr(line.find(':') + 1);
      }
    }
    return " unknown";
  }

  vtkMeasuredBRDFMapper* GetMeasured() { return this->Measured; }

  vtkEnvironment* GetEnvironment() { return this->Hall; }

private:
  vtkSmartPointer<vtkEnvironment> Hall;
  vtkSmartPointer<vtkMeasuredBRDFMapper> Measured;
};

constexpr double Slowest = 1000.0; // ms: frames beyond are not drawn again

// Medians, of pictures drawn in turns; NaN where a frame takes too long.
std::vector<double> TimeInTurns(std::vector<std::unique_ptr<Picture>>& pictures, int rounds)
{
  std::vector<std::vector<double>> times(pictures.size());
  for (int round = -2; round < rounds; ++round)
  {
    for (std::size_t k = 0; k < pictures.size(); ++k)
    {
      if (!pictures[k])
      {
        continue;
      }
      pictures[k]->Draw(); // another window came before: this one does not count
      const double time = round > -2 ? pictures[k]->Draw() : 0.0; // after shaders are made
      if (time > Slowest)
      {
        pictures[k].reset();
        times[k] = { std::nan("") };
      }
      else if (round >= 0)
      {
        times[k].push_back(time);
      }
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& list : times)
  {
    medians.push_back(GetMedian(list));
  }
  return medians;
}

std::string Format(double value)
{
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return std::isnan(value) ? "-" : text.str();
}

struct Size
{
  int Width, Height;
};

std::vector<double> TimeMethods(vtkPolyData* surface, const Size& size, int rounds)
{
  std::vector<std::unique_ptr<Picture>> pictures;
  for (const Method& method : GetMethods())
  {
    pictures.push_back(std::make_unique<Picture>(method, surface, size.Width, size.Height));
  }
  return TimeInTurns(pictures, rounds);
}

void PrintFrames(
  const std::string& title, vtkPolyData* surface, const std::vector<Size>& sizes, int rounds)
{
  std::vector<std::vector<double>> columns;
  std::cout << "\n" << title << ", " << surface->GetNumberOfPolys() << " triangles; ms\n\n|";
  for (const Size& size : sizes)
  {
    columns.push_back(TimeMethods(surface, size, rounds));
    std::cout << " | " << size.Width << " x " << size.Height << " | / PBR";
  }
  std::cout << " |\n|---";
  for (std::size_t k = 0; k < sizes.size(); ++k)
  {
    std::cout << "|---|---";
  }
  std::cout << "|\n";
  for (std::size_t m = 0; m < GetMethods().size(); ++m)
  {
    std::cout << "| " << GetMethods()[m].Name;
    for (const std::vector<double>& column : columns)
    {
      std::cout << " | " << Format(column[m]) << " | " << Format(column[m] / column[0]);
    }
    std::cout << " |\n";
  }
  std::cout << std::flush;
}

void PrintPixels(const Size& size, int layers, int rounds)
{
  // The first layer holds what a frame takes besides.
  const std::vector<double> few =
    TimeMethods(measuredbrdf::MakeSquareLayers(1, WindowWidth), size, rounds);
  const std::vector<double> many =
    TimeMethods(measuredbrdf::MakeSquareLayers(layers, WindowWidth), size, rounds);
  const double pixels = static_cast<double>(size.Width) * size.Height * (layers - 1);
  std::cout << "\nA pixel, of " << layers << " layers of " << size.Width << " x " << size.Height
            << "; ns\n\n| | ns | / PBR |\n|---|---|---|\n";
  for (std::size_t m = 0; m < GetMethods().size(); ++m)
  {
    std::cout << "| " << GetMethods()[m].Name << " | " << Format(1e6 * (many[m] - few[m]) / pixels)
              << " | " << Format((many[m] - few[m]) / (many[0] - few[0])) << " |\n";
  }
  std::cout << std::flush;
}

// What a surface hides from itself: without its arrays, with them while the light rests, and with
// them while it turns.
void PrintOcclusion(const Size& size, int rounds)
{
  vtkNew<vtkSurfaceVisibilityFilter> filter;
  filter->SetInputData(GetBumps());
  const auto begin = std::chrono::steady_clock::now();
  filter->Update();
  auto* surface = vtkPolyData::SafeDownCast(filter->GetOutput());
  const std::chrono::duration<double> traced = std::chrono::steady_clock::now() - begin;
  std::cout << "\nSelf-occlusion, " << size.Width << " x " << size.Height << ", "
            << surface->GetNumberOfPolys() << " triangles, traced in " << traced.count()
            << " s; ms\n\n"
            << "| | without | light rests | light turns |\n|---|---|---|---|\n";
  for (const Method& method : GetMethods())
  {
    if (!method.BRDF || method.Integrator)
    {
      continue; // AUTO only
    }
    std::vector<std::unique_ptr<Picture>> pictures;
    for (int k = 0; k < 3; ++k)
    {
      pictures.push_back(std::make_unique<Picture>(method, surface, size.Width, size.Height));
      if (k == 0)
      {
        pictures[0]->GetMeasured()->SetOcclusionModeToOff();
      }
      else
      {
        pictures.back()->GetMeasured()->SetOcclusionModeToOn();
      }
    }
    std::vector<std::vector<double>> times(3);
    for (int round = -2; round < rounds; ++round)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        pictures[k]->Draw();
        if (k == 2)
        {
          pictures[k]->GetEnvironment()->SetRotationY(2.0 * round);
        }
        const double time = pictures[k]->Draw();
        if (round >= 0)
        {
          times[k].push_back(time);
        }
      }
    }
    std::cout << "| " << method.Name;
    for (std::vector<double>& list : times)
    {
      std::cout << " | " << Format(GetMedian(list));
    }
    std::cout << " |\n" << std::flush;
  }
}
}

int main(int argc, char** argv)
{
  const int rounds = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 15;
  const int largest = argc > 2 ? std::atoi(argv[2]) : 2160;
  std::vector<Size> sizes;
  for (const Size& size : { Size{ 500, 500 }, Size{ 1920, 1080 }, Size{ 3840, 2160 } })
  {
    if (size.Height <= largest || sizes.empty())
    {
      sizes.push_back(size);
    }
  }
  std::cout << std::setprecision(3) << "Renderer:"
            << Picture(GetMethods()[0], measuredbrdf::MakeSquareLayers(1, WindowWidth), 100, 100)
                 .GetRendererName()
            << std::endl;
  const std::string part = argc > 3 ? argv[3] : "";
  if (part.empty() || part == "occlusion")
  {
    PrintOcclusion(sizes.back(), rounds);
  }
  if (part.empty() || part == "sphere")
  {
    PrintFrames("A sphere", MakeSphere(1.0), sizes, rounds);
  }
  if (part.empty() || part == "bumps")
  {
    PrintFrames("A sphere with bumps", GetBumps(), sizes, rounds);
  }
  if (part.empty() || part == "pixels")
  {
    PrintPixels(sizes[std::min<std::size_t>(1, sizes.size() - 1)], largest > 1080 ? 8 : 3, rounds);
  }
  return 0;
}
