// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Normals and views of a picture's pixels: what the shader integrates for, to do the same on the
 * CPU.
 */

#ifndef Surface_h
#define Surface_h

#include "Inputs.h"

#include "vtkPolyData.h"

#include <vector>

class vtkCamera;

namespace tool
{
/// The covered pixels that lie on a grid: where they are and their unit normals and views in the
/// world.
struct Surface
{
  int Stride = 1;          // of the grid in pixels; its first point is in the middle of a stride
  std::vector<int> Pixels; // y * width + x
  std::vector<double> Normals; // 3 each
  std::vector<double> Views;   // 3 each; not below the grazing angle that the shader stops at
  int NumberOfCovered = 0;     // pixels, on the grid or not
};

/**
 * The mesh's interpolated normals from the GPU, and exact views. At most so many pixels: of the
 * finest grid that has no more. Throws Error where the picture shows nothing.
 */
Surface FindSurface(
  vtkPolyData* mesh, const View& view, double fill, const Size& size, int largest);

/// The same for what a camera (perspective) sees.
Surface FindSurface(vtkPolyData* mesh, vtkCamera* camera, const Size& size, int largest);
} // namespace tool

#endif
