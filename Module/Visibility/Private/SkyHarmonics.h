// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Real spherical harmonics up to degree 4: values and rotations.
 */

#ifndef SkyHarmonics_h
#define SkyHarmonics_h

#include <glm/glm.hpp>

#include <array>
#include <cstddef>

namespace measuredbrdf
{
namespace sky
{
constexpr int Degree = 4;
constexpr std::size_t Harmonics = (Degree + 1) * (Degree + 1);

using Values = std::array<double, Harmonics>;
using Colors = std::array<glm::dvec3, Harmonics>;

/// Orthonormal, number l (l + 1) + m; the polynomials of Sloan 2008, "Stupid Spherical Harmonics
/// Tricks", appendix A2, with the phase (-1)^m. d is a unit vector.
inline Values Evaluate(const glm::dvec3& d)
{
  const double x = d.x;
  const double y = d.y;
  const double z = d.z;
  const double z2 = z * z;
  const double c2 = x * x - y * y;
  const double s2 = 2.0 * x * y;
  const double c3 = x * c2 - y * s2;
  const double s3 = x * s2 + y * c2;
  const double c4 = x * c3 - y * s3;
  const double s4 = x * s3 + y * c3;
  return { 0.282094791773878140, //
    -0.488602511902919920 * y, 0.488602511902919920 * z, -0.488602511902919920 * x,
    0.546274215296039590 * s2, -1.092548430592079200 * z * y,
    0.946174695757560080 * z2 - 0.315391565252520050, -1.092548430592079200 * z * x,
    0.546274215296039590 * c2, -0.590043589926643520 * s3, 1.445305721320277100 * z * s2,
    (-2.285228997322328800 * z2 + 0.457045799464465770) * y,
    z * (1.865881662950577000 * z2 - 1.119528997770346200),
    (-2.285228997322328800 * z2 + 0.457045799464465770) * x, 1.445305721320277100 * z * c2,
    -0.590043589926643520 * c3, 0.625835735449176030 * s4, -1.770130769779930200 * z * s3,
    (3.311611435151459800 * z2 - 0.473087347878779980) * s2,
    z * (-4.683325804901024000 * z2 + 2.007139630671867200) * y,
    (35.0 * z2 * z2 - 30.0 * z2 + 3.0) * 0.105785546915204300,
    z * (-4.683325804901024000 * z2 + 2.007139630671867200) * x,
    (3.311611435151459800 * z2 - 0.473087347878779980) * c2, -1.770130769779930200 * z * c3,
    0.625835735449176030 * c4 };
}

/// Harmonics of max(n . d, 0) over d, n a unit vector: those of a product with light are irradiance
/// (Ramamoorthi, Hanrahan 2001, eq. 8).
Values GetCosineTransfer(const glm::dvec3& n);

/// The coefficients of light(R d) over d, of an orthogonal R, mirrors too: each degree goes through
/// as many directions as it has functions.
Colors Rotate(const Colors& light, const glm::dmat3& r);
} // namespace sky
} // namespace measuredbrdf

#endif
