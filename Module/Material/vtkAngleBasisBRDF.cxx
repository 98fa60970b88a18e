// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAngleBasisBRDF.h"

#include "HalfVector.h" // for angles
#include "LocalFrame.h"
#include "Refusal.h"
#include "VolumeInterpolation.h"
#include "vtkBRDFExchange.h"
#include "vtkObjectFactory.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAngleBasisBRDF);

namespace
{
using AngleBasis = vtkAngleBasisBRDF::Basis;

constexpr double LastTolerance = 1e-3; // of the last ring's end, degrees

// Patches are about multiples of 360 / n degrees (Klems; Radiance's bsdf_m).
int FindPatch(const AngleBasis& basis, const glm::dvec3& d)
{
  const double theta = ToDegrees(std::atan2(std::hypot(d.x, d.y), d.z));
  int first = 0;
  std::size_t ring = 0;
  while (ring + 1 < basis.UpperTheta.size() && theta >= basis.UpperTheta[ring])
  {
    first += basis.Patches[ring++];
  }
  const int count = basis.Patches[ring];
  const int k = static_cast<int>(std::floor(std::atan2(d.y, d.x) / (2.0 * Pi) * count + 0.5));
  return first + (k % count + count) % count;
}

void CheckBasis(const std::string& name, const AngleBasis& basis)
{
  const int most = vtkAngleBasisBRDF::MaximumPatches; // not a reference to the constant
  Require(!basis.UpperTheta.empty() && basis.UpperTheta.size() == basis.Patches.size(),
    name + ": expected as many numbers of patches as rings, and at least one");
  double lower = 0.0;
  long long patches = 0;
  for (std::size_t ring = 0; ring < basis.Patches.size(); ++ring)
  {
    const bool last = ring + 1 == basis.Patches.size();
    Require(basis.UpperTheta[ring] > lower && basis.Patches[ring] >= 1 &&
              (last || basis.UpperTheta[ring] <= 90.0 - LastTolerance),
      name + ": ring " + std::to_string(ring) +
        ": expected ascending angles, and at least one patch");
    lower = basis.UpperTheta[ring];
    patches += basis.Patches[ring];
    Require(patches <= most, name + ": expected at most " + std::to_string(most) + " patches");
  }
  Require(std::abs(lower - 90.0) <= LastTolerance,
    name + ": the last ring ends at " + std::to_string(lower) + " degrees, expected 90");
}
}

//------------------------------------------------------------------------------
std::string vtkAngleBasisBRDF::SetMatrix(Basis light, Basis view, std::vector<float> rgb)
{
  return FindProblemOf(
    [&]()
    {
      CheckBasis("light", light);
      CheckBasis("view", view);
      const std::size_t count = 3u * static_cast<std::size_t>(light.GetNumberOfPatches()) *
                                static_cast<std::size_t>(view.GetNumberOfPatches());
      Require(rgb.size() == count, "matrix: found " + std::to_string(rgb.size()) +
                                     " values, expected " + std::to_string(count));
      RequireFinite(rgb, "matrix");
      light.UpperTheta.back() = view.UpperTheta.back() = 90.0f;
      this->Light = std::move(light);
      this->View = std::move(view);
      this->Matrix = std::move(rgb);
      this->ResetRenderable();
      this->Modified();
    });
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  this->SumPatches(this->Light, o, false, albedo);
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::GetDirectionalReflectance(const double i[3], double reflectance[3])
{
  this->SumPatches(this->View, i, true, reflectance);
}

//------------------------------------------------------------------------------
// Over the light's patches or the view's, by f at their middles and by their solid angles projected
// on the surface. The view's patches are where it is continued through the surface.
void vtkAngleBasisBRDF::SumPatches(
  const Basis& basis, const double given[3], bool overView, double rgb[3])
{
  glm::dvec3 sum(0.0);
  double inner = 0.0;
  for (std::size_t ring = 0; ring < basis.Patches.size(); ++ring)
  {
    const double outer = ToRadians(basis.UpperTheta[ring]);
    const int count = basis.Patches[ring];
    const double squares = std::pow(std::sin(outer), 2.0) - std::pow(std::sin(inner), 2.0);
    for (int k = 0; k < count; ++k)
    {
      const glm::dvec3 d =
        ToDirection(std::cos(0.5 * (inner + outer)), 2.0 * Pi * k / count + (overView ? Pi : 0.0));
      glm::dvec3 f;
      this->Evaluate(overView ? given : &d.x, overView ? &d.x : given, &f.x);
      sum += f * (Pi * squares / count);
    }
    inner = outer;
  }
  std::copy_n(&sum.x, 3, rgb);
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (!this->Matrix.empty())
  {
    const int row = FindPatch(this->Light, glm::make_vec3(i));
    const int column = FindPatch(this->View, { -o[0], -o[1], o[2] });
    const auto columns = static_cast<std::size_t>(this->View.GetNumberOfPatches());
    std::copy_n(&this->Matrix[3 * (row * columns + column)], 3, f);
  }
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::ExchangeData(vtkBRDFExchange& exchange)
{
  const auto save = [&exchange](const std::string& name, const Basis& basis)
  {
    const int rings = static_cast<int>(basis.Patches.size());
    exchange.SaveArray(name + "Theta", { rings }, 1, basis.UpperTheta);
    exchange.SaveArray(name + "Patches", { rings }, 1,
      std::vector<float>(basis.Patches.begin(), basis.Patches.end()));
  };
  const auto load = [&exchange](const std::string& name)
  {
    Basis basis;
    basis.UpperTheta = exchange.LoadArray(name + "Theta", 1, 1).Values;
    for (const float patches : exchange.LoadArray(name + "Patches", 1, 1).Values)
    {
      // What is no such number becomes 0, which SetMatrix refuses.
      basis.Patches.push_back(patches >= 1.0f && patches <= static_cast<float>(int(MaximumPatches))
                                ? static_cast<int>(patches)
                                : 0);
    }
    return basis;
  };
  if (!exchange.IsLoading())
  {
    save("light", this->Light);
    save("view", this->View);
    exchange.SaveArray("matrix",
      { this->Light.GetNumberOfPatches(), this->View.GetNumberOfPatches() }, 3, this->Matrix);
    return;
  }
  Basis light = load("light");
  Basis view = load("view");
  auto matrix = exchange.LoadArray("matrix", 2, 3);
  exchange.Check(this->SetMatrix(std::move(light), std::move(view), std::move(matrix.Values)));
}

//------------------------------------------------------------------------------
vtkBRDF* vtkAngleBasisBRDF::NewCopy()
{
  vtkAngleBasisBRDF* copy = vtkAngleBasisBRDF::New();
  copy->Light = this->Light;
  copy->View = this->View;
  copy->Matrix = this->Matrix;
  copy->ShareRenderable(this);
  return copy;
}
