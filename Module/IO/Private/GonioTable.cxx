// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GonioTable.h"

#include "NumberText.h"
#include "vtkAngularTableBRDF.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticPointLocator.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr float Horizon = 90.0f;   // degrees from the normal
constexpr float FullTurn = 360.0f; // degrees

/// Of lights and views together.
constexpr double MaximumGonioNodes = 4e6;

struct GonioGrid
{
  using Nodes = vtkAngularTableBRDF::Nodes;

  Nodes Light;
  Nodes View;

  std::size_t GetLights() const { return this->Light.Theta.size() * this->Light.Phi.size(); }
  std::size_t GetViews() const { return this->View.Theta.size() * this->View.Phi.size(); }
  std::size_t GetSize() const { return this->GetLights() * this->GetViews(); }
};

using Nodes = GonioGrid::Nodes;

/// RGB at the grid's nodes.
struct GonioValues
{
  std::vector<float> RGB;
  std::size_t Filled = 0;   // of values that the readings lack
  std::size_t Repeated = 0; // of readings of the same directions
};

/// A direction's vector; degrees.
inline void PointGonio(float theta, float phi, double d[3])
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  d[0] = std::sin(theta * degree) * std::cos(phi * degree);
  d[1] = std::sin(theta * degree) * std::sin(phi * degree);
  d[2] = std::cos(theta * degree);
}

bool IsPole(float theta) { return theta < GonioAngles::Same; }

// Of angles that count as one, the least.
std::vector<float> FindNodes(
  const std::vector<GonioAngles>& readings, const float GonioAngles::*member)
{
  std::vector<float> angles;
  for (const GonioAngles& reading : readings)
  {
    angles.push_back(reading.*member);
  }
  std::sort(angles.begin(), angles.end());
  std::vector<float> nodes;
  for (const float angle : angles)
  {
    if (nodes.empty() || angle - nodes.back() >= GonioAngles::Same)
    {
      nodes.push_back(angle);
    }
  }
  return nodes;
}

std::size_t FindNode(const std::vector<float>& nodes, float angle)
{
  const auto next = std::upper_bound(nodes.begin(), nodes.end(), angle);
  return static_cast<std::size_t>(next - nodes.begin()) - 1;
}

//------------------------------------------------------------------------------
// Items of `size` values at the nodes: those that are not known get theirs from the known ones.
// Returns how many, those on the pole aside.
class HoleFiller
{
public:
  HoleFiller(const Nodes& nodes, std::size_t size, float* values, std::vector<char> known)
    : At(nodes)
    , Size(size)
    , Values(values)
    , Known(std::move(known))
  {
  }

  std::size_t Fill()
  {
    std::vector<std::size_t> circles; // that have values
    for (std::size_t t = 0; t < this->At.Theta.size(); ++t)
    {
      if (this->FillCircle(t))
      {
        circles.push_back(t);
      }
    }
    const std::size_t azimuths = this->At.Phi.size();
    for (std::size_t t = 0; t < this->At.Theta.size() && !circles.empty(); ++t)
    {
      const auto next = std::lower_bound(circles.begin(), circles.end(), t);
      const std::size_t above = next == circles.end() ? circles.back() : *next;
      const std::size_t below = next == circles.begin() || above == t ? above : *(next - 1);
      if (above != t)
      {
        const double gap = this->At.Theta[above] - this->At.Theta[below];
        const double share = gap > 0.0 ? (this->At.Theta[t] - this->At.Theta[below]) / gap : 0.0;
        for (std::size_t p = 0; p < azimuths; ++p)
        {
          this->Set(t * azimuths + p, below * azimuths + p, above * azimuths + p, share);
        }
        this->Filled += azimuths;
      }
    }
    return this->Filled;
  }

private:
  void Set(std::size_t item, std::size_t a, std::size_t b, double share)
  {
    for (std::size_t k = 0; k < this->Size; ++k)
    {
      this->Values[item * this->Size + k] =
        static_cast<float>((1.0 - share) * this->Values[a * this->Size + k] +
                           share * this->Values[b * this->Size + k]);
    }
  }

  bool FillCircle(std::size_t t)
  {
    const std::size_t count = this->At.Phi.size();
    const std::size_t first = t * count;
    std::vector<std::size_t> known;
    for (std::size_t p = 0; p < count; ++p)
    {
      if (this->Known[first + p])
      {
        known.push_back(p);
      }
    }
    if (known.empty() || known.size() == count)
    {
      return !known.empty();
    }
    const auto turn = [](double angle) { return angle < 0.0 ? angle + FullTurn : angle; };
    std::size_t next = 0; // in known
    for (std::size_t p = 0; p < count; ++p)
    {
      next += next < known.size() && known[next] < p ? 1 : 0;
      if (!this->Known[first + p])
      {
        const std::size_t right = known[next % known.size()];
        const std::size_t left = known[(next + known.size() - 1) % known.size()];
        const double gap = turn(double(this->At.Phi[right]) - this->At.Phi[left]);
        const double share =
          gap > 0.0 ? turn(double(this->At.Phi[p]) - this->At.Phi[left]) / gap : 0.0;
        this->Set(first + p, first + left, first + right, share);
        this->Filled += IsPole(this->At.Theta[t]) ? 0 : 1;
      }
    }
    return true;
  }

  const Nodes& At;
  std::size_t Size;
  float* Values;
  std::vector<char> Known;
  std::size_t Filled = 0;
};

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
void AveragePoles(const GonioGrid& grid, bool isotropic, std::vector<float>& rgb)
{
  const std::size_t views = grid.GetViews();
  const std::size_t azimuths = grid.View.Phi.size();
  const std::size_t lights = grid.Light.Theta.size() * grid.Light.Phi.size();
  for (std::size_t light = 0; light < lights && IsPole(grid.View.Theta[0]); ++light)
  {
    Average(&rgb[3 * light * views], azimuths, 3);
  }
  if (IsPole(grid.Light.Theta[0]))
  {
    Average(rgb.data(), grid.Light.Phi.size(), 3 * views);
    for (std::size_t t = 0; t < grid.View.Theta.size() && isotropic; ++t)
    {
      Average(&rgb[3 * t * azimuths], azimuths, 3);
    }
  }
}

// Nodes on the horizon, with what the last ones have: nothing is extrapolated.
void AddHorizon(GonioGrid& grid, std::vector<float>& rgb)
{
  const auto ends = [](const Nodes& nodes)
  { return nodes.Theta.size() > 1 && nodes.Theta.back() < Horizon; };
  const auto repeat = [](std::vector<float>& values, std::size_t from, std::size_t count)
  {
    const std::size_t last = from + count;
    for (std::size_t k = last - count; k < last; ++k)
    {
      const float value = values[k];
      values.push_back(value);
    }
  };
  if (ends(grid.View))
  {
    const std::size_t views = 3 * grid.GetViews();
    const std::size_t circle = 3 * grid.View.Phi.size();
    std::vector<float> longer;
    for (std::size_t at = 0; at < rgb.size(); at += views)
    {
      longer.insert(longer.end(), &rgb[at], &rgb[at] + views);
      repeat(longer, longer.size() - circle, circle);
    }
    rgb.swap(longer);
    grid.View.Theta.push_back(Horizon);
  }
  if (ends(grid.Light))
  {
    const std::size_t circle = 3 * grid.Light.Phi.size() * grid.GetViews();
    repeat(rgb, rgb.size() - circle, circle);
    grid.Light.Theta.push_back(Horizon);
  }
}

//------------------------------------------------------------------------------
// The readings' directions; angles less than 0.01 degrees apart are one.
GonioGrid FindGonioGrid(const std::vector<GonioAngles>& readings)
{
  GonioGrid grid;
  grid.Light.Theta = FindNodes(readings, &GonioAngles::ThetaI);
  grid.Light.Phi = FindNodes(readings, &GonioAngles::PhiI);
  grid.View.Theta = FindNodes(readings, &GonioAngles::ThetaO);
  grid.View.Phi = FindNodes(readings, &GonioAngles::PhiO);
  return grid;
}

// The node of the light that a reading has.
std::size_t FindGonioLight(const GonioGrid& grid, const GonioAngles& reading)
{
  return FindNode(grid.Light.Theta, reading.ThetaI) * grid.Light.Phi.size() +
         FindNode(grid.Light.Phi, reading.PhiI);
}

// A channel's values at the nodes; counts what it filled and averaged.
std::vector<float> FillChannel(
  const GonioGrid& grid, const GonioReadings& readings, std::size_t channel, GonioValues& result)
{
  const std::size_t size = grid.GetSize();
  const std::size_t views = grid.GetViews();
  std::vector<float> values(size, 0.0f);
  std::vector<char> known(size, 0);
  std::vector<unsigned int> counts(size, 0);
  for (std::size_t k = 0; k < readings.Angles.size(); ++k)
  {
    const GonioAngles& reading = readings.Angles[k];
    const float value = readings.Values[k * readings.Channels + channel];
    if (!std::isnan(value))
    {
      const std::size_t at = FindGonioLight(grid, reading) * views +
                             FindNode(grid.View.Theta, reading.ThetaO) * grid.View.Phi.size() +
                             FindNode(grid.View.Phi, reading.PhiO);
      ++counts[at];
      values[at] += (value - values[at]) / static_cast<float>(counts[at]); // the mean so far
      result.Repeated += known[at];
      known[at] = 1;
    }
  }
  std::vector<char> lights(size / views, 0);
  for (std::size_t light = 0; light < lights.size(); ++light)
  {
    const auto first = known.begin() + static_cast<std::ptrdiff_t>(light * views);
    const auto last = first + static_cast<std::ptrdiff_t>(views);
    lights[light] = std::any_of(first, last, [](char is) { return is != 0; });
    result.Filled +=
      HoleFiller(grid.View, 1, &values[light * views], std::vector<char>(first, last)).Fill();
  }
  result.Filled += views * HoleFiller(grid.Light, views, values.data(), lights).Fill();
  return values;
}

// Holes are filled linearly around the circle of the same polar angle, empty circles from their
// neighbors.
GonioValues FillGonioGrid(const GonioGrid& grid, const GonioReadings& readings)
{
  GonioValues result;
  result.RGB.assign(3 * grid.GetSize(), 0.0f);
  for (std::size_t channel = 0; channel < readings.Channels; ++channel)
  {
    const std::vector<float> values = FillChannel(grid, readings, channel, result);
    for (std::size_t k = 0; k < result.RGB.size(); ++k)
    {
      result.RGB[k] += static_cast<float>(readings.Weights[channel][k % 3] * values[k / 3]);
    }
  }
  return result;
}

constexpr double Radians = 3.14159265358979323846 / 180.0; // of a degree
constexpr std::size_t LeastViews = 4;                      // for each light
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
    : Across{ -std::sin(phi * Radians), std::cos(phi * Radians), 0.0 }
    , Down{ std::cos(theta * Radians) * std::cos(phi * Radians),
      std::cos(theta * Radians) * std::sin(phi * Radians), -std::sin(theta * Radians) }
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

//------------------------------------------------------------------------------
// Give the grid even views, about as dense as the readings, and values there: on the plane through
// each light's eight nearest readings (moving least squares, Lancaster and Salkauskas 1981), within
// the range of these. Readings that lack a channel are left out. Returns an empty string, or what
// is wrong.
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
  HoleFiller(grid.Light, views, rgb.data(), known).Fill(); // from the known lights' views
  return "";
}

constexpr float HalfTurn = 180.0f;

// Nodes of a grid for each reading; small grids may be emptier.
constexpr double GridNodesPerReading = 4.0;
constexpr double SmallGrid = 4096.0;

// In [0, 360).
float Wrap(float phi)
{
  const float turned = phi - FullTurn * std::floor(phi / FullTurn);
  return turned < FullTurn - 0.5f * GonioAngles::Same ? turned : 0.0f;
}

//------------------------------------------------------------------------------
// Azimuths in [0, 360), and from the light's where that is the same in all.
bool TurnAzimuths(std::vector<GonioAngles>& readings)
{
  const GonioAngles* first = nullptr;
  bool isotropic = true;
  for (GonioAngles& reading : readings)
  {
    reading.PhiI = Wrap(reading.PhiI);
    if (!reading.IsLightAlongNormal()) // there it means nothing
    {
      first = first ? first : &reading;
      const float apart = std::abs(reading.PhiI - first->PhiI);
      isotropic = isotropic && std::min(apart, FullTurn - apart) < GonioAngles::Same;
    }
  }
  for (GonioAngles& reading : readings)
  {
    reading.PhiO = Wrap(isotropic ? reading.PhiO - reading.PhiI : reading.PhiO);
    reading.PhiI = isotropic ? 0.0f : reading.PhiI;
  }
  return isotropic;
}

//------------------------------------------------------------------------------
// Whether anything was added.
bool Mirror(GonioReadings& readings)
{
  const std::vector<GonioAngles> angles = readings.Angles;
  if (std::any_of(angles.begin(), angles.end(),
        [](const GonioAngles& reading) { return reading.PhiO > HalfTurn + GonioAngles::Same; }))
  {
    return false;
  }
  for (std::size_t k = 0; k < angles.size(); ++k)
  {
    GonioAngles mirrored = angles[k];
    if (mirrored.PhiO > GonioAngles::Same && mirrored.PhiO < HalfTurn - GonioAngles::Same &&
        !mirrored.IsViewAlongNormal())
    {
      mirrored.PhiO = FullTurn - mirrored.PhiO;
      readings.Angles.push_back(mirrored);
      for (std::size_t c = 0; c < readings.Channels; ++c)
      {
        const float value = readings.Values[k * readings.Channels + c];
        readings.Values.push_back(value);
      }
    }
  }
  return readings.Angles.size() > angles.size();
}

// Where the readings are.
std::string DescribeAngles(const GonioReadings& readings)
{
  const auto range = [&readings](const float GonioAngles::*member)
  {
    const auto [low, high] = std::minmax_element(readings.Angles.begin(), readings.Angles.end(),
      [member](const GonioAngles& a, const GonioAngles& b) { return a.*member < b.*member; });
    return NumberText((*low).*member, 3) + " to " + NumberText((*high).*member, 3);
  };
  return "Measured with light at " + range(&GonioAngles::ThetaI) + " and views at " +
         range(&GonioAngles::ThetaO) + " degrees from the normal; constant outside these angles.";
}

// What the material reflects toward a view at 30 degrees, where that is strange.
std::string DescribeAlbedo(vtkBRDF* brdf)
{
  constexpr double darkest = 0.005; // soot reflects more
  const double o[3] = { 0.5, 0.0, std::sqrt(0.75) };
  double albedo[3];
  brdf->GetDirectionalAlbedo(o, albedo);
  const double largest = *std::max_element(albedo, albedo + 3);
  if (largest <= 1.0 && largest >= darkest)
  {
    return "";
  }
  return "The material reflects " + NumberText(largest, 3) +
         " times the light toward a view at 30 degrees: its values may be in another unit than "
         "1/sr.";
}

// Relative root mean square.
double GetError(vtkBRDF* brdf, const GonioReadings& readings)
{
  double error = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < readings.Angles.size(); ++k)
  {
    const GonioAngles& reading = readings.Angles[k];
    double i[3];
    double o[3];
    double f[3];
    PointGonio(reading.ThetaI, reading.PhiI, i);
    PointGonio(reading.ThetaO, reading.PhiO, o);
    if (i[2] > 0.0 && o[2] > 0.0)
    {
      brdf->Evaluate(i, o, f);
      const std::array<double, 3> color = readings.GetColor(k);
      for (std::size_t c = 0; c < 3; ++c)
      {
        error += (f[c] - std::max(color[c], 0.0)) * (f[c] - std::max(color[c], 0.0));
        sum += color[c] * color[c];
      }
    }
  }
  return sum > 0.0 ? std::sqrt(error / sum) : 0.0;
}
}

//------------------------------------------------------------------------------
std::string MakeGonioTable(GonioReadings readings, MaterialFile& result)
{
  if (readings.Angles.empty())
  {
    return "found no readings";
  }
  result.AddNote(DescribeAngles(readings));
  const bool isotropic = TurnAzimuths(readings.Angles);
  if (isotropic && Mirror(readings))
  {
    result.AddNote("Views lie on one side of the plane of incidence: mirrored.");
  }
  GonioGrid grid = FindGonioGrid(readings.Angles);
  const double lights = double(grid.Light.Theta.size()) * double(grid.Light.Phi.size());
  const double views = double(grid.View.Theta.size()) * double(grid.View.Phi.size());
  const double most = vtkAngularTableBRDF::MaximumNodes / 2.0; // the horizon is added
  const bool isGrid =
    lights <= most && views <= most && lights * views <= MaximumGonioNodes &&
    lights * views <= std::max(GridNodesPerReading * double(readings.Angles.size()), SmallGrid);

  std::vector<float> rgb;
  if (isGrid)
  {
    GonioValues values = FillGonioGrid(grid, readings);
    rgb = std::move(values.RGB);
    if (values.Filled > 0)
    {
      result.AddNote(std::to_string(values.Filled) +
                     " values are missing in the grid of angles: filled from their "
                     "neighbors.");
    }
    if (values.Repeated > 0)
    {
      result.AddNote(std::to_string(values.Repeated) + " values repeat others' angles: averaged.");
    }
  }
  else
  {
    const std::string problem = ScatterGonioReadings(grid, readings, rgb);
    if (!problem.empty())
    {
      return problem;
    }
  }
  AveragePoles(grid, isotropic, rgb);
  AddHorizon(grid, rgb);
  vtkNew<vtkAngularTableBRDF> table;
  const std::string problem = table->SetValues(grid.Light, grid.View, std::move(rgb),
    isotropic ? vtkAngularTableBRDF::LIGHT : vtkAngularTableBRDF::TANGENT);
  if (!problem.empty())
  {
    return problem;
  }
  if (!isGrid)
  {
    result.AddNote("The views are scattered: interpolated onto " +
                   std::to_string(grid.View.Theta.size()) + " x " +
                   std::to_string(grid.View.Phi.size()) +
                   " even nodes, whose relative RMS difference from the readings is " +
                   NumberText(GetError(table, readings), 3) + ".");
  }
  const std::string albedo = DescribeAlbedo(table);
  if (!albedo.empty())
  {
    result.AddNote(albedo);
  }
  result.BRDF = table;
  return "";
}
} // namespace measuredbrdf
