// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanPairs.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "ParallelFor.h"
#include "vtkEnvironment.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace measuredbrdf
{
namespace
{
constexpr double LampShare = 0.5; // of the pairs

// Densities of draws, each relative to that of a sphere's pixels.

// Of the view's cosine: half by the density 2 c of a disc, half by 1 / (2 sqrt(c)).
double DrawCosine(double x) { return x < 0.5 ? std::sqrt(2.0 * x) : std::pow(2.0 * x - 1.0, 2.0); }

double GetCosineDensity(double c)
{
  return (c + 0.25 / std::sqrt(std::max(c, 1e-6))) / (2.0 * std::max(c, 1e-6));
}

// Of mirror directions, about lamps: of a lamp's by its irradiance, and at distances of it that are
// uniform in their logarithm.
class LampDirections
{
public:
  explicit LampDirections(const std::vector<ExtractedEmitters::Light>& lamps)
  {
    double sum = 0.0;
    for (const ExtractedEmitters::Light& lamp : lamps)
    {
      const double luminance = vtkEnvironment::GetLuminance(&lamp.Irradiance.x);
      if (luminance > 0.0)
      {
        this->Lamps.push_back({ lamp.Direction, luminance });
        sum += luminance;
      }
    }
    for (Lamp& lamp : this->Lamps)
    {
      lamp.Share /= sum;
    }
  }

  bool IsEmpty() const { return this->Lamps.empty(); }

  glm::dvec3 Draw(double which, double x, double turn) const
  {
    std::size_t k = 0;
    for (; k + 1 < this->Lamps.size() && which >= this->Lamps[k].Share; ++k)
    {
      which -= this->Lamps[k].Share;
    }
    const double height = Least * std::pow(Largest / Least, x);
    const double s = std::sqrt(height * (2.0 - height));
    const double phi = 2.0 * Pi * turn;
    return FrameAbout(this->Lamps[k].Direction, glm::dvec3(0.0)) *
           glm::dvec3(s * std::cos(phi), s * std::sin(phi), 1.0 - height);
  }

  double GetDensity(const glm::dvec3& d) const
  {
    double sum = 0.0;
    for (const Lamp& lamp : this->Lamps)
    {
      const double height = 1.0 - glm::dot(d, lamp.Direction);
      if (height >= Least && height <= Largest)
      {
        sum += lamp.Share / height;
      }
    }
    return 2.0 / std::log(Largest / Least) * sum;
  }

private:
  struct Lamp
  {
    glm::dvec3 Direction;
    double Share;
  };
  // 1 - cos of 0.06 and 26 degrees.
  static constexpr double Least = 5e-7;
  static constexpr double Largest = 0.1;
  std::vector<Lamp> Lamps;
};

// Of points of a picture.
constexpr double Apart = 0.3; // of both directions together: so far away are no neighbors
// Of the way to each neighbor, at most, in both directions: their sum is nearly normal, with 0.7 of
// the points' distance as its standard deviation. Where points lie in rows, what all have about
// them is uniform within 0.02 % then, 4 exp(-2 pi^2 0.7^2).
constexpr double Reach = 0.5;
constexpr double MostAbout =
  64.0; // a point, at most so many of those that are drawn where it varies
constexpr double Rounding = 1e-12; // of a squared mean: variances below are none

double GetDistance(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b)
{
  const glm::dvec3 n = a[0] - b[0];
  const glm::dvec3 o = a[1] - b[1];
  return glm::dot(n, n) + glm::dot(o, o);
}

// moments: a count, a sum, and a sum of squares.
double GetVariance(const glm::dvec3& moments)
{
  const double mean = moments.y / std::max(moments.x, 1.0);
  const double variance = moments.z / std::max(moments.x, 1.0) - mean * mean;
  return variance > Rounding * mean * mean ? variance : 0.0;
}
}

PlanPairs MakeEmptyPairs()
{
  PlanPairs pairs;
  pairs.Normals = vtkSmartPointer<vtkDoubleArray>::New();
  pairs.Views = vtkSmartPointer<vtkDoubleArray>::New();
  pairs.Normals->SetNumberOfComponents(3);
  pairs.Views->SetNumberOfComponents(3);
  return pairs;
}

std::vector<double> GetPictureCameras()
{
  std::vector<double> cameras;
  for (int k = 0; k < 27; ++k)
  {
    const glm::ivec3 place(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const int axes = std::abs(place.x) + std::abs(place.y) + std::abs(place.z);
    if (axes == 1 || axes == 3)
    {
      const glm::dvec3 direction = glm::normalize(glm::dvec3(place));
      cameras.insert(cameras.end(), { direction.x, direction.y, direction.z });
    }
  }
  return cameras;
}

// The view, the normal and the mirror direction lie in one plane, the normal in the middle. The
// mirror direction and the view's cosine are independent.
PlanPairs DrawSpherePairs(int count, const std::vector<ExtractedEmitters::Light>& sources)
{
  const LampDirections lamps(sources);
  const double share = lamps.IsEmpty() ? 0.0 : LampShare;
  PlanPairs pairs = MakeEmptyPairs();
  pairs.Cameras = GetPictureCameras();
  for (int k = 0; k < count; ++k)
  {
    const unsigned int index = static_cast<unsigned int>(k + 1);
    const glm::dvec3 mirror =
      RadicalInverse(index, 11) >= share
        ? ToDirection(2.0 * RadicalInverse(index, 5) - 1.0, 2.0 * Pi * RadicalInverse(index, 7))
        : lamps.Draw(RadicalInverse(index, 13), RadicalInverse(index, 5), RadicalInverse(index, 7));
    const double c = DrawCosine(RadicalInverse(index, 2));
    const double turn = RadicalInverse(index, 3);
    const glm::dvec3 normal = FrameAbout(mirror, glm::dvec3(0.0)) * ToDirection(c, 2.0 * Pi * turn);
    const glm::dvec3 view = 2.0 * c * normal - mirror;
    const double density = share * lamps.GetDensity(mirror);
    pairs.Weights.push_back(1.0 / (GetCosineDensity(c) * (1.0 - share + density)));
    pairs.Normals->InsertNextTuple(&normal.x);
    pairs.Views->InsertNextTuple(&view.x);
  }
  return pairs;
}

void Turn(const double columns[9], PlanPairs& pairs)
{
  const glm::dmat3 rotation = glm::make_mat3(columns);
  for (vtkDoubleArray* directions : { pairs.Normals.Get(), pairs.Views.Get() })
  {
    for (vtkIdType k = 0; k < directions->GetNumberOfTuples(); ++k)
    {
      const glm::dvec3 turned = rotation * glm::make_vec3(directions->GetTuple(k));
      directions->SetTuple(k, &turned.x);
    }
  }
  for (std::size_t k = 0; k < pairs.Cameras.size(); k += 3)
  {
    const glm::dvec3 turned = rotation * glm::make_vec3(&pairs.Cameras[k]);
    std::copy_n(&turned.x, 3, &pairs.Cameras[k]);
  }
}

// Each round makes up for what the one before cut off.
std::vector<double> ScaleToSum(std::vector<double> weights, double count, double most)
{
  for (int round = 0; round < 8; ++round)
  {
    double open = count; // what is left for those below the most
    double sum = 0.0;    // that these have
    for (const double weight : weights)
    {
      open -= weight < most ? 0.0 : most;
      sum += weight < most ? weight : 0.0;
    }
    const double scale = sum > 0.0 ? std::max(open, 0.0) / sum : 0.0;
    for (double& weight : weights)
    {
      weight = weight < most ? std::min(weight * scale, most) : most;
    }
  }
  return weights;
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
  ParallelFor(0, static_cast<vtkIdType>(number),
    [this](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        this->Neighbors[static_cast<std::size_t>(k)] =
          this->FindNearest(static_cast<std::size_t>(k));
      }
    });
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

void PlanPoints::AddPairAbout(std::size_t point, PlanPairs& pairs)
{
  Pair pair = this->Points[point];
  const bool isFirst = this->Owners.size() < this->Points.size(); // the point itself
  std::array<double, Nearest> shares = {};
  for (double& share : shares)
  {
    share = isFirst ? 0.0 : Reach * (2.0 * this->Draw() - 1.0);
  }
  // About the point in the mean: on a silhouette all neighbors lie to one side.
  const double mean = std::accumulate(shares.begin(), shares.end(), 0.0) / Nearest;
  for (std::size_t k = 0; k < shares.size(); ++k)
  {
    for (std::size_t d = 0; d < 2; ++d)
    {
      pair[d] += (shares[k] - mean) * this->Points[this->Neighbors[point][k]][d];
    }
  }
  pair = { glm::normalize(pair[0]), glm::normalize(pair[1]) };
  // Beyond the horizon, as it is shaded.
  const bool isSeen = glm::dot(pair[0], pair[1]) >= MinimumViewCosine;
  const Pair& drawn = isFirst || !isSeen ? this->Points[point] : pair;
  pairs.Normals->InsertNextTuple(&drawn[0].x);
  pairs.Views->InsertNextTuple(&drawn[1].x);
  this->Owners.push_back(point);
}

PlanPairs PlanPoints::DrawAlike(vtkIdType count)
{
  PlanPairs pairs = MakeEmptyPairs();
  while (pairs.Normals->GetNumberOfTuples() < count && !this->Points.empty())
  {
    for (std::size_t k = 0; k < this->Points.size(); ++k)
    {
      this->AddPairAbout(k, pairs);
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
    std::vector<glm::dvec3> about(number, glm::dvec3(0.0));
    for (std::size_t k = 0; k < values->size(); ++k)
    {
      const double value = (*values)[k];
      about[this->Owners[k]] += glm::dvec3(1.0, value, value * value);
    }
    double sum = 0.0; // of the means
    for (const glm::dvec3& moments : about)
    {
      sum += moments.y / std::max(moments.x, 1.0);
    }
    for (std::size_t k = 0; k < number && sum > 0.0; ++k)
    {
      glm::dvec3 around = about[k];
      // They may have seen what it missed. A crowd among them counts for more: so does its finding.
      for (const std::size_t neighbor : this->Neighbors[k])
      {
        around += about[neighbor];
      }
      deviations[k] += GetVariance(around) / (sum * sum);
    }
  }
  std::transform(deviations.begin(), deviations.end(), deviations.begin(),
    [](double variance) { return std::sqrt(variance); });
  const std::vector<double> counts = ScaleToSum(deviations, count, MostAbout);
  PlanPairs pairs = MakeEmptyPairs();
  double at = 0.5;
  for (std::size_t k = 0; k < number; ++k)
  {
    for (at += counts[k]; at >= 1.0; at -= 1.0)
    {
      this->AddPairAbout(k, pairs);
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
} // namespace measuredbrdf
