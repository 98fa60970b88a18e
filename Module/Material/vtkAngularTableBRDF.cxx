// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAngularTableBRDF.h"

#include "HalfVector.h" // for angles
#include "Refusal.h"
#include "vtkBRDFExchange.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAngularTableBRDF);

namespace
{
constexpr double Horizon = 90.0; // degrees
constexpr double FullTurn = 360.0;

// The four nodes about a direction, and their weights; the sum of these is 1, those of an
// extrapolation may be negative.
struct Around
{
  std::array<std::size_t, 4> Nodes;
  std::array<double, 4> Weights;
};

// phi: degrees.
Around Find(const vtkAngularTableBRDF::Nodes& nodes, double theta, double phi)
{
  const std::vector<float>& thetas = nodes.Theta;
  std::size_t low = 0;
  while (low + 2 < thetas.size() && theta >= thetas[low + 1])
  {
    ++low;
  }
  const std::size_t high = std::min(low + 1, thetas.size() - 1);
  const double step = double(thetas[high]) - thetas[low];
  const double t = high > low ? std::max((theta - thetas[low]) / step, 0.0) : 0.0;

  const std::vector<float>& azimuths = nodes.Phi;
  const std::size_t count = azimuths.size();
  const auto next = static_cast<std::size_t>(
    std::upper_bound(azimuths.begin(), azimuths.end(), phi) - azimuths.begin());
  const std::size_t left = (next + count - 1) % count; // before the first one: the last
  const std::size_t right = next % count;
  const auto turn = [](double angle) { return angle < 0.0 ? angle + FullTurn : angle; };
  const double gap = turn(double(azimuths[right]) - azimuths[left]);
  const double u = gap > 0.0 ? turn(phi - azimuths[left]) / gap : 0.0;
  return { { low * count + left, low * count + right, high * count + left, high * count + right },
    { (1.0 - t) * (1.0 - u), (1.0 - t) * u, t * (1.0 - u), t * u } };
}

double GetTheta(const double d[3]) { return ToDegrees(std::atan2(std::hypot(d[0], d[1]), d[2])); }

// In [0, 360).
double GetPhi(double x, double y)
{
  const double phi = ToDegrees(std::atan2(y, x));
  const double positive = phi < 0.0 ? phi + FullTurn : phi;
  return positive < FullTurn ? positive : 0.0;
}

// Angles ascend from 0 to less than the limit, or (closed) to the limit.
void CheckAngles(
  const std::string& name, const std::vector<float>& angles, double limit, const char* expected)
{
  for (std::size_t k = 0; k < angles.size(); ++k)
  {
    Require((k == 0 ? angles[0] >= 0.0f : angles[k] > angles[k - 1]) && angles[k] <= limit,
      name + " " + std::to_string(k) + ": expected ascending ones from 0 to " + expected +
        " degrees");
  }
}

void CheckNodes(const std::string& name, const vtkAngularTableBRDF::Nodes& nodes)
{
  const int most = vtkAngularTableBRDF::MaximumNodes; // not a reference to the constant
  Require(!nodes.Theta.empty() && !nodes.Phi.empty(),
    name + ": expected at least one polar angle and one azimuth");
  Require(nodes.Phi.size() <= static_cast<std::size_t>(most) / nodes.Theta.size(),
    name + ": expected at most " + std::to_string(most) + " nodes");
  CheckAngles(name + ": polar angle", nodes.Theta, Horizon, "90");
  CheckAngles(
    name + ": azimuth", nodes.Phi, std::nextafter(float(FullTurn), 0.0f), "less than 360");
}
}

//------------------------------------------------------------------------------
std::vector<float> vtkAngularTableBRDF::GetEvenAzimuths(int count)
{
  std::vector<float> azimuths;
  const int most = MaximumNodes;
  for (int k = 0; k < count && count <= most; ++k)
  {
    azimuths.push_back(static_cast<float>(FullTurn * k / count));
  }
  return azimuths;
}

//------------------------------------------------------------------------------
std::string vtkAngularTableBRDF::SetValues(
  Nodes light, Nodes view, std::vector<float> rgb, AzimuthOrigin origin)
{
  return FindProblemOf(
    [&]()
    {
      CheckNodes("light", light);
      CheckNodes("view", view);
      Require(origin != LIGHT || (light.Phi.size() == 1 && light.Phi[0] == 0.0f),
        "light: expected the azimuth 0 only, because the view's are counted from it");
      const std::size_t count = 3u * static_cast<std::size_t>(light.GetNumberOfNodes()) *
                                static_cast<std::size_t>(view.GetNumberOfNodes());
      const int most = MaximumMegavalues;
      Require(count <= 1000000u * static_cast<std::size_t>(most),
        "values: expected at most " + std::to_string(most) + " million");
      Require(rgb.size() == count,
        "values: found " + std::to_string(rgb.size()) + ", expected " + std::to_string(count));
      RequireFinite(rgb, "values");
      this->Light = std::move(light);
      this->View = std::move(view);
      this->Values = std::move(rgb);
      this->Origin = origin;
      this->ResetRenderable();
      this->Modified();
    });
}

//------------------------------------------------------------------------------
void vtkAngularTableBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (this->Values.empty())
  {
    return;
  }
  const bool turned = this->Origin == LIGHT;
  const Around light = Find(this->Light, GetTheta(i), turned ? 0.0 : GetPhi(i[0], i[1]));
  // The view's azimuth from the light's: of o's projection times the conjugate of i's. A light on
  // the normal has none, as every azimuth of the view.
  const bool hasAzimuth = turned && (i[0] != 0.0 || i[1] != 0.0);
  const double phi = hasAzimuth ? GetPhi(i[0] * o[0] + i[1] * o[1], i[0] * o[1] - i[1] * o[0])
                                : (turned ? 0.0 : GetPhi(o[0], o[1]));
  const Around view = Find(this->View, GetTheta(o), phi);
  const auto columns = static_cast<std::size_t>(this->View.GetNumberOfNodes());
  glm::dvec3 sum(0.0);
  for (std::size_t a = 0; a < 4; ++a)
  {
    for (std::size_t b = 0; b < 4; ++b)
    {
      const float* value = &this->Values[3 * (light.Nodes[a] * columns + view.Nodes[b])];
      sum += light.Weights[a] * view.Weights[b] * glm::dvec3(glm::make_vec3(value));
    }
  }
  std::copy_n(&sum.x, 3, f);
}

//------------------------------------------------------------------------------
void vtkAngularTableBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  const auto save = [&exchange](const std::string& name, const Nodes& nodes)
  {
    exchange.SaveArray(name + "Theta", { static_cast<int>(nodes.Theta.size()) }, 1, nodes.Theta);
    exchange.SaveArray(name + "Phi", { static_cast<int>(nodes.Phi.size()) }, 1, nodes.Phi);
  };
  const auto load = [&exchange](const std::string& name)
  {
    Nodes nodes;
    nodes.Theta = exchange.LoadArray(name + "Theta", 1, 1).Values;
    nodes.Phi = exchange.LoadArray(name + "Phi", 1, 1).Values;
    return nodes;
  };
  AzimuthOrigin origin = this->Origin;
  exchange.Option("azimuthOrigin", { "tangent", "light" }, origin,
    [&origin](int value) { origin = static_cast<AzimuthOrigin>(value); });
  if (!exchange.IsLoading())
  {
    save("light", this->Light);
    save("view", this->View);
    exchange.SaveArray(
      "values", { this->Light.GetNumberOfNodes(), this->View.GetNumberOfNodes() }, 3, this->Values);
    return;
  }
  Nodes light = load("light");
  Nodes view = load("view");
  auto values = exchange.LoadArray("values", 2, 3);
  exchange.Check(
    this->SetValues(std::move(light), std::move(view), std::move(values.Values), origin));
}

//------------------------------------------------------------------------------
vtkBRDF* vtkAngularTableBRDF::NewCopy()
{
  vtkAngularTableBRDF* copy = vtkAngularTableBRDF::New();
  copy->Light = this->Light;
  copy->View = this->View;
  copy->Values = this->Values;
  copy->Origin = this->Origin;
  copy->ShareRenderable(this);
  return copy;
}
