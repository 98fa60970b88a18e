// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BasisTables.h"

#include "LowDiscrepancy.h"

#include <cstdint>

namespace measuredbrdf
{
namespace
{
constexpr int LargestSide = 256; // of the basis table
}

//------------------------------------------------------------------------------
BasisTables::BasisTables(const BasisFunctions& functions, double gammaRange, double tolerance,
  const std::vector<float>& coefficients)
  : Functions(functions)
  , GammaRange(gammaRange)
{
  // Linear interpolation of cos(m t) at steps h has an RMS error of 0.09 (m h)^2, per axis.
  const double step =
    std::sqrt(tolerance / 0.18) / std::max(static_cast<double>(functions.GetOrder()), 1.0);
  const auto getSamples = [step](double range)
  { return std::clamp(static_cast<int>(std::ceil(range / step)), 1, LargestSide - 1) + 1; };
  this->NumberOfGamma = getSamples(gammaRange);
  this->NumberOfPhi = functions.GetOrder() == 0 ? 1 : getSamples(2.0 * Pi);
  const std::size_t count = static_cast<std::size_t>(functions.GetNumberOfFunctions());
  std::vector<double> values(count);
  for (int g = 0; g < this->NumberOfGamma; ++g)
  {
    const double gamma = gammaRange * g / (this->NumberOfGamma - 1.0);
    const double cosine = functions.ToCosine(std::cos(gamma));
    for (int p = 0; p < this->NumberOfPhi; ++p)
    {
      functions.Evaluate(cosine, 2.0 * Pi * p / this->NumberOfPhi, values.data());
      this->Basis.insert(this->Basis.end(), values.begin(), values.end());
    }
  }
  const std::size_t views = coefficients.size() / (3 * count);
  this->Coefficients.resize(coefficients.size());
  for (std::size_t k = 0; k < count; ++k)
  {
    for (std::size_t v = 0; v < views; ++v)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        this->Coefficients[(3 * v + c) * count + k] = coefficients[3 * (k * views + v) + c];
      }
    }
  }
}

//------------------------------------------------------------------------------
void BasisTables::AddView(int view, const BasisCorners& corners, double weight, double f[3]) const
{
  const std::size_t n = static_cast<std::size_t>(this->Functions.GetNumberOfFunctions());
  const float* r = &this->Coefficients[3 * static_cast<std::size_t>(view) * n];
  double sum[3] = { 0.0, 0.0, 0.0 };
  for (std::size_t k = 0; k < n; ++k)
  {
    const double b = corners.Interpolate(k);
    sum[0] += b * r[k];
    sum[1] += b * r[n + k];
    sum[2] += b * r[2 * n + k];
  }
  for (int c = 0; c < 3; ++c)
  {
    f[c] += weight * sum[c];
  }
}

//------------------------------------------------------------------------------
void BasisTables::Measure(double& interpolation, double& amplification) const
{
  const std::size_t n = static_cast<std::size_t>(this->Functions.GetNumberOfFunctions());
  const std::size_t views = this->Coefficients.size() / (3 * n);
  std::vector<double> exact(n);
  double difference = 0.0;
  double absolute = 0.0;
  double plain = 0.0;
  for (std::uint32_t sample = 1; sample <= 2000; ++sample)
  {
    const std::size_t view = static_cast<std::size_t>(RadicalInverse(sample, 2) * views);
    const double cosine = std::sqrt(RadicalInverse(sample, 3));
    const double turn = RadicalInverse(sample, 5);
    const double x = this->Functions.ToX(cosine);
    this->Functions.Evaluate(this->Functions.ToCosine(x), 2.0 * Pi * turn, exact.data());
    const BasisCorners corners = this->GetCorners(x, turn);
    for (std::size_t c = 0; c < 3; ++c)
    {
      double sum = 0.0;
      double error = 0.0;
      double magnitude = 0.0;
      for (std::size_t k = 0; k < n; ++k)
      {
        const double coefficient = this->Coefficients[(3 * view + c) * n + k];
        sum += coefficient * exact[k];
        error += coefficient * (corners.Interpolate(k) - exact[k]);
        magnitude += coefficient * exact[k] * coefficient * exact[k];
      }
      plain += sum * sum;
      difference += error * error;
      absolute += magnitude;
    }
  }
  interpolation = plain > 0.0 ? std::sqrt(difference / plain) : 0.0;
  amplification = plain > 0.0 ? std::sqrt(absolute / plain) : 1.0;
}

//------------------------------------------------------------------------------
void BasisTables::GetBounds(double divisor, double upper[3]) const
{
  std::fill_n(upper, 3, 0.0);
  const std::size_t n = static_cast<std::size_t>(this->Functions.GetNumberOfFunctions());
  std::vector<float> largest(n, 0.0f);
  for (std::size_t k = 0; k < this->Basis.size(); ++k)
  {
    largest[k % n] = std::max(largest[k % n], std::abs(this->Basis[k]));
  }
  for (std::size_t row = 0; row < this->Coefficients.size() / n; ++row)
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k)
    {
      sum += static_cast<double>(std::abs(this->Coefficients[row * n + k])) * largest[k];
    }
    sum /= divisor;
    upper[row % 3] = std::max(upper[row % 3], sum);
  }
}

//------------------------------------------------------------------------------
vtkBRDFShaderInputs::Texture BasisTables::MakeTexture(bool halfFloat) const
{
  const int n = this->Functions.GetNumberOfFunctions();
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfBasis";
  texture.ThreeD = true;
  texture.Components = 1;
  texture.Dimensions = { this->NumberOfPhi, this->NumberOfGamma, n };
  texture.Repeat = { true, false, false };
  texture.HalfFloat = halfFloat;
  const std::size_t lights = this->Basis.size() / static_cast<std::size_t>(n);
  texture.Data.reserve(this->Basis.size());
  for (int k = 0; k < n; ++k)
  {
    for (std::size_t light = 0; light < lights; ++light)
    {
      texture.Data.push_back(
        this->Basis[light * static_cast<std::size_t>(n) + static_cast<std::size_t>(k)]);
    }
  }
  return texture;
}

//------------------------------------------------------------------------------
vtkBRDFShaderInputs::Texture MakeCoefficientTexture(
  const std::vector<float>& coefficients, int nPhi, int nTheta, bool halfFloat, float& scale)
{
  vtkBRDFShaderInputs::Texture texture;
  texture.Name = "brdfCoefficients";
  texture.ThreeD = true;
  const std::size_t views = static_cast<std::size_t>(nPhi) * static_cast<std::size_t>(nTheta);
  texture.Dimensions = { nPhi, nTheta, static_cast<int>(coefficients.size() / (3 * views)) };
  texture.Repeat = { true, false, false };
  texture.HalfFloat = halfFloat;
  float peak = 0.0f;
  for (const float v : coefficients)
  {
    peak = std::max(peak, std::abs(v));
  }
  scale = halfFloat && peak > 1e-30f ? 32768.0f / peak : 1.0f;
  texture.Data.reserve(coefficients.size());
  for (const float v : coefficients)
  {
    texture.Data.push_back(v * scale);
  }
  return texture;
}
} // namespace measuredbrdf
