// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Wigner's small d functions d^l_mk(theta), for all l at once: they rotate spherical harmonics.
 * D^l_mk(alpha, beta, gamma) = e^(-i m alpha) d^l_mk(beta) e^(-i k gamma), and
 * Y_lm(theta, phi) = sqrt((2l+1)/(4 pi)) d^l_m0(theta) e^(i m phi), with the Condon-Shortley phase.
 *
 * Three-term recursion upwards in l from closed forms at l = max(|m|,|k|), stable for all l
 * (Kostelec, Rockmore 2008, "FFTs on the Rotation Group"; Varshalovich et al. 1988, 4.8 and 4.16).
 */

#ifndef WignerD_h
#define WignerD_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <math.h> // for lgamma_r, which is POSIX's
#include <vector>

namespace measuredbrdf
{
/// A thread-safe log n!. (In some C libraries std::lgamma also writes the sign of the gamma
/// function to a global variable.)
inline double LogFactorial(int n)
{
  int sign;
  return ::lgamma_r(n + 1.0, &sign);
}

/// The recursion's coefficients for one m and k, to be used for many theta.
class WignerD
{
public:
  WignerD(int m, int k, int maximumDegree)
    : First(std::max(std::abs(m), std::abs(k)))
    , Last(maximumDegree)
  {
    if (this->IsEmpty())
    {
      return;
    }
    // d at First = sign sqrt((2 l)! / ((l + j)! (l - j)!)) cos^a(theta/2) sin^b(theta/2).
    const int l = this->First;
    const bool isM = std::abs(m) >= std::abs(k);
    const int larger = isM ? m : k;
    const int j = larger >= 0 ? (isM ? k : m) : -(isM ? k : m);
    this->LogStart = 0.5 * (LogFactorial(2 * l) - LogFactorial(l + j) - LogFactorial(l - j));
    this->CosinePower = l + j;
    this->SinePower = l - j;
    this->Sign = isM == (larger >= 0) && this->SinePower % 2 != 0 ? -1.0 : 1.0;
    double before = 0.0; // the root of the degree below: at the first one it is 0
    this->Steps.reserve(this->Last - l);
    for (int degree = l; degree < this->Last; ++degree)
    {
      const double d = degree;
      const double n = d + 1.0;
      const double root = std::sqrt((n * n - double(m) * m) * (n * n - double(k) * k));
      this->Steps.push_back({ n * (2.0 * d + 1.0) / root,
        degree > 0 ? m * double(k) / (d * n) : 0.0, degree > 0 ? n * before / (d * root) : 0.0 });
      before = root;
    }
  }

  /// Lowest degree that is not zero.
  int GetFirst() const { return this->First; }

  /// Whether that is above the maximum degree.
  bool IsEmpty() const { return this->First > this->Last; }

  ///@{
  /// The recursion, for those who do it on their own (SynthesisLanes.h): d at the lowest degree, of
  /// the logarithms of cos(theta/2) and sin(theta/2), and
  /// d[l + 1] = A (cos(theta) - B) d[l] - C d[l - 1].
  struct Step
  {
    double A, B, C;
  };
  const std::vector<Step>& GetSteps() const { return this->Steps; }
  static double GetLog(double x) { return std::log(std::max(x, 1e-300)); }
  double GetStart(double logHalfCosine, double logHalfSine) const
  {
    return this->Sign * std::exp(this->LogStart + this->CosinePower * logHalfCosine +
                                 this->SinePower * logHalfSine);
  }
  ///@}

  /// d[l] for l = GetFirst() ... maximumDegree, at d[l - GetFirst()]. Value: double, or one of
  /// Eigen's arrays of them.
  template <typename Value>
  void Evaluate(const Value& theta, Value* d) const
  {
    if (this->IsEmpty())
    {
      return;
    }
    using std::cos;
    using std::exp;
    using std::sin;
    const Value c = cos(0.5 * theta);
    const Value s = sin(0.5 * theta);
    Value current =
      this->Sign * exp(this->LogStart + Log(c, this->CosinePower) + Log(s, this->SinePower));
    Value previous = 0.0 * current;
    const Value x = cos(theta);
    *d++ = current;
    for (const Step& step : this->Steps)
    {
      const Value next = step.A * (x - step.B) * current - step.C * previous;
      previous = current;
      current = next;
      *d++ = current;
    }
  }

private:
  // log(x^power); 0^0 = 1.
  static double Log(double x, int power) { return power == 0 ? 0.0 : power * GetLog(x); }

  template <typename Array>
  static Array Log(const Array& x, int power)
  {
    return x.unaryExpr([power](double value) { return Log(value, power); });
  }

  int First, Last;
  int CosinePower = 0;
  int SinePower = 0;
  double Sign = 1.0;
  double LogStart = 0.0;
  std::vector<Step> Steps;
};
} // namespace measuredbrdf

#endif
