// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GonioScatter.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace measuredbrdf
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;
constexpr std::size_t LeastViews = 4; // for each light
constexpr int Neighbors = 8;
constexpr double FinestStep = 1.5; // degrees
constexpr double CoarsestStep = 10.0;
constexpr double NodesPerReading = 16.0;
constexpr double FewNodes = 4096.0;
constexpr double MostNodes = 1e6;

// The readings around a view.
class Surroundings
{
public:
  Surroundings(float theta, float phi)
    : Across{ -std::sin(phi * Degree), std::cos(phi * Degree), 0.0 }
    , Down{ std::cos(theta * Degree) * std::cos(phi * Degree),
      std::cos(theta * Degree) * std::sin(phi * Degree), -std::sin(theta * Degree) }
  {
  }

  void Add(const double direction[3], const std::array<double, 3>& color)
  {
    const Eigen::Map<const Eigen::Vector3d> d(direction);
    this->Places.emplace_back(1.0, this->Across.dot(d), this->Down.dot(d));
    this->Colors.emplace_back(color.data());
  }

  /// The plane through them, by least squares with weights of the inverse squared distance, at the
  /// view, but within the range of their values: nothing overshoots.
  std::array<float, 3> Interpolate() const
  {
    double farthest = 0.0;
    for (const Eigen::Vector3d& place : this->Places)
    {
      farthest = std::max(farthest, place.tail<2>().squaredNorm());
    }
    Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d right = Eigen::Matrix3d::Zero(); // a column for each of R, G, B
    Eigen::Vector3d least = this->Colors.front();
    Eigen::Vector3d most = least;
    for (std::size_t k = 0; k < this->Places.size(); ++k)
    {
      const Eigen::Vector3d& place = this->Places[k];
      const double weight = farthest / (place.tail<2>().squaredNorm() + 1e-4 * farthest + 1e-12);
      left += weight * place * place.transpose();
      right += weight * place * this->Colors[k].transpose();
      least = least.cwiseMin(this->Colors[k]);
      most = most.cwiseMax(this->Colors[k]);
    }
    // Readings in a line, or a single one, say nothing across it: no slope there.
    left.diagonal().tail<2>().array() += 1e-6 * left(0, 0) * farthest + 1e-12;
    left(0, 0) += 1e-12;
    const Eigen::Vector3d value = left.ldlt().solve(right).row(0).transpose();
    std::array<float, 3> color;
    for (int c = 0; c < 3; ++c)
    {
      const double bounded = std::min(std::max(value[c], least[c]), most[c]);
      color[static_cast<std::size_t>(c)] = static_cast<float>(bounded);
    }
    return color;
  }

private:
  Eigen::Vector3d Across;
  Eigen::Vector3d Down;
  std::vector<Eigen::Vector3d> Places; // 1, and where they are on the tangent plane
  std::vector<Eigen::Vector3d> Colors;
};

// The views of one light, onto the nodes.
void Scatter(const GonioGrid& grid, const GonioReadings& readings,
  const std::vector<std::size_t>& members, float* rgb)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<std::array<double, 3>> colors(members.size());
  for (std::size_t k = 0; k < members.size(); ++k)
  {
    const GonioAngles& reading = readings.Angles[members[k]];
    double d[3];
    PointGonio(reading.ThetaO, reading.PhiO, d);
    points->InsertNextPoint(d);
    colors[k] = readings.GetColor(members[k]);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  vtkNew<vtkIdList> found;
  for (const float theta : grid.View.Theta)
  {
    for (const float phi : grid.View.Phi)
    {
      double d[3];
      PointGonio(theta, phi, d);
      locator->FindClosestNPoints(Neighbors, d, found);
      Surroundings near(theta, phi);
      for (vtkIdType k = 0; k < found->GetNumberOfIds(); ++k)
      {
        double at[3];
        points->GetPoint(found->GetId(k), at);
        near.Add(at, colors[static_cast<std::size_t>(found->GetId(k))]);
      }
      rgb = std::copy_n(near.Interpolate().data(), 3, rgb);
    }
  }
}

// Even nodes, about as dense as the readings; false: there are too few of them for each light.
bool ChooseViews(GonioGrid& grid, double readings, double lights)
{
  const double each = readings / lights;
  const double spacing = std::sqrt(2.0 / each / 3.14159265358979323846) * 90.0; // 2 pi sr
  double step = std::clamp(spacing / 1.5, FinestStep, CoarsestStep);
  const double most = std::min(NodesPerReading * readings + FewNodes, MostNodes);
  while (step < 2.0 * CoarsestStep && lights * (90.0 / step + 1.0) * (360.0 / step) > most)
  {
    step *= 1.1;
  }
  const int circles = static_cast<int>(std::lround(90.0 / step));
  grid.View.Theta.clear();
  for (int k = 0; k <= circles; ++k)
  {
    grid.View.Theta.push_back(Horizon * static_cast<float>(k) / static_cast<float>(circles));
  }
  grid.View.Phi = vtkAngularTableBRDF::GetEvenAzimuths(static_cast<int>(std::lround(360.0 / step)));
  return each >= static_cast<double>(LeastViews) &&
         lights * static_cast<double>(grid.GetViews()) <= MostNodes;
}
}

//------------------------------------------------------------------------------
std::string ScatterGonioReadings(
  GonioGrid& grid, const GonioReadings& readings, std::vector<float>& rgb)
{
  const double nodes = double(grid.Light.Theta.size()) * double(grid.Light.Phi.size());
  const auto count = static_cast<double>(readings.Angles.size());
  if (nodes > vtkAngularTableBRDF::MaximumNodes || !ChooseViews(grid, count, nodes))
  {
    return "found " + std::to_string(readings.Angles.size()) + " readings under " +
           std::to_string(grid.Light.Theta.size()) + " polar angles and " +
           std::to_string(grid.Light.Phi.size()) +
           " azimuths of the light, expected a grid, or several views under each";
  }
  std::vector<std::vector<std::size_t>> members(static_cast<std::size_t>(nodes));
  for (std::size_t k = 0; k < readings.Angles.size(); ++k)
  {
    if (readings.IsComplete(k))
    {
      members[FindGonioLight(grid, readings.Angles[k])].push_back(k);
    }
  }
  rgb.assign(3 * grid.GetSize(), 0.0f);
  const std::size_t views = 3 * grid.GetViews();
  std::vector<char> known(members.size(), 0);
  for (std::size_t light = 0; light < members.size(); ++light)
  {
    if (!members[light].empty())
    {
      Scatter(grid, readings, members[light], &rgb[light * views]);
      known[light] = 1;
    }
  }
  FillGonioLights(grid, views, rgb.data(), known);
  return "";
}
} // namespace measuredbrdf
