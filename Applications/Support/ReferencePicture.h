// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The reference radiance of every pixel of a picture, interpolated where it can be.
 */

#ifndef ReferencePicture_h
#define ReferencePicture_h

#include "Sizes.h"
#include "Surface.h"

#include <functional>
#include <vector>

class vtkBRDF;
class vtkEnvironment;

namespace tool
{
struct ReferencePicture
{
  static constexpr double Tolerance = 0.003; // relative error that a pixel may have

  std::vector<double> Radiance; // 3 a pixel of the surface
  double Integrated = 1.0;      // share of the pixels; the others are interpolated
  double Within = 1.0;          // share within the tolerance, of a sample of all
  double WithinBetween = 1.0;   // the same of those of the sample that are interpolated
  double Worst = 0.0;           // relative error in that sample
};

/// Gets what is known so far of the radiance, 3 doubles a pixel of the surface.
using ShowReference = std::function<void(const std::vector<double>& radiance)>;

/**
 * Of a surface with all covered pixels (stride 1). Of 2000 pixels or more, 400 are integrated to a
 * small tolerance first, apart from the picture. They decide to which tolerance pixels are
 * integrated. Where a material evaluates many lights at once and that takes few evaluations of f,
 * each pixel is integrated, in blocks of 2 x 2 over the same squares of the sky. Else it integrates
 * on a grid, and more finely where interpolation does not foretell the middle of a cell. What is
 * interpolated is what a table of radiance lacks, which is smoother than radiance. Where too many
 * of the 400 are off, everything is interpolated again on a finer grid. Of a surface with fewer
 * pixels each is integrated to 0.001. show, where there is one, gets the picture as it becomes
 * better, on this thread. Under one progress bar. Throws Error. Needs an Interruptible or a
 * BackgroundWork.
 */
ReferencePicture DrawReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  const Size& size, const ShowReference& show = nullptr);
} // namespace tool

#endif
