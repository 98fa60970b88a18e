// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A picture of a sphere of a material, computed on the CPU. Private to the rendering component.
 */

#ifndef MaterialPicture_h
#define MaterialPicture_h

#include "vtkSmartPointer.h"

class vtkBRDF;
class vtkEnvironment;
class vtkImageData;

namespace measuredbrdf
{
/// RGBA in floats, radiance^(1/2.2), transparent around the sphere. Seen along -z from a great
/// distance. Null where there is nothing to integrate with.
vtkSmartPointer<vtkImageData> MakeMaterialPicture(
  vtkBRDF* brdf, vtkEnvironment* environment, int pixels, double tolerance);
} // namespace measuredbrdf

#endif
