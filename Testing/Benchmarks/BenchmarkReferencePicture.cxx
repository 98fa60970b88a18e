// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Reference pictures of a sphere, for docs/methods/reference.md: CPU time, and
// how far some pixels, not those of the picture's own sample, are from sums of a tolerance of 2e-5.
#include "Methods.h"
#include "Progress.h"
#include "ReferencePicture.h"
#include "Tool.h"

#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkBRDFReader.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace
{
const std::string Data = MEASUREDBRDF_SHARED_DATA;

// In 0.9 of the picture's side, as `compare` draws it, from afar along (1, 0.4, 2).
tool::Surface MakeDisc(int side)
{
  const double view[3] = { 0.440225, 0.17609, 0.880451 };
  const double right[3] = { 0.894427, 0.0, -0.447214 };
  const double up[3] = { -0.0787497, 0.984374, -0.1574994 };
  tool::Surface surface;
  for (int k = 0; k < side * side; ++k)
  {
    const double x = (2.0 * (k % side + 0.5) / side - 1.0) / 0.9;
    const double y = (2.0 * (k / side + 0.5) / side - 1.0) / 0.9;
    const double z = std::sqrt(std::max(1.0 - x * x - y * y, 0.0));
    if (z > 0.03)
    {
      surface.Pixels.push_back(k);
      for (int c = 0; c < 3; ++c)
      {
        surface.Normals.push_back(x * right[c] + y * up[c] + z * view[c]);
        surface.Views.push_back(view[c]);
      }
    }
  }
  surface.NumberOfCovered = static_cast<int>(surface.Pixels.size());
  return surface;
}

// Of the data folder, or an embedded one.
vtkSmartPointer<vtkBRDF> FindBRDF(const std::string& name)
{
  for (const std::string& path : { "rgl/" + name + "_rgb.bsdf", "mbsdf/" + name + ".mbsdf" })
  {
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(Data + "/materials/" + path);
    if (std::ifstream(reader->GetFileName()).good())
    {
      return reader->Read() ? reader->GetBRDF() : nullptr;
    }
  }
  return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
}

double GetSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Shares of checked pixels above the tolerance, and their largest error, relative to at least 2 %
// of the mean.
void PrintErrors(vtkAdaptiveRadianceIntegrator* strict, const tool::Surface& surface,
  const std::vector<double>& radiance, std::size_t checked)
{
  std::vector<double> normals, views, got;
  const std::size_t count = surface.Pixels.size();
  for (std::size_t k = 0; k < checked; ++k)
  {
    const std::size_t pixel = 3 * ((2 * k + 1) * count / (2 * checked));
    normals.insert(normals.end(), &surface.Normals[pixel], &surface.Normals[pixel] + 3);
    views.insert(views.end(), &surface.Views[pixel], &surface.Views[pixel] + 3);
    got.insert(got.end(), &radiance[pixel], &radiance[pixel] + 3);
  }
  const std::vector<double> exact = tool::IntegratePairs(strict, normals, views);
  double sum = 0.0;
  for (const double value : exact)
  {
    sum += value;
  }
  std::vector<double> errors;
  for (std::size_t k = 0; k < exact.size(); k += 3)
  {
    double difference = 0.0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      difference += std::abs(got[k + c] - exact[k + c]);
    }
    errors.push_back(difference / std::max(exact[k] + exact[k + 1] + exact[k + 2],
                                    0.02 * sum / static_cast<double>(checked)));
  }
  std::sort(errors.begin(), errors.end());
  const auto off = errors.end() - std::upper_bound(errors.begin(), errors.end(),
                                    tool::ReferencePicture::Tolerance);
  std::printf("%4d of %zu above %g %%, median %.3f, 99 %% %.3f, largest %.2f %%",
    static_cast<int>(off), checked, 100.0 * tool::ReferencePicture::Tolerance,
    100.0 * errors[checked / 2], 100.0 * errors[checked * 99 / 100], 100.0 * errors.back());
}

void Draw(const std::string& material, const std::string& light, int side, std::size_t checked)
{
  const vtkSmartPointer<vtkBRDF> brdf = FindBRDF(material);
  vtkNew<vtkEnvironmentReader> environment;
  environment->SetFileName(Data + "/environments/" + light + ".exr");
  if (!brdf || !environment->Read())
  {
    return;
  }
  const tool::Surface surface = MakeDisc(side);
  const double begin = GetSeconds();
  const tool::ReferencePicture picture =
    tool::DrawReference(brdf, environment->GetEnvironment(), surface, { side, side });
  const double seconds = GetSeconds() - begin;
  std::printf("%-18s %-9s %6.1f s CPU; ", material.c_str(), light.c_str(), seconds);
  vtkNew<vtkAdaptiveRadianceIntegrator> strict;
  strict->SetBRDF(brdf);
  strict->SetEnvironment(environment->GetEnvironment());
  strict->SetTolerance(2e-5);
  PrintErrors(strict, surface, picture.Radiance, checked);
  std::printf("\n");
  std::fflush(stdout);
}
}

int main(int argc, char** argv)
{
  CLI::App app("CPU time and errors of reference pictures");
  std::vector<std::string> materials = { "acrylic_felt_white", "satin_purple", "chm_light_blue" };
  std::vector<std::string> lights = { "studio", "interior" };
  int side = 500;
  std::size_t checked = 200;
  app.add_option("--material", materials);
  app.add_option("--environment", lights);
  app.add_option("--side", side);
  app.add_option("--checked", checked);
  CLI11_PARSE(app, argc, argv);
  const tool::Interruptible interruptible;
  for (const std::string& material : materials)
  {
    for (const std::string& light : lights)
    {
      Draw(material, light, side, checked);
    }
  }
  return 0;
}
