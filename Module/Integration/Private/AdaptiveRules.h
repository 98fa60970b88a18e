// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What adaptive sums take for a square's error. Private to the module.
 */

#ifndef AdaptiveRules_h
#define AdaptiveRules_h

#include "TexelTree.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace measuredbrdf
{
struct AdaptiveRules
{
  ///@{
  /// What may be left where a square and its quarters agree by chance: this share of the change, of
  /// the error of the square that it is a quarter of, and of tolerance times value.
  static constexpr float LeastRest = 0.05f;
  static constexpr float InheritedShare = 0.03f;
  static constexpr float LeastShare = 3.0f;
  ///@}
  /// Within texels radiance is smooth: what the quarters leave is not left once it is extrapolated.
  static constexpr float PartRest = 0.15f;
  static constexpr float PeakTimes = 2.0f;   // of a square's mean f: less is no hidden peak
  static constexpr float LargestRest = 1.0f; // above, a square tells nothing
  ///@{
  /// Of one sum, and of four: hostile values never agree with those of their quarters. A tolerance
  /// of 1e-5 may take some 300,000.
  static constexpr std::size_t MostSquares = 1 << 20;
  static constexpr std::size_t MostSquaresOfFour = 1 << 16;
  ///@}
  static constexpr double LargestEstimate = 1e36; // which is finite in single precision
  static constexpr auto SmoothRest = static_cast<float>(TexelTree::SmoothRest);

  /// What may rise above the horizon where a square's middle does not: a quarter of its light, from
  /// as high as that quarter's middle can be. middle: in the local frame.
  static glm::dvec3 Raise(glm::dvec3 middle, double radius)
  {
    middle.z = 0.5 * (middle.z + radius);
    return glm::normalize(middle);
  }
  static float GetRising(double cosine, double light)
  {
    return static_cast<float>(std::min(0.25 * cosine * light, LargestEstimate));
  }

  /// The share of a square that a peak of this solid angle may fill unseen.
  static double GetHiddenShare(double solidAngle, double radius)
  {
    return std::min(2.0 * solidAngle / (radius * radius), 1.0);
  }

  /// Of the sum of squares' errors, and of the sum of their squares: errors of either sign cancel,
  /// but for the part that they have in common.
  static double EstimateError(double errors, double squares)
  {
    constexpr double own = 2.0; // standard deviations
    constexpr double common = 0.1;
    return own * std::sqrt(std::max(squares, 0.0)) + common * std::max(errors, 0.0);
  }
};
} // namespace measuredbrdf

#endif
