// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GonioTable.h"

#include "HalfVector.h"
#include "NumberText.h"
#include "vtkAngularTableBRDF.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace measuredbrdf
{
namespace
{
using Nodes = vtkAngularTableBRDF::Nodes;
using Readings = std::vector<GonioReading>;

constexpr float SameAngle = 0.01f; // degrees: angles that differ by less are one
constexpr float Horizon = 90.0f;   // degrees from the normal
constexpr float HalfTurn = 180.0f;
constexpr float FullTurn = 360.0f;

// A grid may have at most so many nodes, of lights and views together, and so many for each reading
// unless it is small. What has more is no grid.
constexpr double MaximumGonioNodes = 4e6;
constexpr double GridNodesPerReading = 4.0;
constexpr double SmallGrid = 4096.0;

// Even nodes for readings that lie on no grid.
constexpr double LeastViews = 4.0; // for each light
constexpr int Neighbors = 8;
constexpr double FinestStep = 1.5; // degrees
constexpr double CoarsestStep = 10.0;
constexpr double NodesPerReading = 16.0;
constexpr double FewNodes = 4096.0;
constexpr double MostNodes = 1e6;

bool IsPole(float theta) { return theta < SameAngle; }

glm::dvec3 ToDirection(float theta, float phi)
{
  const double t = ToRadians(theta);
  const double p = ToRadians(phi);
  return { std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t) };
}

// Of angles that count as one, the least.
std::vector<float> FindAngles(const Readings& readings, const float GonioReading::*member)
{
  std::vector<float> angles;
  for (const GonioReading& reading : readings)
  {
    angles.push_back(reading.*member);
  }
  std::sort(angles.begin(), angles.end());
  std::vector<float> nodes;
  for (const float angle : angles)
  {
    if (nodes.empty() || angle - nodes.back() >= SameAngle)
    {
      nodes.push_back(angle);
    }
  }
  return nodes;
}

std::size_t FindNode(const Nodes& nodes, float theta, float phi)
{
  const auto find = [](const std::vector<float>& angles, float angle)
  { return std::upper_bound(angles.begin(), angles.end(), angle) - angles.begin() - 1; };
  return static_cast<std::size_t>(find(nodes.Theta, theta)) * nodes.Phi.size() +
         static_cast<std::size_t>(find(nodes.Phi, phi));
}

// The last circle's values hold up to the horizon: HoleFiller gives them to a circle there.
void AddHorizon(Nodes& nodes)
{
  if (nodes.Theta.size() > 1 && nodes.Theta.back() < Horizon)
  {
    nodes.Theta.push_back(Horizon);
  }
}

//------------------------------------------------------------------------------
// Lights, views, and RGB at each pair of them.
struct GonioGrid
{
  Nodes Light;
  Nodes View;
  std::vector<float> RGB;

  std::size_t GetLights() const { return this->Light.Theta.size() * this->Light.Phi.size(); }
  std::size_t GetViews() const { return this->View.Theta.size() * this->View.Phi.size(); }
  float* GetViewsOf(std::size_t light) { return &this->RGB[3 * light * this->GetViews()]; }
};

//------------------------------------------------------------------------------
// Calls set(k, a, b, share) for each place that is not known: its value is a share of the way from
// the known one before it, a, to the one behind it, b. Beyond the ends an axis goes on as it ends,
// or from its beginning where it has a period. Returns whether anything is known.
template <typename Set>
bool FillAxis(const std::vector<float>& places, const char* known, double period, const Set& set)
{
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    if (known[k])
    {
      found.push_back(k);
    }
  }
  const auto distance = [&](std::size_t from, std::size_t to)
  {
    const double apart = double(places[to]) - places[from];
    return apart < 0.0 ? apart + period : apart;
  };
  for (std::size_t k = 0, next = 0; k < places.size() && !found.empty(); ++k)
  {
    if (known[k])
    {
      ++next; // the known one behind k
      continue;
    }
    std::size_t a = found[(next + found.size() - 1) % found.size()];
    std::size_t b = found[next % found.size()];
    if (period == 0.0 && (next == 0 || next == found.size()))
    {
      a = b = next == 0 ? found.front() : found.back();
    }
    const double gap = distance(a, b);
    set(k, a, b, gap > 0.0 ? distance(a, k) / gap : 0.0);
  }
  return !found.empty();
}

// Items of `size` values at the nodes: those that are not known are interpolated around the circle
// of their polar angle, and circles of which nothing is known between others.
void FillHoles(const Nodes& nodes, std::size_t size, float* values, const std::vector<char>& known)
{
  const std::size_t azimuths = nodes.Phi.size();
  const auto mix = [&](std::size_t item, std::size_t a, std::size_t b, double share)
  {
    for (std::size_t k = 0; k < size; ++k)
    {
      values[item * size + k] =
        static_cast<float>((1.0 - share) * values[a * size + k] + share * values[b * size + k]);
    }
  };
  std::vector<char> circles;
  for (std::size_t first = 0; first < known.size(); first += azimuths)
  {
    circles.push_back(FillAxis(nodes.Phi, &known[first], FullTurn,
      [&](std::size_t k, std::size_t a, std::size_t b, double share)
      { mix(first + k, first + a, first + b, share); }));
  }
  FillAxis(nodes.Theta, circles.data(), 0.0,
    [&](std::size_t k, std::size_t a, std::size_t b, double share)
    {
      for (std::size_t p = 0; p < azimuths; ++p)
      {
        mix(k * azimuths + p, a * azimuths + p, b * azimuths + p, share);
      }
    });
}

//------------------------------------------------------------------------------
// The readings at their nodes, the rest filled; notes say how many of each.
void FillGrid(GonioGrid& grid, const Readings& readings, MaterialFile& result)
{
  const float lastLight = grid.Light.Theta.back();
  const float lastView = grid.View.Theta.back();
  AddHorizon(grid.Light);
  AddHorizon(grid.View);
  const std::size_t lights = grid.GetLights();
  const std::size_t views = grid.GetViews();
  grid.RGB.assign(3 * lights * views, 0.0f);
  std::vector<unsigned int> counts(lights * views, 0);
  std::size_t repeated = 0;
  for (const GonioReading& reading : readings)
  {
    const std::size_t at = FindNode(grid.Light, reading.ThetaI, reading.PhiI) * views +
                           FindNode(grid.View, reading.ThetaO, reading.PhiO);
    repeated += counts[at] > 0;
    ++counts[at];
    for (int c = 0; c < 3; ++c)
    {
      float& mean = grid.RGB[3 * at + static_cast<std::size_t>(c)]; // so far
      mean += (static_cast<float>(reading.Color[c]) - mean) / static_cast<float>(counts[at]);
    }
  }
  std::vector<char> litLights;
  std::size_t missing = 0; // but for directions along the normal, which have one value
  for (std::size_t light = 0; light < lights; ++light)
  {
    const float thetaI = grid.Light.Theta[light / grid.Light.Phi.size()];
    std::vector<char> known;
    for (std::size_t view = 0; view < views; ++view)
    {
      const float thetaO = grid.View.Theta[view / grid.View.Phi.size()];
      known.push_back(counts[light * views + view] > 0);
      missing += !known.back() && !IsPole(thetaI) && !IsPole(thetaO) && thetaI <= lastLight &&
                 thetaO <= lastView;
    }
    litLights.push_back(std::find(known.begin(), known.end(), 1) != known.end());
    FillHoles(grid.View, 3, grid.GetViewsOf(light), known);
  }
  FillHoles(grid.Light, 3 * views, grid.RGB.data(), litLights);
  if (missing > 0)
  {
    result.AddNote(std::to_string(missing) +
                   " values are missing in the grid of angles: filled from their neighbors.");
  }
  if (repeated > 0)
  {
    result.AddNote(std::to_string(repeated) + " values repeat others' angles: averaged.");
  }
}

//------------------------------------------------------------------------------
// The plane through readings around a view, by least squares with weights of the inverse squared
// distance, at the view (moving least squares, Lancaster and Salkauskas 1981). The result stays
// within the range of their values: nothing overshoots. A row of points or colors is a reading.
Eigen::Vector3d Interpolate(
  float theta, float phi, const Eigen::MatrixX3d& points, const Eigen::MatrixX3d& colors)
{
  const double t = ToRadians(theta);
  const double p = ToRadians(phi);
  Eigen::MatrixX3d places(points.rows(), 3); // 1, and where they are on the tangent plane
  places.col(0).setOnes();
  places.col(1) = points * Eigen::Vector3d(-std::sin(p), std::cos(p), 0.0);
  places.col(2) =
    points * Eigen::Vector3d(std::cos(t) * std::cos(p), std::cos(t) * std::sin(p), -std::sin(t));
  const Eigen::ArrayXd squares = places.rightCols<2>().rowwise().squaredNorm();
  const double farthest = squares.maxCoeff();
  const Eigen::VectorXd weights = farthest / (squares + 1e-4 * farthest + 1e-12);
  const Eigen::MatrixX3d weighted = weights.asDiagonal() * places;
  Eigen::Matrix3d left = places.transpose() * weighted;
  // Readings in a line, or a single one, say nothing across it: no slope there.
  left.diagonal().tail<2>().array() += 1e-6 * left(0, 0) * farthest + 1e-12;
  left(0, 0) += 1e-12;
  const Eigen::Matrix3d planes = left.ldlt().solve(weighted.transpose() * colors);
  return planes.row(0)
    .cwiseMax(colors.colwise().minCoeff())
    .cwiseMin(colors.colwise().maxCoeff())
    .transpose();
}

// The views of one light, onto the nodes.
void Scatter(const Nodes& views, const std::vector<const GonioReading*>& readings, float* rgb)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const GonioReading* reading : readings)
  {
    points->InsertNextPoint(&ToDirection(reading->ThetaO, reading->PhiO)[0]);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  vtkNew<vtkIdList> found;
  for (const float theta : views.Theta)
  {
    for (const float phi : views.Phi)
    {
      locator->FindClosestNPoints(Neighbors, &ToDirection(theta, phi)[0], found);
      Eigen::MatrixX3d near(found->GetNumberOfIds(), 3);
      Eigen::MatrixX3d colors(found->GetNumberOfIds(), 3);
      for (vtkIdType k = 0; k < found->GetNumberOfIds(); ++k)
      {
        const vtkIdType id = found->GetId(k);
        near.row(k) = Eigen::Map<const Eigen::RowVector3d>(points->GetPoint(id));
        colors.row(k) =
          Eigen::Map<const Eigen::RowVector3d>(&readings[static_cast<std::size_t>(id)]->Color[0]);
      }
      rgb = std::copy_n(Interpolate(theta, phi, near, colors).cast<float>().eval().data(), 3, rgb);
    }
  }
}

// Even views, about as dense as the readings; false: there are too few readings for each light.
bool ChooseViews(Nodes& views, double readings, double lights)
{
  const double each = readings / lights;
  const double spacing = std::sqrt(2.0 / each / Pi) * 90.0; // 2 pi sr
  double step = std::clamp(spacing / 1.5, FinestStep, CoarsestStep);
  const double most = std::min(NodesPerReading * readings + FewNodes, MostNodes);
  while (step < 2.0 * CoarsestStep && lights * (90.0 / step + 1.0) * (360.0 / step) > most)
  {
    step *= 1.1;
  }
  const auto circles = static_cast<int>(std::lround(90.0 / step));
  views.Theta.clear();
  for (int k = 0; k <= circles; ++k)
  {
    views.Theta.push_back(Horizon * static_cast<float>(k) / static_cast<float>(circles));
  }
  views.Phi = vtkAngularTableBRDF::GetEvenAzimuths(static_cast<int>(std::lround(360.0 / step)));
  return each >= LeastViews && lights * views.GetNumberOfNodes() <= MostNodes;
}

// Gives the grid even views and interpolates the readings of each light onto them.
void ScatterReadings(GonioGrid& grid, const Readings& readings, const std::string& where)
{
  const std::size_t polar = grid.Light.Theta.size();
  const double lights = double(polar) * double(grid.Light.Phi.size());
  if (lights > vtkAngularTableBRDF::MaximumNodes / 2.0 ||
      !ChooseViews(grid.View, double(readings.size()), lights))
  {
    throw FileError(where + ": found " + std::to_string(readings.size()) + " readings under " +
                    std::to_string(polar) + " polar angles and " +
                    std::to_string(grid.Light.Phi.size()) +
                    " azimuths of the light, expected a grid, or several views under each");
  }
  AddHorizon(grid.Light);
  std::vector<std::vector<const GonioReading*>> members(grid.GetLights());
  for (const GonioReading& reading : readings)
  {
    members[FindNode(grid.Light, reading.ThetaI, reading.PhiI)].push_back(&reading);
  }
  grid.RGB.assign(3 * grid.GetLights() * grid.GetViews(), 0.0f);
  std::vector<char> known;
  for (std::size_t light = 0; light < members.size(); ++light)
  {
    known.push_back(!members[light].empty());
    if (known.back())
    {
      Scatter(grid.View, members[light], grid.GetViewsOf(light));
    }
  }
  FillHoles(grid.Light, 3 * grid.GetViews(), grid.RGB.data(), known);
}

//------------------------------------------------------------------------------
// The mean of `count` items of `size` values, in each of them.
void Average(float* values, std::size_t count, std::size_t size)
{
  for (std::size_t k = 0; k < size; ++k)
  {
    double sum = 0.0;
    for (std::size_t item = 0; item < count; ++item)
    {
      sum += values[item * size + k];
    }
    for (std::size_t item = 0; item < count; ++item)
    {
      values[item * size + k] = static_cast<float>(sum / static_cast<double>(count));
    }
  }
}

// A direction along the normal has one value.
void AveragePoles(GonioGrid& grid, bool isotropic)
{
  const std::size_t azimuths = grid.View.Phi.size();
  for (std::size_t light = 0; light < grid.GetLights() && IsPole(grid.View.Theta[0]); ++light)
  {
    Average(grid.GetViewsOf(light), azimuths, 3);
  }
  if (IsPole(grid.Light.Theta[0]))
  {
    Average(grid.RGB.data(), grid.Light.Phi.size(), 3 * grid.GetViews());
    for (std::size_t t = 0; t < grid.View.Theta.size() && isotropic; ++t)
    {
      Average(&grid.RGB[3 * t * azimuths], azimuths, 3);
    }
  }
}

//------------------------------------------------------------------------------
// In [0, 360).
float Wrap(float phi)
{
  const float turned = phi - FullTurn * std::floor(phi / FullTurn);
  return turned < FullTurn - 0.5f * SameAngle ? turned : 0.0f;
}

// Azimuths in [0, 360), and from the light's where that is the same in all. Returns whether it is.
bool TurnAzimuths(Readings& readings)
{
  const GonioReading* first = nullptr;
  bool isotropic = true;
  for (GonioReading& reading : readings)
  {
    reading.PhiI = Wrap(reading.PhiI);
    if (!IsPole(reading.ThetaI)) // there it means nothing
    {
      first = first ? first : &reading;
      const float apart = std::abs(reading.PhiI - first->PhiI);
      isotropic = isotropic && std::min(apart, FullTurn - apart) < SameAngle;
    }
  }
  for (GonioReading& reading : readings)
  {
    reading.PhiO = Wrap(isotropic ? reading.PhiO - reading.PhiI : reading.PhiO);
    reading.PhiI = isotropic ? 0.0f : reading.PhiI;
  }
  return isotropic;
}

// Adds views on the other side of the plane of incidence if there are none. Returns whether it did.
bool Mirror(Readings& readings)
{
  if (std::any_of(readings.begin(), readings.end(),
        [](const GonioReading& reading) { return reading.PhiO > HalfTurn + SameAngle; }))
  {
    return false;
  }
  const std::size_t count = readings.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    GonioReading mirrored = readings[k];
    if (mirrored.PhiO > SameAngle && mirrored.PhiO < HalfTurn - SameAngle &&
        !IsPole(mirrored.ThetaO))
    {
      mirrored.PhiO = FullTurn - mirrored.PhiO;
      readings.push_back(mirrored);
    }
  }
  return readings.size() > count;
}

std::string DescribeAngles(const Readings& readings)
{
  const auto range = [&readings](const float GonioReading::*member)
  {
    const auto [low, high] = std::minmax_element(readings.begin(), readings.end(),
      [member](const GonioReading& a, const GonioReading& b) { return a.*member < b.*member; });
    return NumberText((*low).*member, 3) + " to " + NumberText((*high).*member, 3);
  };
  return "Measured with light at " + range(&GonioReading::ThetaI) + " and views at " +
         range(&GonioReading::ThetaO) + " degrees from the normal; constant outside these angles.";
}

// Relative root mean square.
double GetError(vtkBRDF* brdf, const Readings& readings)
{
  double error = 0.0;
  double sum = 0.0;
  for (const GonioReading& reading : readings)
  {
    const glm::dvec3 i = ToDirection(reading.ThetaI, reading.PhiI);
    const glm::dvec3 o = ToDirection(reading.ThetaO, reading.PhiO);
    if (i.z > 0.0 && o.z > 0.0)
    {
      glm::dvec3 f;
      brdf->Evaluate(&i[0], &o[0], &f[0]);
      const glm::dvec3 difference = f - glm::max(reading.Color, 0.0);
      error += glm::dot(difference, difference);
      sum += glm::dot(reading.Color, reading.Color);
    }
  }
  return sum > 0.0 ? std::sqrt(error / sum) : 0.0;
}
}

//------------------------------------------------------------------------------
void MakeGonioTable(
  std::vector<GonioReading> readings, const std::string& where, MaterialFile& result)
{
  if (readings.empty())
  {
    throw FileError(where + ": found no readings");
  }
  result.AddNote(DescribeAngles(readings));
  const bool isotropic = TurnAzimuths(readings);
  if (isotropic && Mirror(readings))
  {
    result.AddNote("Views lie on one side of the plane of incidence: mirrored.");
  }
  GonioGrid grid;
  grid.Light = { FindAngles(readings, &GonioReading::ThetaI),
    FindAngles(readings, &GonioReading::PhiI) };
  grid.View = { FindAngles(readings, &GonioReading::ThetaO),
    FindAngles(readings, &GonioReading::PhiO) };
  const double lights = double(grid.Light.Theta.size()) * double(grid.Light.Phi.size());
  const double views = double(grid.View.Theta.size()) * double(grid.View.Phi.size());
  const double most = vtkAngularTableBRDF::MaximumNodes / 2.0; // the horizon is added
  const bool isGrid =
    lights <= most && views <= most && lights * views <= MaximumGonioNodes &&
    lights * views <= std::max(GridNodesPerReading * double(readings.size()), SmallGrid);
  if (isGrid)
  {
    FillGrid(grid, readings, result);
  }
  else
  {
    ScatterReadings(grid, readings, where);
  }
  AveragePoles(grid, isotropic);
  vtkNew<vtkAngularTableBRDF> table;
  const std::string problem = table->SetValues(grid.Light, grid.View, std::move(grid.RGB),
    isotropic ? vtkAngularTableBRDF::LIGHT : vtkAngularTableBRDF::TANGENT);
  if (!problem.empty())
  {
    throw FileError(where + ": " + problem);
  }
  if (!isGrid)
  {
    result.AddNote("The views are scattered: interpolated onto " +
                   std::to_string(grid.View.Theta.size()) + " x " +
                   std::to_string(grid.View.Phi.size()) +
                   " even nodes, whose relative RMS difference from the readings is " +
                   NumberText(GetError(table, readings), 3) + ".");
  }
  constexpr double darkest = 0.005; // soot reflects more
  NoteStrangeAlbedo(table, darkest, "its values may be in another unit than 1/sr.", result);
  result.BRDF = table;
}
} // namespace measuredbrdf
