// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TextureEnvironment.h"

#include "LightProbe.h"
#include "RecentlyUsed.h"
#include "ScopedErrorCapture.h"
#include "SharedObjects.h"

#include "vtkAlgorithm.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkTexture.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
// The image at one of the texture's inputs, brought up to date; null where there is none.
vtkImageData* UpdateInput(vtkTexture* texture, int port)
{
  if (port >= texture->GetNumberOfInputPorts() || texture->GetNumberOfInputConnections(port) == 0)
  {
    return nullptr;
  }
  vtkAlgorithm* source = texture->GetInputAlgorithm(port, 0);
  if (source)
  {
    source->Update();
  }
  auto* image = vtkImageData::SafeDownCast(texture->GetInputDataObject(port, 0));
  return image && image->GetNumberOfPoints() > 0 ? image : nullptr;
}

// Whether VTK's physically based rendering decodes the texture's values, on every version:
// - SetEnvironmentTexture(texture, true) says so of any values (vtkPBRPrefilterTexture);
// - UseSRGBColorSpace makes OpenGL decode textures of bytes, no others;
// - vtkSphericalHarmonics, which takes lat-long images alone, decodes all bytes.
// VTK's curve is a power of 2.2 but for OpenGL's; here it is always sRGB's.
bool TakesAsSRGB(vtkRenderer* renderer, vtkTexture* texture, vtkImageData* image)
{
  auto* openGL = vtkOpenGLRenderer::SafeDownCast(renderer);
  if (openGL && openGL->GetEnvMapPrefiltered()->GetConvertToLinear())
  {
    return true;
  }
  const bool hasHarmonics =
    !texture->GetCubeMap() && (!openGL || openGL->GetUseSphericalHarmonics());
  return image->GetScalarType() == VTK_UNSIGNED_CHAR &&
         (texture->GetUseSRGBColorSpace() || hasHarmonics);
}

vtkIdType GetRepaired(vtkEnvironment* environment)
{
  return environment->GetNumberOfNegativeValues() + environment->GetNumberOfNonFiniteValues();
}

// A cube map's face as RGB with row 0 at the bottom: VTK's cube maps begin with the top row. Empty
// where it can't be taken.
std::vector<float> TakeFace(vtkImageData* image, bool sRGB, vtkIdType& repaired)
{
  vtkNew<vtkEnvironment> face;
  const ScopedErrorCapture error(face); // the mapper says what is wrong, once
  if (!face->SetImage(image, sRGB) || face->GetWidth() != face->GetHeight())
  {
    return {};
  }
  repaired += GetRepaired(face);
  std::vector<float> pixels = face->GetPixels();
  const std::ptrdiff_t row = 3 * static_cast<std::ptrdiff_t>(face->GetWidth());
  for (auto low = pixels.begin(), high = pixels.end() - row; low < high; low += row, high -= row)
  {
    std::swap_ranges(low, low + row, high);
  }
  return pixels;
}

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
// z -> -z turns the azimuth's sign: the columns change sides.
void MirrorInZ(vtkEnvironment* environment)
{
  std::vector<float> pixels = environment->GetPixels();
  const int width = environment->GetWidth();
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    float* row = &pixels[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
    for (int x = 0; x < width / 2; ++x)
    {
      std::swap_ranges(row + 3 * x, row + 3 * x + 3, row + 3 * (width - 1 - x));
    }
  }
  environment->SetPixels(width, environment->GetHeight(), std::move(pixels));
}
#endif

using EnvironmentKey = std::tuple<std::vector<vtkImageData*>, std::vector<vtkMTimeType>, bool>;
using Environments = SharedObjects<EnvironmentKey, vtkEnvironment>;

vtkSmartPointer<vtkEnvironment> MakeFromCube(
  const std::vector<vtkImageData*>& images, bool sRGB, vtkIdType& repaired)
{
  std::vector<std::vector<float>> faces;
  for (vtkImageData* image : images)
  {
    faces.push_back(TakeFace(image, sRGB, repaired));
    if (faces.back().empty() || faces.back().size() != faces.front().size())
    {
      return nullptr;
    }
  }
  auto environment = vtkSmartPointer<vtkEnvironment>::New();
  const int side = images.front()->GetDimensions()[0];
  if (!ConvertCubeFaces(side, faces, environment))
  {
    return nullptr;
  }
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
  // Face +z is what is seen towards -z since VTK 9.2; before, its skybox showed it towards +z.
  MirrorInZ(environment);
#endif
  return environment;
}
}

vtkSmartPointer<vtkEnvironment> FindEnvironment(vtkRenderer* renderer, std::string& problem)
{
  vtkTexture* texture = renderer->GetEnvironmentTexture();
  std::vector<vtkImageData*> images;
  std::vector<vtkMTimeType> times;
  for (int port = 0; port < (texture->GetCubeMap() ? 6 : 1); ++port)
  {
    images.push_back(UpdateInput(texture, port));
    if (!images.back())
    {
      problem = "it has no image" +
                (texture->GetCubeMap() ? " for cube face " + std::to_string(port) : std::string()) +
                ".";
      return nullptr;
    }
    times.push_back(images.back()->GetMTime());
  }
  const bool sRGB = TakesAsSRGB(renderer, texture, images.front());
  const EnvironmentKey key(images, times, sRGB);
  vtkIdType repaired = 0;
  auto environment = Environments::Get().Find(key,
    [&images, sRGB, &problem, &repaired]() -> vtkSmartPointer<vtkEnvironment>
    {
      if (images.size() == 6)
      {
        problem = "its cube faces are not square images of one size with 1, 3 or 4 components and "
                  "at most " +
                  std::to_string(MaximumProbeTexels / 6) + " texels.";
        return MakeFromCube(images, sRGB, repaired);
      }
      auto made = vtkSmartPointer<vtkEnvironment>::New();
      const ScopedErrorCapture error(made);
      const bool taken = made->SetImage(images.front(), sRGB);
      problem = error.GetText();
      repaired = GetRepaired(made);
      return taken ? made : nullptr;
    });
  if (!environment)
  {
    return nullptr;
  }
  problem = repaired == 0 ? std::string()
                          : std::to_string(repaired) + " of its values are negative or not finite: "
                                                       "0 is taken, the largest value for "
                                                       "+infinity.";
  return environment;
}

glm::dmat3 GetWorldToEnvironment(vtkRenderer* renderer, vtkEnvironment* environment)
{
  glm::dmat3 axes;
  renderer->GetEnvironmentRight(&axes[0].x);
  renderer->GetEnvironmentUp(&axes[1].x);
  axes[2] = glm::cross(axes[0], axes[1]);
  glm::dmat3 own(1.0);
  if (environment)
  {
    environment->GetWorldToEnvironment(&own[0].x); // by rows
  }
  return glm::transpose(own) * glm::transpose(axes);
}

void SweepEnvironments() { Environments::Get().Sweep(); }
} // namespace measuredbrdf
