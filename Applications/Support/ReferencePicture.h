// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The reference radiance of every pixel of a picture, interpolated where it can be, and how many
 * pixels it can have in a limited time.
 */

#ifndef ReferencePicture_h
#define ReferencePicture_h

#include "Inputs.h"
#include "Surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkAdaptiveRadianceIntegrator;
class vtkBRDF;
class vtkEnvironment;

namespace tool
{
/// To which tolerance all pixels of a picture are integrated, in blocks, from the evaluations of f
/// that a trial took. They are counted, not timed: pictures do not depend on the machine.
struct BlockTolerance
{
  static constexpr double Coarsest = 0.0028;
  static constexpr double Finest = 0.0014;
  static constexpr double Factor = 0.8;         // where pixels of the sample are off
  static constexpr double Affordable = 10500.0; // evaluations a pixel, by what is predicted
  static constexpr double Most = 16000.0; // with the coarsest tolerance: beyond, no blocks at all
  static constexpr double UsualPixels = 160000.0; // of a sphere in 500 x 500

  /// The finest of some tolerances that is affordable; 0 where not even the coarsest is.
  /// evaluations: of a pixel, with the coarsest. Where a picture has more pixels than usual, as
  /// many in all may be taken.
  static double Choose(double evaluations, double pixels)
  {
    constexpr double power = 0.85; // of the inverse tolerance, about
    const double usual = evaluations * std::fmax(pixels / UsualPixels, 1.0);
    if (usual > Most)
    {
      return 0.0;
    }
    double tolerance = Coarsest;
    for (const double finer : { 0.0024, 0.002, Finest })
    {
      if (usual * std::pow(Coarsest / finer, power) <= Affordable)
      {
        tolerance = finer;
      }
    }
    return tolerance;
  }
};

/// Some pixels of a picture whose radiance is known more exactly than the picture's, and how far
/// the radiance of others is from that.
class ReferenceSample
{
public:
  /// Some of all pixels, scattered among them by the golden ratio: no column.
  void Scatter(std::size_t some, std::size_t all)
  {
    double place = 0.5;
    for (std::size_t k = 0; all > 0 && k < some; ++k)
    {
      place = std::fmod(place + 0.61803398874989485, 1.0);
      this->Pixels.push_back(static_cast<int>(place * static_cast<double>(all)));
    }
  }

  /// What is compared with, 3 a pixel. Pixels darker than leastShare of its mean count as that
  /// bright.
  void SetExact(std::vector<double> exact, double leastShare)
  {
    this->Exact = std::move(exact);
    double sum = 0.0;
    for (const double value : this->Exact)
    {
      sum += value;
    }
    this->LeastSum =
      leastShare * sum / static_cast<double>(std::max<std::size_t>(this->Pixels.size(), 1));
  }

  const std::vector<int>& GetPixels() const { return this->Pixels; }
  const double* GetExact(std::size_t k) const { return &this->Exact[3 * k]; }

  /// Relative error of a pixel's radiance, summed over the channels.
  double GetError(const double* rgb, const double* exact) const
  {
    double difference = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      difference += std::abs(rgb[c] - exact[c]);
    }
    const double scale = std::max(exact[0] + exact[1] + exact[2], this->LeastSum);
    return scale > 0.0 ? difference / scale : 0.0;
  }

  /// Of radiance for the sample: the share within the tolerance, and the largest error.
  double GetWithin(const std::vector<double>& rgb, double tolerance, double& worst) const
  {
    worst = 0.0;
    std::size_t within = 0;
    for (std::size_t k = 0; k < this->Pixels.size(); ++k)
    {
      const double error = this->GetError(&rgb[3 * k], &this->Exact[3 * k]);
      within += error <= tolerance ? 1 : 0;
      worst = std::max(worst, error);
    }
    return this->Pixels.empty()
             ? 1.0
             : static_cast<double>(within) / static_cast<double>(this->Pixels.size());
  }

private:
  std::vector<int> Pixels;
  std::vector<double> Exact;
  double LeastSum = 0.0;
};

/**
 * Of some pixels of a surface in a picture of that width: 3 doubles each. The blocks of 2 x 2
 * pixels in which they lie are integrated as a whole, each once, and always the same ones: a
 * pixel's radiance does not depend on which others are asked for. places: the surface's pixel at
 * each place of the picture, -1 where there is none. Of an isotropic material. show gets the share
 * done. Throws Error. Needs an Interruptible.
 */
std::vector<double> IntegrateInBlocks(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, int width, const std::vector<int>& places, const std::vector<int>& pixels,
  const std::function<void(double)>& show);

/// The same of each pixel by itself. Of any material.
std::vector<double> IntegratePixels(vtkAdaptiveRadianceIntegrator* integrator,
  const Surface& surface, const std::vector<int>& pixels, const std::function<void(double)>& show);

/// How many pixels these blocks hold, any that are not covered among them.
std::size_t CountInBlocks(const Surface& surface, int width, const std::vector<int>& pixels);

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

/// How long the reference takes at most on this machine, in seconds: as if each pixel were
/// integrated. From few of them. Throws Error. Needs an Interruptible.
double EstimateReferenceSeconds(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface);

/// At most so many of the surface's pixels take the reference so many seconds (0: no limit). Where
/// that is not all of them, it prints this, with the option's name. Throws Error. Needs an
/// Interruptible.
int LimitReference(vtkBRDF* brdf, vtkEnvironment* environment, const Surface& surface,
  double seconds, const std::string& option);
} // namespace tool

#endif
