// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAngularTableBRDF.h"

#include "ContentHash.h"
#include "HalfVector.h" // for Pi
#include "RenderableTable.h"
#include "vtkBRDFExchange.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAngularTableBRDF);

struct vtkAngularTableBRDF::Renderable : public RenderableTable
{
};

namespace
{
constexpr double Degree = Pi / 180.0;
constexpr double Horizon = 90.0; // degrees

// The four nodes about a direction, and their weights; the sum of these is 1, those of an
// extrapolation may be negative.
struct Around
{
  std::array<std::size_t, 4> Nodes;
  std::array<double, 4> Weights;
};

Around Find(const vtkAngularTableBRDF::Nodes& nodes, const double d[3])
{
  const double theta = std::atan2(std::hypot(d[0], d[1]), d[2]) / Degree;
  const std::size_t last = nodes.Theta.size() - 1;
  std::size_t low = 0;
  while (low + 2 < nodes.Theta.size() && theta >= nodes.Theta[low + 1])
  {
    ++low;
  }
  const std::size_t high = std::min(low + 1, last);
  const double t =
    high > low ? (theta - nodes.Theta[low]) / (nodes.Theta[high] - nodes.Theta[low]) : 0.0;
  const auto azimuths = static_cast<std::size_t>(nodes.Azimuths);
  double turn = std::atan2(d[1], d[0]) / (2.0 * Pi);
  turn = (turn < 0.0 ? turn + 1.0 : turn) * nodes.Azimuths;
  const double first = std::floor(turn);
  const double u = turn - first;
  const std::size_t left = static_cast<std::size_t>(first) % azimuths;
  const std::size_t right = (left + 1) % azimuths;
  return { { low * azimuths + left, low * azimuths + right, high * azimuths + left,
             high * azimuths + right },
    { (1.0 - t) * (1.0 - u), (1.0 - t) * u, t * (1.0 - u), t * u } };
}

std::string FindProblem(const char* name, const vtkAngularTableBRDF::Nodes& nodes)
{
  const std::string of = std::string(name) + ": ";
  const int most = vtkAngularTableBRDF::MaximumNodes; // not a reference to the constant
  if (nodes.Theta.empty() || nodes.Azimuths < 1)
  {
    return of + "expected at least one polar angle and one azimuth";
  }
  if (nodes.Theta.size() > static_cast<std::size_t>(most) ||
      nodes.Azimuths > most / static_cast<int>(nodes.Theta.size()))
  {
    return of + "expected at most " + std::to_string(most) + " nodes";
  }
  for (std::size_t k = 0; k < nodes.Theta.size(); ++k)
  {
    const bool ascends = k == 0 ? nodes.Theta[0] >= 0.0f : nodes.Theta[k] > nodes.Theta[k - 1];
    if (!ascends || !(nodes.Theta[k] < Horizon))
    {
      return of + "polar angle " + std::to_string(k) +
             ": expected ascending ones from 0 to less than 90 degrees";
    }
  }
  return "";
}
}

//------------------------------------------------------------------------------
vtkAngularTableBRDF::vtkAngularTableBRDF()
  : Resampled(std::make_shared<Renderable>())
{
}

//------------------------------------------------------------------------------
vtkAngularTableBRDF::~vtkAngularTableBRDF() = default;

//------------------------------------------------------------------------------
void vtkAngularTableBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const Nodes& nodes)
  {
    os << indent << name << ": " << nodes.Theta.size() << " polar angles x " << nodes.Azimuths
       << " azimuths\n";
  };
  print("LightNodes", this->Light);
  print("ViewNodes", this->View);
}

//------------------------------------------------------------------------------
std::string vtkAngularTableBRDF::SetValues(Nodes light, Nodes view, std::vector<float> rgb)
{
  for (const std::string& problem : { FindProblem("light", light), FindProblem("view", view) })
  {
    if (!problem.empty())
    {
      return problem;
    }
  }
  const std::size_t count = 3u * static_cast<std::size_t>(light.GetNumberOfNodes()) *
                            static_cast<std::size_t>(view.GetNumberOfNodes());
  if (count > 1000000u * static_cast<std::size_t>(int(MaximumMegavalues)))
  {
    return "values: expected at most " + std::to_string(int(MaximumMegavalues)) + " million";
  }
  if (rgb.size() != count)
  {
    return "values: found " + std::to_string(rgb.size()) + ", expected " + std::to_string(count);
  }
  const auto bad =
    std::find_if(rgb.begin(), rgb.end(), [](float value) { return !std::isfinite(value); });
  if (bad != rgb.end())
  {
    return "values: number " + std::to_string(bad - rgb.begin()) + " is not finite";
  }
  this->Light = std::move(light);
  this->View = std::move(view);
  this->Values = std::move(rgb);
  this->Resampled = std::make_shared<Renderable>();
  this->Modified();
  return "";
}

//------------------------------------------------------------------------------
void vtkAngularTableBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (this->Values.empty())
  {
    return;
  }
  const Around light = Find(this->Light, i);
  const Around view = Find(this->View, o);
  const auto columns = static_cast<std::size_t>(this->View.GetNumberOfNodes());
  double sum[3] = { 0.0, 0.0, 0.0 };
  for (std::size_t a = 0; a < 4; ++a)
  {
    for (std::size_t b = 0; b < 4; ++b)
    {
      const double weight = light.Weights[a] * view.Weights[b];
      const float* value = &this->Values[3 * (light.Nodes[a] * columns + view.Nodes[b])];
      for (std::size_t c = 0; c < 3; ++c)
      {
        sum[c] += weight * value[c];
      }
    }
  }
  std::transform(sum, sum + 3, f, [](double value) { return std::max(value, 0.0); });
}

//------------------------------------------------------------------------------
// Extrapolation to the horizon goes as far beyond the last nodes as their steps and what remains to
// 90 degrees allow, along each direction.
void vtkAngularTableBRDF::GetBounds(
  double vtkNotUsed(minimumCosine), double lower[3], double upper[3])
{
  const auto getReach = [](const Nodes& nodes)
  {
    const std::size_t count = nodes.Theta.size();
    return count < 2 ? 0.0
                     : (Horizon - nodes.Theta[count - 1]) /
                         (nodes.Theta[count - 1] - nodes.Theta[count - 2]);
  };
  // Weights of an extrapolation: 1 + t and -t along each axis.
  const double light = this->Values.empty() ? 0.0 : getReach(this->Light);
  const double view = this->Values.empty() ? 0.0 : getReach(this->View);
  const double negative = light * (1.0 + view) + view * (1.0 + light);
  const double positive = (1.0 + light) * (1.0 + view) + light * view;
  for (std::size_t c = 0; c < 3; ++c)
  {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (std::size_t k = c; k < this->Values.size(); k += 3)
    {
      low = std::min<double>(low, this->Values[k]);
      high = std::max<double>(high, this->Values[k]);
    }
    const bool empty = this->Values.empty();
    lower[c] = empty ? 0.0 : std::max(positive * low - negative * high, 0.0);
    upper[c] = empty ? 0.0 : std::max(positive * high - negative * low, 0.0);
  }
}

//------------------------------------------------------------------------------
vtkBRDF* vtkAngularTableBRDF::GetRenderable()
{
  std::string problem;
  vtkBRDF* table = this->Resampled->Get(this, problem);
  if (!problem.empty())
  {
    vtkWarningMacro(<< problem);
  }
  return table;
}

//------------------------------------------------------------------------------
void vtkAngularTableBRDF::GetShaderInputs(vtkBRDFShaderInputs& form)
{
  this->GetRenderable()->GetShaderInputs(form);
}

//------------------------------------------------------------------------------
void vtkAngularTableBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  const auto save = [&exchange](const std::string& name, const Nodes& nodes)
  {
    exchange.SaveArray(name + "Theta", { static_cast<int>(nodes.Theta.size()) }, 1, nodes.Theta);
    exchange.SaveArray(name + "Azimuths", { 1 }, 1, { static_cast<float>(nodes.Azimuths) });
  };
  const auto load = [&exchange](const std::string& name)
  {
    Nodes nodes;
    nodes.Theta = exchange.LoadArray(name + "Theta", 1, 1).Values;
    const std::vector<float> azimuths = exchange.LoadArray(name + "Azimuths", 1, 1).Values;
    // What is no such number becomes 0, which SetValues refuses.
    const bool good = azimuths.size() == 1 && azimuths[0] >= 1.0f &&
                      azimuths[0] <= static_cast<float>(int(MaximumNodes));
    nodes.Azimuths = good ? static_cast<int>(azimuths[0]) : 0;
    return nodes;
  };
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
  if (!exchange.HasFailed())
  {
    exchange.Check(this->SetValues(std::move(light), std::move(view), std::move(values.Values)));
  }
}

//------------------------------------------------------------------------------
vtkBRDF* vtkAngularTableBRDF::NewCopy()
{
  vtkAngularTableBRDF* copy = vtkAngularTableBRDF::New();
  copy->Light = this->Light;
  copy->View = this->View;
  copy->Values = this->Values;
  copy->Resampled = this->Resampled;
  return copy;
}

//------------------------------------------------------------------------------
std::pair<std::type_index, std::string> vtkAngularTableBRDF::GetContent()
{
  ContentHash hash;
  for (const Nodes* nodes : { &this->Light, &this->View })
  {
    hash.AddValues(nodes->Theta);
    hash.AddValues(std::vector<int>{ nodes->Azimuths });
  }
  hash.AddValues(this->Values);
  return { typeid(vtkAngularTableBRDF), hash.GetText() };
}
