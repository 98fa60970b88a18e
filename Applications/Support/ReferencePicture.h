// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The reference radiance of every pixel of a picture.
 */

#ifndef ReferencePicture_h
#define ReferencePicture_h

#include "Inputs.h"
#include "Surface.h"

#include <functional>
#include <string>
#include <vector>

class vtkBRDF;
class vtkEnvironment;

namespace tool
{
struct ReferencePicture
{
  static constexpr double Tolerance = 0.003; // relative error that a pixel may have

  std::vector<double> Radiance; // 3 a pixel of the surface
  double Within = 1.0;          // share within the tolerance, of a sample of all
};

/// Gets what is known so far of the radiance, 3 doubles a pixel of the surface.
using ShowReference = std::function<void(const std::vector<double>& radiance)>;

/**
 * Of a surface with all covered pixels (stride 1) and at least 2000 of them: 400 pixels are
 * integrated to a small tolerance first, apart from the picture. They decide to which tolerance all
 * pixels are integrated: one that is affordable and keeps the 400 within Tolerance. Pixels of an
 * isotropic material are integrated in blocks of 2 x 2 over the same squares of the sky. Other
 * surfaces' pixels are integrated one by one to 0.001. show, where there is one, gets the picture
 * as it becomes finer, on this thread. Under one progress bar. Throws Error. Needs an Interruptible
 * or a BackgroundWork.
 */
ReferencePicture DrawReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  const Size& size, const ShowReference& show = nullptr);
} // namespace tool

#endif
