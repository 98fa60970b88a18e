// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GonioGrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace measuredbrdf
{
namespace
{
using Nodes = GonioGrid::Nodes;

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

}

//------------------------------------------------------------------------------
GonioGrid FindGonioGrid(const std::vector<GonioAngles>& readings)
{
  GonioGrid grid;
  grid.Light.Theta = FindNodes(readings, &GonioAngles::ThetaI);
  grid.Light.Phi = FindNodes(readings, &GonioAngles::PhiI);
  grid.View.Theta = FindNodes(readings, &GonioAngles::ThetaO);
  grid.View.Phi = FindNodes(readings, &GonioAngles::PhiO);
  return grid;
}

//------------------------------------------------------------------------------
std::size_t FindGonioLight(const GonioGrid& grid, const GonioAngles& reading)
{
  return FindNode(grid.Light.Theta, reading.ThetaI) * grid.Light.Phi.size() +
         FindNode(grid.Light.Phi, reading.PhiI);
}

//------------------------------------------------------------------------------
std::size_t FillGonioLights(
  const GonioGrid& grid, std::size_t size, float* values, std::vector<char> known)
{
  return HoleFiller(grid.Light, size, values, std::move(known)).Fill();
}

namespace
{
// Values where the readings are, and between them.
class GridFiller
{
public:
  GridFiller(const GonioGrid& grid, const GonioReadings& readings)
    : At(grid)
    , Readings(readings)
  {
    const std::size_t azimuths = grid.View.Phi.size();
    for (const GonioAngles& reading : readings.Angles)
    {
      this->Places.push_back(FindGonioLight(grid, reading) * grid.GetViews() +
                             FindNode(grid.View.Theta, reading.ThetaO) * azimuths +
                             FindNode(grid.View.Phi, reading.PhiO));
    }
  }

  GonioValues Fill()
  {
    std::vector<float>& rgb = this->Result.RGB;
    rgb.assign(3 * this->At.GetSize(), 0.0f);
    for (std::size_t channel = 0; channel < this->Readings.Channels; ++channel)
    {
      const std::vector<float> values = this->FillChannel(channel);
      for (std::size_t k = 0; k < rgb.size(); ++k)
      {
        rgb[k] += static_cast<float>(this->Readings.Weights[channel][k % 3] * values[k / 3]);
      }
    }
    return std::move(this->Result);
  }

private:
  std::vector<float> FillChannel(std::size_t channel)
  {
    const std::size_t size = this->At.GetSize();
    std::vector<float> values(size, 0.0f);
    std::vector<char> known(size, 0);
    std::vector<unsigned int> counts(size, 0);
    for (std::size_t k = 0; k < this->Places.size(); ++k)
    {
      const float value = this->Readings.Values[k * this->Readings.Channels + channel];
      if (!std::isnan(value))
      {
        const std::size_t at = this->Places[k];
        ++counts[at];
        values[at] += (value - values[at]) / static_cast<float>(counts[at]); // the mean so far
        this->Result.Repeated += known[at];
        known[at] = 1;
      }
    }
    const std::size_t views = this->At.GetViews();
    std::vector<char> lights(size / views, 0);
    for (std::size_t light = 0; light < lights.size(); ++light)
    {
      const auto first = known.begin() + static_cast<std::ptrdiff_t>(light * views);
      const auto last = first + static_cast<std::ptrdiff_t>(views);
      lights[light] = std::any_of(first, last, [](char is) { return is != 0; });
      this->Result.Filled +=
        HoleFiller(this->At.View, 1, &values[light * views], std::vector<char>(first, last)).Fill();
    }
    this->Result.Filled += views * FillGonioLights(this->At, views, values.data(), lights);
    return values;
  }

  const GonioGrid& At;
  const GonioReadings& Readings;
  std::vector<std::size_t> Places;
  GonioValues Result;
};
}

//------------------------------------------------------------------------------
GonioValues FillGonioGrid(const GonioGrid& grid, const GonioReadings& readings)
{
  return GridFiller(grid, readings).Fill();
}

//------------------------------------------------------------------------------
void CloseGonioGrid(GonioGrid& grid, bool isotropic, std::vector<float>& rgb)
{
  AveragePoles(grid, isotropic, rgb);
  AddHorizon(grid, rgb);
}
} // namespace measuredbrdf
