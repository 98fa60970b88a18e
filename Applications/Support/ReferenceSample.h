// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Some pixels of a picture whose radiance is known more exactly than the picture's, and how far
 * others' radiance is from that.
 */

#ifndef ReferenceSample_h
#define ReferenceSample_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tool
{
class ReferenceSample
{
public:
  /// Some of all pixels, scattered among them by the golden ratio: no column.
  void Scatter(std::size_t some, std::size_t all)
  {
    double place = 0.5;
    for (std::size_t k = 0; all > 0 && k < some; ++k)
    {
      place = std::fmod(place + 0.61803398874989485, 1.0);
      this->Pixels.push_back(static_cast<int>(place * static_cast<double>(all)));
    }
  }

  /// What is compared with, 3 a pixel. Pixels darker than leastShare of its mean count as that
  /// bright.
  void SetExact(std::vector<double> exact, double leastShare)
  {
    this->Exact = std::move(exact);
    double sum = 0.0;
    for (const double value : this->Exact)
    {
      sum += value;
    }
    this->LeastSum =
      leastShare * sum / static_cast<double>(std::max<std::size_t>(this->Pixels.size(), 1));
  }

  const std::vector<int>& GetPixels() const { return this->Pixels; }
  const double* GetExact(std::size_t k) const { return &this->Exact[3 * k]; }

  /// Relative error of a pixel's radiance, summed over the channels.
  double GetError(const double* rgb, const double* exact) const
  {
    double difference = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      difference += std::abs(rgb[c] - exact[c]);
    }
    const double scale = std::max(exact[0] + exact[1] + exact[2], this->LeastSum);
    return scale > 0.0 ? difference / scale : 0.0;
  }

  /// Of radiance for the sample: the share within the tolerance, and the largest error.
  double GetWithin(const std::vector<double>& rgb, double tolerance, double& worst) const
  {
    worst = 0.0;
    std::size_t within = 0;
    for (std::size_t k = 0; k < this->Pixels.size(); ++k)
    {
      const double error = this->GetError(&rgb[3 * k], &this->Exact[3 * k]);
      within += error <= tolerance ? 1 : 0;
      worst = std::max(worst, error);
    }
    return this->Pixels.empty()
             ? 1.0
             : static_cast<double>(within) / static_cast<double>(this->Pixels.size());
  }

private:
  std::vector<int> Pixels;
  std::vector<double> Exact;
  double LeastSum = 0.0;
};
} // namespace tool

#endif
