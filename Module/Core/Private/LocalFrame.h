// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The local frame of a shading point in C++ (GLSL twin: shaders/vtkBRDFCommon.glsl).
 */

#ifndef LocalFrame_h
#define LocalFrame_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
/// Unit vector above the horizon, or false. NaN compares false too.
inline bool ToUpperUnit(const double in[3], double out[3])
{
  const double length = std::sqrt(in[0] * in[0] + in[1] * in[1] + in[2] * in[2]);
  if (!(in[2] > 0.0) || !(length > 0.0) || !std::isfinite(length))
  {
    return false;
  }
  for (int c = 0; c < 3; ++c)
  {
    out[c] = in[c] / length;
  }
  return out[2] > 0.0;
}

/// The direction of polar angle arccos(cosine) and azimuth phi (radians) in a local frame.
inline glm::dvec3 ToDirection(double cosine, double phi)
{
  const double s = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  return { s * std::cos(phi), s * std::sin(phi), cosine };
}

/// Columns: tangent, bitangent, normal.
using Frame = glm::dmat3;

/**
 * A right-handed orthonormal frame about unit n, smooth wherever n.z is not -s (s = 1 or -1).
 * Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
 */
inline Frame FrameAbout(const glm::dvec3& n, double s)
{
  const double a = -1.0 / (s + n.z);
  const double b = n.x * n.y * a;
  return Frame(glm::dvec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x),
    glm::dvec3(b, s + n.y * n.y * a, -n.y), n);
}

/// The same without a seam except at n.z = 0's sign change.
inline Frame FrameAbout(const glm::dvec3& n) { return FrameAbout(n, std::copysign(1.0, n.z)); }

/// The frame with its tangent along the part of t perpendicular to n; any frame where t gives none.
inline Frame FrameAbout(const glm::dvec3& n, const glm::dvec3& t)
{
  const glm::dvec3 p = t - n * glm::dot(n, t);
  const double length = glm::length(p);
  if (!(length > 1e-6))
  {
    return FrameAbout(n);
  }
  return Frame(p / length, glm::cross(n, p / length), n);
}

/// World direction in the frame's coordinates.
inline glm::dvec3 ToLocal(const Frame& frame, const glm::dvec3& d)
{
  return glm::dvec3(glm::dot(frame[0], d), glm::dot(frame[1], d), glm::dot(frame[2], d));
}

/**
 * Interpolated normals can turn away from the viewer at silhouettes. The view is then shaded as if
 * it had this cosine (1.1 degrees above the horizon). Measured f grows as 1/cos towards the
 * horizon, where no instrument measures; much smaller cosines draw white rims.
 */
constexpr double MinimumViewCosine = 0.02;

/// o with its cosine lifted to at least MinimumViewCosine, azimuth kept, unit length.
inline glm::dvec3 LiftView(const glm::dvec3& o)
{
  if (o.z >= MinimumViewCosine)
  {
    return o;
  }
  const double length = std::hypot(o.x, o.y);
  const double s = std::sqrt(1.0 - MinimumViewCosine * MinimumViewCosine);
  return length > 1e-12 ? glm::dvec3(o.x * s / length, o.y * s / length, MinimumViewCosine)
                        : glm::dvec3(s, 0.0, MinimumViewCosine);
}

/// The same of a unit view about a unit normal n, in any frame, but below the horizon it stays.
inline glm::dvec3 LiftView(const glm::dvec3& o, const glm::dvec3& n)
{
  const double cosine = glm::dot(o, n);
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  if (!(cosine > 0.0) || cosine >= MinimumViewCosine || !(sine > 0.0))
  {
    return o;
  }
  const glm::dvec3 lifted = LiftView(glm::dvec3(sine, 0.0, cosine));
  return lifted.z * n + lifted.x / sine * (o - cosine * n);
}
} // namespace measuredbrdf

#endif
