// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether an anisotropic material repeats itself.
 */

#ifndef HalfTurn_h
#define HalfTurn_h

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"

namespace measuredbrdf
{
/// Whether f is the same where the sample is turned by half a turn about its normal, by 128 pairs
/// of directions: brushed metal is; cloth with a nap is not.
inline bool IsSameAfterHalfATurn(vtkBRDF* brdf)
{
  constexpr int probes = 128;
  constexpr double largest = 1e-4; // difference of a pair, relative, in the mean
  const glm::dvec3 turn(-1.0, -1.0, 1.0);
  double difference = 0.0;
  for (unsigned int k = 1; k <= probes; ++k)
  {
    const glm::dvec3 o = ToDirection(RadicalInverse(k, 2), 2.0 * Pi * RadicalInverse(k, 3));
    glm::dvec3 i = ToDirection(RadicalInverse(k, 5), 2.0 * Pi * RadicalInverse(k, 7));
    if (k % 2 == 0) // about the mirror direction, where a lobe is
    {
      i = glm::normalize(glm::dvec3(-o.x, -o.y, o.z) + 0.3 * i);
    }
    const glm::dvec3 turnedI = i * turn, turnedO = o * turn;
    glm::dvec3 f, turned;
    brdf->Evaluate(&i.x, &o.x, &f.x);
    brdf->Evaluate(&turnedI.x, &turnedO.x, &turned.x);
    // Relative, so that a bright lobe does not hide what is dim.
    const glm::dvec3 d = glm::abs(f - turned);
    const double both = f.x + f.y + f.z + turned.x + turned.y + turned.z;
    difference += both > 0.0 ? (d.x + d.y + d.z) / both : 0.0;
  }
  return difference <= largest * probes;
}
} // namespace measuredbrdf

#endif
