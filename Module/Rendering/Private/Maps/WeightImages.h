// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The images of weights of a material map: checked, and on a window's GPU.
 */

#ifndef WeightImages_h
#define WeightImages_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

class vtkImageData;
class vtkMaterialMap;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

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

/// Shared by all that draw by the map in a window.
class WeightTextures
{
public:
  static std::shared_ptr<WeightTextures> Find(vtkMaterialMap* map, vtkOpenGLRenderWindow* window);

  /// Upload what changed. Returns what went wrong, or "".
  std::string Update(vtkMaterialMap* map, vtkOpenGLRenderWindow* window);

  void Activate();
  void Deactivate();
  void SetUniforms(vtkShaderProgram* program) const;
  std::size_t GetBytes() const { return this->Bytes; }

  /// How often the images were uploaded: for tests.
  int GetNumberOfUploads() const { return this->Uploads; }

  /// The sampler of an image.
  static std::string GetSampler(std::size_t image);

private:
  std::vector<vtkSmartPointer<vtkTextureObject>> Textures;
  std::size_t Bytes = 0;
  int Uploads = 0;
  std::vector<std::pair<vtkImageData*, vtkMTimeType>> Source; // only compared
  bool Repeats = false;
  vtkOpenGLRenderWindow* Window = nullptr;
};
} // namespace measuredbrdf

#endif
