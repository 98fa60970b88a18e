// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Sampling of reflections by a tabulated density of half vectors, mixed with the cosine so that no
 * direction is missed. Used by the tabulated representations.
 */

#ifndef HalfVectorSampler_h
#define HalfVectorSampler_h

#include "Distribution.h"
#include "HalfVector.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
/**
 * Weights for a HalfVectorSampler of nTheta x nPhi cells from a BRDF itself: sum of RGB times
 * cos(theta_i), averaged over the difference angles. evaluate(i, o, f).
 */
template <typename Function>
std::vector<double> MeanOverDifferenceAngles(int nTheta, int nPhi, Function evaluate)
{
  constexpr int nThetaD = 16, nPhiD = 8;
  std::vector<double> weights(static_cast<std::size_t>(nTheta * nPhi), 0.0);
  for (int cell = 0; cell < nTheta * nPhi; ++cell)
  {
    const int t = cell % nTheta;
    const double phi = 2.0 * Pi * (cell / nTheta + 0.5) / nPhi;
    const double cosine = nPhi > 1 ? std::cos(phi) : 1.0; // any azimuth where there is one
    const double sine = nPhi > 1 ? std::sin(phi) : 0.0;
    const auto turn = [cosine, sine](const glm::dvec3& d)
    { return glm::dvec3(cosine * d.x - sine * d.y, sine * d.x + cosine * d.y, d.z); };
    for (int k = 0; k < nThetaD * nPhiD; ++k)
    {
      glm::dvec3 i, o, f;
      FromHalfDifference({ UnitToThetaH((t + 0.5) / nTheta), 0.5 * Pi * (k / nPhiD + 0.5) / nThetaD,
                           2.0 * Pi * (k % nPhiD + 0.5) / nPhiD },
        i, o);
      i = turn(i);
      o = turn(o);
      evaluate(&i.x, &o.x, &f.x);
      weights[cell] += (f.x + f.y + f.z) * i.z;
    }
  }
  return weights;
}

class HalfVectorSampler
{
public:
  /**
   * weights: relative density per steradian of h in each cell of a grid nTheta x nPhi (theta
   * fastest), uniform in ThetaHToUnit(theta_h) and in phi_h. lobeShare: share of the draws that use
   * it, the rest is cosine-weighted.
   */
  HalfVectorSampler(const std::vector<double>& weights, int nTheta, int nPhi, double lobeShare)
    : NumberOfTheta(nTheta)
    , NumberOfPhi(nPhi)
    , LobeShare(lobeShare)
  {
    std::vector<double> masses(weights.size());
    this->SolidAngles.resize(nTheta);
    for (int t = 0; t < nTheta; ++t)
    {
      this->SolidAngles[t] = (this->CosineAt(t) - this->CosineAt(t + 1)) * 2.0 * Pi / nPhi;
    }
    for (std::size_t k = 0; k < weights.size(); ++k)
    {
      masses[k] = weights[k] * this->SolidAngles[k % nTheta];
    }
    this->Cells = Distribution2D(masses, nTheta, nPhi);
    if (this->Cells.IsZero())
    {
      this->LobeShare = 0.0;
    }
  }

  /// Integral of the density over all half vectors; not above 0: all draws are cosine-weighted.
  double GetTotal() const { return this->Cells.GetTotal(); }

  bool Sample(const glm::dvec3& o, double u1, double u2, glm::dvec3& i) const
  {
    if (u1 >= this->LobeShare)
    {
      u1 = (u1 - this->LobeShare) / (1.0 - this->LobeShare);
      SampleCosine(u1, u2, &i.x);
      return i.z > 0.0;
    }
    std::size_t t = 0, p = 0;
    double rt = 0.0, rp = 0.0;
    this->Cells.Invert(u1 / this->LobeShare, u2, t, p, rt, rp);
    const double c0 = this->CosineAt(static_cast<int>(t));
    const double c1 = this->CosineAt(static_cast<int>(t) + 1);
    const double c = c0 + (c1 - c0) * rt;
    const double s = std::sqrt(std::max(1.0 - c * c, 0.0));
    const double phi = 2.0 * Pi * (static_cast<double>(p) + rp) / this->NumberOfPhi;
    i = ReflectAbout(o, glm::dvec3(s * std::cos(phi), s * std::sin(phi), c));
    return i.z > 0.0;
  }

  double Pdf(const glm::dvec3& i, const glm::dvec3& o) const
  {
    double pdf = (1.0 - this->LobeShare) * i.z / Pi;
    if (this->LobeShare > 0.0)
    {
      const glm::dvec3 h = HalfVector(i, o);
      const double theta = std::atan2(std::hypot(h.x, h.y), h.z);
      double phi = std::atan2(h.y, h.x) / (2.0 * Pi);
      phi -= std::floor(phi);
      const int t = std::min(
        static_cast<int>(ThetaHToUnit(theta) * this->NumberOfTheta), this->NumberOfTheta - 1);
      const int p = std::min(static_cast<int>(phi * this->NumberOfPhi), this->NumberOfPhi - 1);
      const double density = this->Cells.GetProbability(t, p) / this->SolidAngles[t];
      pdf += this->LobeShare * density / (4.0 * std::max(glm::dot(o, h), 1e-9));
    }
    return pdf;
  }

private:
  double CosineAt(int boundary) const
  {
    return std::cos(UnitToThetaH(static_cast<double>(boundary) / this->NumberOfTheta));
  }

  int NumberOfTheta;
  int NumberOfPhi;
  double LobeShare;
  std::vector<double> SolidAngles;
  Distribution2D Cells;
};
} // namespace measuredbrdf

#endif
