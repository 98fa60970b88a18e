// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LobeMeans.h"

#include "HalfVector.h" // for Pi
#include "LobeQuadrature.h"

#include <algorithm>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr double FloorCosine = 0.17; // 80 degrees: measured f drops or soars beyond
constexpr double LeastShare = 1e-6;  // of the albedo: below, the rest is rounding of floats

// The normal where there is no direction.
glm::dvec3 ToUnit(const glm::dvec3& d)
{
  const double length = glm::length(d);
  return length > 0.0 ? d / length : glm::dvec3(0.0, 0.0, 1.0);
}
}

LobeMeans::LobeMeans(const LobeQuadrature& quadrature)
  : Floor(glm::max(quadrature.GetFloor(FloorCosine), glm::dvec3(0.0)))
{
  const glm::dvec3 albedo = quadrature.GetAlbedo();
  this->Albedo = albedo.x + albedo.y + albedo.z;
  glm::dvec3 axis(0.0);
  for (const LobeQuadrature::Cell& cell : quadrature.GetCells())
  {
    this->Amplitude += cell.Weight - this->Floor * cell.Cosine;
    const double energy = LobeQuadrature::GetEnergy(cell, this->Floor);
    const double density = energy / cell.SolidAngle;
    axis += cell.Direction * (energy * density * density);
  }
  for (int c = 0; c < 3; ++c)
  {
    if (this->Amplitude[c] <= LeastShare * Pi * this->Floor[c])
    {
      this->Amplitude[c] = 0.0;
    }
  }
  this->Axis = ToUnit(axis);
  this->Delta = std::atan2(-this->Axis.x, this->Axis.z);
}

double LobeMeans::GetDistance(const LobeMeans& a, const LobeMeans& b)
{
  const glm::dvec3 differences =
    glm::max(glm::abs(a.Amplitude - b.Amplitude), Pi * glm::abs(a.Floor - b.Floor));
  const double largest = std::max({ differences.x, differences.y, differences.z });
  return std::max(largest > 0.0 ? 3.0 * largest / a.Albedo : 0.0, std::abs(a.Delta - b.Delta));
}

void LobeMeans::Add(const LobeMeans& other, double weight)
{
  this->Floor += weight * other.Floor;
  this->Amplitude += weight * other.Amplitude;
  this->Delta += weight * other.Delta;
  this->Axis += weight * other.Axis;
  this->Albedo += weight * other.Albedo;
}

void LobeMeans::Clamp()
{
  this->Floor = glm::max(this->Floor, glm::dvec3(0.0));
  this->Amplitude = glm::max(this->Amplitude, glm::dvec3(0.0));
  this->Albedo = std::max(this->Albedo, 0.0);
  this->Axis = ToUnit(this->Axis);
}
} // namespace measuredbrdf
