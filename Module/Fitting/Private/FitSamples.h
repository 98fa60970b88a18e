// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The data of a fit: direction pairs with weights and the input's values, and the losses.
 */

#ifndef FitSamples_h
#define FitSamples_h

#include <glm/glm.hpp>

#include <cmath>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// The transform T(f, cos_i) whose squared differences are summed. vtkBRDFFitter describes the
/// types, by the same numbers.
struct FitLoss
{
  enum : int
  {
    LogCosine = 0,
    CubeRootCosine = 1,
    Squared = 2
  };
  int Type;

  double Value(double f, double cosine) const;
  double Slope(double f, double cosine) const; // dT/df, finite for every f >= 0
};

struct FitSample
{
  glm::dvec3 I, O, H;
  double F[3];
  double Weight; // share of the measure (di cos_o do); all weights sum to 1
};

class FitSamples
{
public:
  /**
   * Pairs first ... first + count of the sequence; fewer if the input has invalid cells.
   */
  FitSamples(vtkBRDF* input, const FitLoss& loss, unsigned int seed, int first, int count);

  /// Those.
  FitSamples(const FitLoss& loss, std::vector<FitSample> samples);

  const FitLoss& GetLoss() const { return this->Loss; }
  std::size_t size() const { return this->Samples.size(); }
  const FitSample& operator[](std::size_t k) const { return this->Samples[k]; }
  std::vector<FitSample>::const_iterator begin() const { return this->Samples.begin(); }
  std::vector<FitSample>::const_iterator end() const { return this->Samples.end(); }

  /// The first ones of these samples, which are a low-discrepancy set too.
  FitSamples GetFirst(std::size_t count) const;

private:
  void Normalize();

  FitLoss Loss;
  std::vector<FitSample> Samples;
};
} // namespace measuredbrdf

#endif
