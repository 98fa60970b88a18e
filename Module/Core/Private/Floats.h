// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What single precision and the format of textures do to values.
 */

#ifndef Floats_h
#define Floats_h

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace measuredbrdf
{
/// The nearest float, the largest one for values beyond it.
inline float ToFloat(double value)
{
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -largest, largest));
}

/// Size of rounding noise, as a share of a table's largest value.
constexpr float RoundingNoise = 1e-5f;

/// The least value that counts as 0 in a table whose values cannot be negative.
inline float GetNoiseFloor(const std::vector<float>& values)
{
  const auto largest = std::max_element(values.begin(), values.end());
  return largest == values.end() ? 0.0f : -RoundingNoise * std::max(*largest, 0.0f);
}

/// Set rounding noise (and -0) to 0. Returns false and changes nothing if a value is more negative
/// than that. For finite values.
inline bool ClearNoise(std::vector<float>& values)
{
  const float floor = GetNoiseFloor(values);
  if (std::any_of(values.begin(), values.end(), [floor](float v) { return v < floor; }))
  {
    return false;
  }
  std::replace_if(
    values.begin(), values.end(), [](float v) { return v <= 0.0f; }, 0.0f);
  return true;
}

/// The largest component that the format has; the error of each is at most 2^-9 of the largest.
constexpr float LargestSharedExponent = 65408.0f;

/// 2^exponent, of -126 to 127.
inline float GetPowerOfTwo(int exponent)
{
  const std::uint32_t bits = static_cast<std::uint32_t>(exponent + 127) << 23;
  float power;
  std::memcpy(&power, &bits, sizeof(power));
  return power;
}

/// Negative components and NaN count as 0, larger ones as the largest. GLM's packF3x9_E1x5 ends at
/// 32768.
inline std::uint32_t PackSharedExponent(const glm::vec3& rgb)
{
  static_assert(std::numeric_limits<float>::is_iec559, "exponents are bits 23 to 30");
  glm::vec3 clamped(0.0f);
  for (int c = 0; c < 3; ++c)
  {
    clamped[c] = rgb[c] > 0.0f ? std::min(rgb[c], LargestSharedExponent) : 0.0f;
  }
  const float largest = std::max({ clamped.x, clamped.y, clamped.z });
  // The largest is below 2^exponent, read from its bits: frexp and ldexp are slow.
  std::uint32_t bits;
  std::memcpy(&bits, &largest, sizeof(bits));
  int exponent = std::max(static_cast<int>(bits >> 23) - 126, -15);
  float scale = GetPowerOfTwo(9 - exponent);
  if (largest * scale + 0.5f >= 512.0f) // rounded up to the next power of two
  {
    ++exponent;
    scale *= 0.5f;
  }
  const auto round = [scale](float value)
  { return static_cast<std::uint32_t>(value * scale + 0.5f); };
  return round(clamped.x) | round(clamped.y) << 9 | round(clamped.z) << 18 |
         static_cast<std::uint32_t>(exponent + 15) << 27;
}

inline glm::vec3 UnpackSharedExponent(std::uint32_t texel)
{
  const float scale = GetPowerOfTwo(static_cast<int>(texel >> 27) - 24);
  return scale * glm::vec3(texel & 511u, texel >> 9 & 511u, texel >> 18 & 511u);
}

/// Texels whose largest component is the format's, so that values may be of any size; each is to be
/// multiplied by the scale.
struct ScaledTexels
{
  std::vector<std::uint32_t> Texels;
  float Scale = 1.0f;
};
} // namespace measuredbrdf

#endif
