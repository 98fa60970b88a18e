// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The same mesh as VTK draws it by itself: physically based shading under image-based lighting.
 */

#ifndef StockScene_h
#define StockScene_h

#include "OffscreenScene.h"
#include "Surface.h"

#include <cstddef>
#include <vector>

class vtkEnvironment;
class vtkImageData;

namespace tool
{
/// Light for VTK's own shading, which keeps half floats of it: the map in units of about its mean
/// radiance, a power of two, which changes no digit.
struct StockLight
{
  explicit StockLight(vtkEnvironment* environment);

  double Unit = 1.0;
  vtkSmartPointer<vtkImageData> Image;
};

struct StockMaterial
{
  double Roughness = 0.5;
  double Metallic = 0.0;
  RGB Albedo = { 0.5, 0.5, 0.5 }; // linear
};

class StockScene : public OffscreenScene
{
public:
  StockScene();

  void SetLight(vtkEnvironment* environment);
  void SetMaterial(const StockMaterial& material);

  /**
   * The material of least mean |x - r| against a reference of the surface's pixels (3 doubles
   * each): a search over roughness and metallic, coarse then fine; for each, the best albedo of
   * each channel, of which radiance is a quadratic function. Sets it, too. Throws Error.
   */
  StockMaterial Fit(const Surface& surface, const Size& size, const std::vector<double>& reference);

  /// What the environment and VTK's tables of it take on the GPU, once something was rendered: half
  /// floats but for the environment, with their levels.
  std::size_t GetTextureBytes();

private:
  /// Whether this VTK takes a property's color as the albedo or as its display color.
  void FindColorExponent(const Surface& surface, const Size& size);

  double ColorExponent = 1.0; // albedo = color^this
};

/// Radiance of a surface's pixels in a picture, 3 doubles each.
std::vector<double> Pick(const Picture& picture, const Surface& surface);
} // namespace tool

#endif
