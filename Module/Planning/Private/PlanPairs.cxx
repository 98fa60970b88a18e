// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanPairs.h"

#include "HalfVector.h" // for Pi
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "vtkEnvironment.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

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

std::vector<glm::dvec3> GetPictureCameras()
{
  std::vector<glm::dvec3> cameras;
  for (int k = 0; k < 27; ++k)
  {
    const glm::ivec3 place(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const int axes = std::abs(place.x) + std::abs(place.y) + std::abs(place.z);
    if (axes == 1 || axes == 3)
    {
      cameras.push_back(glm::normalize(glm::dvec3(place)));
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
  for (glm::dvec3& camera : pairs.Cameras)
  {
    camera = rotation * camera;
  }
}
} // namespace measuredbrdf
