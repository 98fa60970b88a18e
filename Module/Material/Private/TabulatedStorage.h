// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How textures store a table's values. Private to the module.
 */

#ifndef TabulatedStorage_h
#define TabulatedStorage_h

#include <algorithm>
#include <cmath>
#include <vector>

namespace measuredbrdf
{
struct TabulatedStorage
{
  /// What is asked for; the same numbers as vtkTabulatedBRDF::PrecisionType.
  enum Precision
  {
    Automatic = 0,
    Half = 1,
    Float = 2,
    Shared = 3
  };

  ///@{
  /// Largest relative errors of stored values.
  static constexpr double HalfRounding = 1.0 / 2048.0;
  static constexpr double SharedRounding = 1.0 / 512.0; // of the largest channel
  static constexpr double FloatRounding = 0x1p-23;
  ///@}
  static constexpr double ShareOfTolerance = 0.25; // that rounding may take
  // Scaled to a peak of 2^15, 16 bits and shared exponents keep their bits over nine decades.
  static constexpr float Peak = 32768.0f;

  bool SharedExponents = false;
  bool HalfFloat = false;
  float Scale = 1.0f; // of values that are stored

  double GetRounding() const
  {
    return this->SharedExponents ? SharedRounding : this->HalfFloat ? HalfRounding : FloatRounding;
  }

  const char* GetText() const
  {
    return this->SharedExponents ? "9 bits and a shared exponent"
                                 : (this->HalfFloat ? "16-bit float" : "32-bit float");
  }

  /// precision: a Precision; tolerance: of resampling; volume: RGB, NaN where a cell is invalid.
  static TabulatedStorage Choose(int precision, double tolerance, const std::vector<float>& volume)
  {
    float peak = 0.0f;
    bool positive = true; // and valid
    for (const float v : volume)
    {
      peak = std::max(peak, std::isnan(v) ? 0.0f : std::abs(v));
      positive = positive && v >= 0.0f;
    }
    const double most = ShareOfTolerance * tolerance;
    TabulatedStorage storage;
    storage.SharedExponents = precision == Shared && positive && SharedRounding <= most;
    storage.HalfFloat = !storage.SharedExponents &&
                        (precision == Half || (precision != Float && HalfRounding <= most));
    if ((storage.SharedExponents || storage.HalfFloat) && peak > 1e-30f)
    {
      storage.Scale = Peak / peak;
    }
    return storage;
  }
};
} // namespace measuredbrdf

#endif
