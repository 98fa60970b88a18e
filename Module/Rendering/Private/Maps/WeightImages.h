// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The images of weights of a material map: checked, and on a window's GPU.
 */

#ifndef WeightImages_h
#define WeightImages_h

#include "ShaderTextures.h"

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

class vtkMaterialMap;
class vtkOpenGLRenderWindow;

namespace measuredbrdf
{
/// Why a map cannot be used.
class MapProblem : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Of a map's images of weights, with the weights of a place divided by their sum: the share of
/// places without any weight, then each material's mean. Images may differ in size. warning: what
/// is odd about them, or "". Throws a MapProblem where they cannot be used.
std::vector<double> MeasureWeightImages(vtkMaterialMap* map, std::string& warning);

/// They in a window, for all that draw by the map there. Means are drawn from afar: radiance is
/// linear in the weights. problem: what went wrong, or "". Never null.
std::shared_ptr<ShaderTextures> FindWeightTextures(
  vtkMaterialMap* map, vtkOpenGLRenderWindow* window, std::string& problem);

/// The sampler of an image.
inline std::string GetWeightSampler(std::size_t image)
{
  return "brdfWeightImage" + std::to_string(image);
}
} // namespace measuredbrdf

#endif
