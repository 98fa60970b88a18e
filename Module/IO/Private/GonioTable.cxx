// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialFormat.h"

#include "HalfVector.h"
#include "vtkAngularTableBRDF.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
using Nodes = vtkAngularTableBRDF::Nodes;
using Readings = std::vector<GonioReading>;
using Index = Eigen::Index;

// An item a row: the colors of a light's views, say.
using Items = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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
constexpr double FinestStep = 2.0; // degrees
constexpr double CoarsestStep = 20.0;
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
  const auto isSame = [](float kept, float angle) { return angle - kept < SameAngle; };
  angles.erase(std::unique(angles.begin(), angles.end(), isSame), angles.end());
  return angles;
}

Index FindNode(const Nodes& nodes, float theta, float phi)
{
  const auto find = [](const std::vector<float>& angles, float angle)
  { return std::upper_bound(angles.begin(), angles.end(), angle) - angles.begin() - 1; };
  return find(nodes.Theta, theta) * Index(nodes.Phi.size()) + find(nodes.Phi, phi);
}

double CountNodes(const Nodes& nodes)
{
  return static_cast<double>(nodes.Theta.size()) * static_cast<double>(nodes.Phi.size());
}

// The last circle's values hold up to the horizon: FillHoles gives them to a circle there.
void AddHorizon(Nodes& nodes)
{
  if (nodes.Theta.size() > 1 && nodes.Theta.back() < Horizon)
  {
    nodes.Theta.push_back(Horizon);
  }
}

//------------------------------------------------------------------------------
// Lights, views, and RGB at each pair of them: a row for each light, a color for each view.
struct GonioGrid
{
  Nodes Light;
  Nodes View;
  Items RGB;

  void Resize() { this->RGB.setZero(Index(CountNodes(Light)), 3 * Index(CountNodes(View))); }

  // The colors of a light's views, one a row.
  Eigen::Map<Items> GetViews(Index light)
  {
    return { &this->RGB(light, 0), this->RGB.cols() / 3, 3 };
  }
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
    set(Index(k), Index(a), Index(b), float(gap > 0.0 ? distance(a, k) / gap : 0.0));
  }
  return !found.empty();
}

// Items at the nodes: those that are not known are interpolated around the circle of their polar
// angle, and circles of which nothing is known between others.
void FillHoles(const Nodes& nodes, Eigen::Ref<Items> items, const std::vector<char>& known)
{
  const Index azimuths = Index(nodes.Phi.size());
  // Of count items from each of the three.
  const auto mix = [&](Index count, Index item, Index a, Index b, float share)
  {
    items.middleRows(item, count) =
      (1.0f - share) * items.middleRows(a, count) + share * items.middleRows(b, count);
  };
  std::vector<char> circles;
  for (Index first = 0; first < Index(known.size()); first += azimuths)
  {
    circles.push_back(FillAxis(nodes.Phi, &known[std::size_t(first)], FullTurn,
      [&](Index k, Index a, Index b, float share)
      { mix(1, first + k, first + a, first + b, share); }));
  }
  FillAxis(nodes.Theta, circles.data(), 0.0,
    [&](Index k, Index a, Index b, float share)
    { mix(azimuths, k * azimuths, a * azimuths, b * azimuths, share); });
}

//------------------------------------------------------------------------------
// The readings at their nodes, the rest filled; notes say how many of each.
void FillGrid(GonioGrid& grid, const Readings& readings, MaterialFile& result)
{
  const float lastLight = grid.Light.Theta.back();
  const float lastView = grid.View.Theta.back();
  AddHorizon(grid.Light);
  AddHorizon(grid.View);
  grid.Resize();
  const Index views = grid.RGB.cols() / 3;
  Eigen::MatrixXi counts = Eigen::MatrixXi::Zero(views, grid.RGB.rows());
  std::int64_t repeated = 0;
  for (const GonioReading& reading : readings)
  {
    const Index light = FindNode(grid.Light, reading.ThetaI, reading.PhiI);
    const Index view = FindNode(grid.View, reading.ThetaO, reading.PhiO);
    int& count = counts(view, light);
    repeated += count > 0;
    ++count;
    auto mean = grid.RGB.block<1, 3>(light, 3 * view); // so far
    mean += (Eigen::Map<const Eigen::RowVector3d>(&reading.Color[0]).cast<float>() - mean) /
            static_cast<float>(count);
  }
  std::vector<char> litLights;
  std::int64_t missing = 0; // but for directions along the normal, which have one value
  for (Index light = 0; light < grid.RGB.rows(); ++light)
  {
    const float thetaI = grid.Light.Theta[std::size_t(light) / grid.Light.Phi.size()];
    std::vector<char> known;
    for (Index view = 0; view < views; ++view)
    {
      const float thetaO = grid.View.Theta[std::size_t(view) / grid.View.Phi.size()];
      known.push_back(counts(view, light) > 0);
      missing += !known.back() && !IsPole(thetaI) && !IsPole(thetaO) && thetaI <= lastLight &&
                 thetaO <= lastView;
    }
    litLights.push_back(std::find(known.begin(), known.end(), 1) != known.end());
    FillHoles(grid.View, grid.GetViews(light), known);
  }
  FillHoles(grid.Light, grid.RGB, litLights);
  NoteCount(
    missing, " values are missing in the grid of angles: filled from their neighbors.", result);
  NoteCount(repeated, " values repeat others' angles: averaged.", result);
}

//------------------------------------------------------------------------------
// The plane through readings around a view, by least squares with weights of the inverse squared
// distance, at the view (moving least squares, Lancaster and Salkauskas 1981). The result stays
// within the range of their values: nothing overshoots. A row of points or colors is a reading.
Eigen::RowVector3d Interpolate(
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
  return planes.row(0).cwiseMax(colors.colwise().minCoeff()).cwiseMin(colors.colwise().maxCoeff());
}

// The views of one light, onto the nodes, one a row.
void Scatter(
  const Nodes& views, const std::vector<const GonioReading*>& readings, Eigen::Map<Items> rgb)
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
  Index node = 0;
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
      rgb.row(node++) = Interpolate(theta, phi, near, colors).cast<float>();
    }
  }
}

// Even views, 2 degrees apart or more; false: there are too few readings for each light.
bool ChooseViews(Nodes& views, double readings, double lights)
{
  double step = FinestStep;
  while (step < CoarsestStep && lights * (90.0 / step + 1.0) * (360.0 / step) > MostNodes)
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
  return readings >= LeastViews * lights && lights * views.GetNumberOfNodes() <= MostNodes;
}

// Gives the grid even views and interpolates the readings of each light onto them.
void ScatterReadings(GonioGrid& grid, const Readings& readings, const std::string& where)
{
  const double lights = CountNodes(grid.Light);
  Require(lights <= vtkAngularTableBRDF::MaximumNodes / 2.0 &&
            ChooseViews(grid.View, double(readings.size()), lights),
    where, ": found ", readings.size(), " readings under ", grid.Light.Theta.size(),
    " polar angles and ", grid.Light.Phi.size(),
    " azimuths of the light, expected a grid, or several views under each");
  AddHorizon(grid.Light);
  grid.Resize();
  std::vector<std::vector<const GonioReading*>> members(std::size_t(grid.RGB.rows()));
  for (const GonioReading& reading : readings)
  {
    members[std::size_t(FindNode(grid.Light, reading.ThetaI, reading.PhiI))].push_back(&reading);
  }
  std::vector<char> known;
  for (const auto& own : members)
  {
    if (!own.empty())
    {
      Scatter(grid.View, own, grid.GetViews(Index(known.size())));
    }
    known.push_back(!own.empty());
  }
  FillHoles(grid.Light, grid.RGB, known);
}

//------------------------------------------------------------------------------
// A direction along the normal has one value: the mean over azimuths.
void AveragePoles(GonioGrid& grid, bool isotropic)
{
  const auto average = [](auto&& items)
  {
    const Eigen::RowVectorXd mean = items.template cast<double>().colwise().mean();
    items.rowwise() = mean.cast<float>().eval();
  };
  const Index azimuths = Index(grid.View.Phi.size());
  for (Index light = 0; light < grid.RGB.rows() && IsPole(grid.View.Theta[0]); ++light)
  {
    average(grid.GetViews(light).topRows(azimuths));
  }
  if (IsPole(grid.Light.Theta[0]))
  {
    average(grid.RGB.topRows(Index(grid.Light.Phi.size())));
    for (Index circle = 0; circle < Index(grid.View.Theta.size()) && isotropic; ++circle)
    {
      average(grid.GetViews(0).middleRows(circle * azimuths, azimuths));
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
void MakeGonioTable(Readings readings, const std::string& where, MaterialFile& result)
{
  Require(!readings.empty(), where, ": found no readings");
  const bool isotropic = TurnAzimuths(readings);
  const bool isMirrored = isotropic && Mirror(readings);
  GonioGrid grid;
  grid.Light = { FindAngles(readings, &GonioReading::ThetaI),
    FindAngles(readings, &GonioReading::PhiI) };
  grid.View = { FindAngles(readings, &GonioReading::ThetaO),
    FindAngles(readings, &GonioReading::PhiO) };
  const auto range = [](const std::vector<float>& angles)
  { return NumberText(angles.front(), 3) + " to " + NumberText(angles.back(), 3); };
  result.AddNote("Measured with light at " + range(grid.Light.Theta) + " and views at " +
                 range(grid.View.Theta) +
                 " degrees from the normal; constant outside these angles.");
  if (isMirrored)
  {
    result.AddNote("Views lie on one side of the plane of incidence: mirrored.");
  }
  const double lights = CountNodes(grid.Light);
  const double views = CountNodes(grid.View);
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
  const std::string problem =
    table->SetValues(grid.Light, grid.View, { grid.RGB.data(), grid.RGB.data() + grid.RGB.size() },
      isotropic ? vtkAngularTableBRDF::LIGHT : vtkAngularTableBRDF::TANGENT);
  Require(problem.empty(), where, ": ", problem);
  if (!isGrid)
  {
    result.AddNote(
      Concat("The views are scattered: interpolated onto ", grid.View.Theta.size(), " x ",
        grid.View.Phi.size(), " even nodes, whose relative RMS difference from the readings is ",
        NumberText(GetError(table, readings), 3), "."));
  }
  constexpr double darkest = 0.005; // soot reflects more
  NoteStrangeAlbedo(table, darkest, "its values may be in another unit than 1/sr.", result);
  result.BRDF = table;
}
} // namespace measuredbrdf
