// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanPoints.h"

#include "LocalFrame.h" // for MinimumViewCosine
#include "ParallelFor.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr double Apart = 0.3; // of both directions together: so far away are no neighbors
// Of the way to each neighbor, at most, in both directions: their sum is nearly normal, with 0.7 of
// the points' distance as its standard deviation. Where points lie in rows, what all have about
// them is uniform within 0.02 % then, 4 exp(-2 pi^2 0.7^2).
constexpr double Reach = 0.5;
constexpr double Cells = 32767.0; // of each dimension in which pairs are ordered
constexpr int MostAbout = 64; // a point, at most so many of those that are drawn where it varies
constexpr double Rounding = 1e-12; // of a squared mean: variances below are none

double GetDistance(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b)
{
  const glm::dvec3 n = a[0] - b[0];
  const glm::dvec3 o = a[1] - b[1];
  return glm::dot(n, n) + glm::dot(o, o);
}

// Sums, for a variance.
struct Moments
{
  double Count = 0.0;
  double Sum = 0.0;
  double Squares = 0.0;

  void Add(double value)
  {
    this->Count += 1.0;
    this->Sum += value;
    this->Squares += value * value;
  }
  void Add(const Moments& other)
  {
    this->Count += other.Count;
    this->Sum += other.Sum;
    this->Squares += other.Squares;
  }
  double GetVariance() const
  {
    const double mean = this->Sum / std::max(this->Count, 1.0);
    const double variance = this->Squares / std::max(this->Count, 1.0) - mean * mean;
    return variance > Rounding * mean * mean ? variance : 0.0;
  }
};
}

PlanPoints::PlanPoints(const PlanPairs& given)
{
  for (vtkIdType k = 0; k < given.Normals->GetNumberOfTuples(); ++k)
  {
    this->Points.push_back(
      { glm::make_vec3(given.Normals->GetTuple(k)), glm::make_vec3(given.Views->GetTuple(k)) });
  }
  const std::size_t number = this->Points.size();
  this->Neighbors.resize(number);
  measuredbrdf::ParallelFor(0, static_cast<vtkIdType>(number),
    [this](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        this->Neighbors[static_cast<std::size_t>(k)] =
          this->FindNearest(static_cast<std::size_t>(k));
      }
    });
  this->Middles.assign(number, Pair{ glm::dvec3(0.0), glm::dvec3(0.0) });
  for (std::size_t k = 0; k < number; ++k)
  {
    for (const std::size_t neighbor : this->Neighbors[k])
    {
      this->Middles[k][0] += this->Points[neighbor][0] / static_cast<double>(Nearest);
      this->Middles[k][1] += this->Points[neighbor][1] / static_cast<double>(Nearest);
    }
  }
}

// From the closest on: itself where there are not so many.
std::array<std::size_t, PlanPoints::Nearest> PlanPoints::FindNearest(std::size_t of) const
{
  std::array<std::size_t, Nearest> nearest;
  std::array<double, Nearest> distances;
  nearest.fill(of);
  distances.fill(Apart * Apart);
  for (std::size_t k = 0; k < this->Points.size(); ++k)
  {
    const double distance = GetDistance(this->Points[k], this->Points[of]);
    if (k == of || distance >= distances.back())
    {
      continue;
    }
    std::size_t at = Nearest - 1;
    for (; at > 0 && distances[at - 1] > distance; --at)
    {
      distances[at] = distances[at - 1];
      nearest[at] = nearest[at - 1];
    }
    distances[at] = distance;
    nearest[at] = k;
  }
  return nearest;
}

double PlanPoints::Draw()
{
  return static_cast<double>(this->Engine()) / static_cast<double>(std::mt19937::max());
}

PlanPoints::Pair PlanPoints::DrawAbout(std::size_t point)
{
  // About the point in the mean: on a silhouette all neighbors lie to one side.
  Pair between = this->Points[point];
  for (const std::size_t neighbor : this->Neighbors[point])
  {
    const double share = Reach * (2.0 * this->Draw() - 1.0);
    for (std::size_t d = 0; d < 2; ++d)
    {
      between[d] += share * (this->Points[neighbor][d] - this->Middles[point][d]);
    }
  }
  between = { glm::normalize(between[0]), glm::normalize(between[1]) };
  // Beyond the horizon, as it is shaded.
  return glm::dot(between[0], between[1]) >= MinimumViewCosine ? between : this->Points[point];
}

PlanPairs PlanPoints::DrawAlike(vtkIdType count)
{
  PlanPairs pairs = MakeEmptyPairs();
  while (pairs.Normals->GetNumberOfTuples() < count && !this->Points.empty())
  {
    const bool first = this->Owners.empty();
    for (std::size_t k = 0; k < this->Points.size(); ++k)
    {
      const Pair pair = first ? this->Points[k] : this->DrawAbout(k);
      pairs.Normals->InsertNextTuple(&pair[0].x);
      pairs.Views->InsertNextTuple(&pair[1].x);
      this->Owners.push_back(k);
    }
  }
  return pairs;
}

PlanPairs PlanPoints::DrawWhereItVaries(
  const std::vector<double>& differences, const std::vector<double>& radiances, int count)
{
  const std::size_t number = this->Points.size();
  std::vector<double> deviations(number, 0.0);
  for (const std::vector<double>* values : { &differences, &radiances })
  {
    std::vector<Moments> about(number);
    for (std::size_t k = 0; k < values->size(); ++k)
    {
      about[this->Owners[k]].Add((*values)[k]);
    }
    double sum = 0.0; // of the means
    for (const Moments& moments : about)
    {
      sum += moments.Sum / std::max(moments.Count, 1.0);
    }
    for (std::size_t k = 0; k < number && sum > 0.0; ++k)
    {
      Moments around = about[k];
      // They may have seen what it missed. A crowd among them counts for more: so does its finding.
      for (const std::size_t neighbor : this->Neighbors[k])
      {
        around.Add(about[neighbor]);
      }
      deviations[k] += around.GetVariance() / (sum * sum);
    }
  }
  double sum = 0.0;
  for (double& deviation : deviations)
  {
    deviation = std::sqrt(deviation);
    sum += deviation;
  }
  double left = count;
  std::vector<double> counts(number, 0.0);
  for (int round = 0; round < 8 && sum > 0.0 && left > 0.5; ++round) // each shares what was cut off
  {
    const double scale = left / sum;
    left = sum = 0.0;
    for (std::size_t k = 0; k < number; ++k)
    {
      counts[k] += scale * deviations[k];
      left += std::max(counts[k] - MostAbout, 0.0);
      deviations[k] = counts[k] >= MostAbout ? 0.0 : deviations[k];
      counts[k] = std::min(counts[k], static_cast<double>(MostAbout));
      sum += deviations[k];
    }
  }
  PlanPairs pairs = MakeEmptyPairs();
  double at = 0.5;
  for (std::size_t k = 0; k < number; ++k)
  {
    for (at += counts[k]; at >= 1.0; at -= 1.0)
    {
      const Pair pair = this->DrawAbout(k);
      pairs.Normals->InsertNextTuple(&pair[0].x);
      pairs.Views->InsertNextTuple(&pair[1].x);
      this->Owners.push_back(k);
    }
  }
  return pairs;
}

void PlanPoints::Weigh(PlanPairs& pairs) const
{
  std::vector<double> counts(this->Points.size(), 0.0);
  for (const std::size_t owner : this->Owners)
  {
    counts[owner] += 1.0;
  }
  pairs.Points = this->Owners;
  pairs.Weights.clear();
  for (const std::size_t owner : this->Owners)
  {
    pairs.Weights.push_back(1.0 / counts[owner]);
  }
}

// On Morton's curve (1966, "A Computer Oriented Geodetic Data Base and a New Technique in File
// Sequencing"), in four dimensions.
std::vector<std::size_t> OrderByPlace(const PlanPairs& pairs)
{
  std::vector<glm::dvec4> places;
  glm::dvec4 least(HUGE_VAL);
  glm::dvec4 most(-HUGE_VAL);
  for (vtkIdType k = 0; k < pairs.Normals->GetNumberOfTuples(); ++k)
  {
    const glm::dvec3 normal = glm::make_vec3(pairs.Normals->GetPointer(3 * k));
    const glm::dvec3 view = glm::make_vec3(pairs.Views->GetPointer(3 * k));
    const double cosine = glm::dot(normal, view);
    places.emplace_back(2.0 * cosine * normal - view, cosine);
    least = glm::min(least, places.back());
    most = glm::max(most, places.back());
  }
  const glm::dvec4 range = most - least; // of a plate: far less than that of a sphere
  const double scale =
    Cells / std::max({ range.x, range.y, range.z, range.w, std::numeric_limits<double>::min() });
  std::vector<std::pair<std::uint64_t, std::size_t>> keys;
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    std::uint64_t key = 0;
    for (glm::length_t c = 0; c < 4; ++c)
    {
      const double place = scale * (places[k][c] - least[c]);
      auto cell = static_cast<std::uint64_t>(place > 0.0 ? std::min(place, Cells) : 0.0);
      for (unsigned int bit = 0; cell > 0; ++bit, cell >>= 1U)
      {
        key |= (cell & 1U) << (4U * bit + static_cast<unsigned int>(c));
      }
    }
    keys.emplace_back(key, k);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& key : keys)
  {
    order.push_back(key.second);
  }
  return order;
}
} // namespace measuredbrdf
