// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAngleBasisBRDF.h"

#include "HalfVector.h" // for angles
#include "VolumeInterpolation.h"
#include "vtkBRDFExchange.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkAngleBasisBRDF);

namespace
{
constexpr double LastTolerance = 1e-3; // of the last ring's end, degrees

struct Patch
{
  std::size_t Ring;
  int Azimuth;
};

double GetLowerTheta(const vtkAngleBasisBRDF::Basis& basis, std::size_t ring)
{
  return ring > 0 ? basis.UpperTheta[ring - 1] : 0.0;
}

// Patches are about multiples of 360 / n degrees (Klems; Radiance's bsdf_m).
int FindPatch(const vtkAngleBasisBRDF::Basis& basis, double x, double y, double z)
{
  const double theta = ToDegrees(std::atan2(std::hypot(x, y), z));
  int first = 0;
  std::size_t ring = 0;
  while (ring + 1 < basis.UpperTheta.size() && theta >= basis.UpperTheta[ring])
  {
    first += basis.Patches[ring++];
  }
  const int count = basis.Patches[ring];
  const int k = static_cast<int>(std::floor(std::atan2(y, x) / (2.0 * Pi) * count + 0.5));
  return first + (k % count + count) % count;
}

Patch LocatePatch(const vtkAngleBasisBRDF::Basis& basis, int patch)
{
  std::size_t ring = 0;
  while (patch >= basis.Patches[ring])
  {
    patch -= basis.Patches[ring++];
  }
  return { ring, patch };
}

// Solid angle projected on the surface, of a patch of the ring.
double GetProjectedSolidAngle(const vtkAngleBasisBRDF::Basis& basis, std::size_t ring)
{
  const double inner = std::sin(ToRadians(GetLowerTheta(basis, ring)));
  const double outer = std::sin(ToRadians(basis.UpperTheta[ring]));
  return Pi * (outer * outer - inner * inner) / basis.Patches[ring];
}

std::string FindProblem(const char* name, const vtkAngleBasisBRDF::Basis& basis)
{
  const int most = vtkAngleBasisBRDF::MaximumPatches; // not a reference to the constant
  if (basis.UpperTheta.empty() || basis.UpperTheta.size() != basis.Patches.size())
  {
    return std::string(name) + ": expected as many numbers of patches as rings, and at least one";
  }
  double lower = 0.0;
  long long patches = 0;
  for (std::size_t ring = 0; ring < basis.Patches.size(); ++ring)
  {
    const bool last = ring + 1 == basis.Patches.size();
    if (!(basis.UpperTheta[ring] > lower) || basis.Patches[ring] < 1 ||
        (!last && basis.UpperTheta[ring] > 90.0 - LastTolerance))
    {
      return std::string(name) + ": ring " + std::to_string(ring) +
             ": expected ascending angles, and at least one patch";
    }
    lower = basis.UpperTheta[ring];
    patches += basis.Patches[ring];
    if (patches > most)
    {
      return std::string(name) + ": expected at most " + std::to_string(most) + " patches";
    }
  }
  return std::abs(lower - 90.0) > LastTolerance ? std::string(name) + ": the last ring ends at " +
                                                    std::to_string(lower) + " degrees, expected 90"
                                                : "";
}
}

// For each patch of the view, the light's patches in proportion to what they reflect, cumulated; a
// view that reflects nothing draws by the cosine.
struct vtkAngleBasisBRDF::Sampler
{
  explicit Sampler(const vtkAngleBasisBRDF& brdf)
    : Rows(static_cast<std::size_t>(brdf.Light.GetNumberOfPatches()))
    , Columns(static_cast<std::size_t>(brdf.View.GetNumberOfPatches()))
    , Cumulated(this->Rows * this->Columns)
  {
    for (std::size_t row = 0; row < this->Rows; ++row)
    {
      const std::size_t ring = LocatePatch(brdf.Light, static_cast<int>(row)).Ring;
      this->SolidAngles.push_back(GetProjectedSolidAngle(brdf.Light, ring));
    }
    std::vector<double> byCosine(this->Rows);
    std::partial_sum(this->SolidAngles.begin(), this->SolidAngles.end(), byCosine.begin());
    for (std::size_t column = 0; column < this->Columns; ++column)
    {
      double* shares = &this->Cumulated[column * this->Rows];
      double sum = 0.0;
      for (std::size_t row = 0; row < this->Rows; ++row)
      {
        const float* f = &brdf.Matrix[3 * (row * this->Columns + column)];
        for (int c = 0; c < 3; ++c)
        {
          sum += this->SolidAngles[row] * std::max(static_cast<double>(f[c]), 0.0);
        }
        shares[row] = sum;
      }
      for (std::size_t row = 0; row < this->Rows; ++row)
      {
        shares[row] = sum > 0.0 ? shares[row] / sum : byCosine[row] / byCosine.back();
      }
      shares[this->Rows - 1] = 1.0;
    }
  }

  // The patch, and where in its share u lies, in [0, 1].
  std::size_t Find(std::size_t column, double u, double& rest) const
  {
    const auto first = this->Cumulated.begin() + static_cast<std::ptrdiff_t>(column * this->Rows);
    const auto last = first + static_cast<std::ptrdiff_t>(this->Rows) - 1;
    const auto found = std::upper_bound(first, last, u);
    const double below = found == first ? 0.0 : *(found - 1);
    rest = *found > below ? std::clamp((u - below) / (*found - below), 0.0, 1.0) : 0.5;
    return static_cast<std::size_t>(found - first);
  }

  // Of a patch, over its projected solid angle.
  double GetDensity(std::size_t column, std::size_t row) const
  {
    const double* shares = &this->Cumulated[column * this->Rows];
    return (shares[row] - (row > 0 ? shares[row - 1] : 0.0)) / this->SolidAngles[row];
  }

  std::size_t Rows;
  std::size_t Columns;
  std::vector<double> Cumulated;
  std::vector<double> SolidAngles;
};

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Patches: " << this->Light.GetNumberOfPatches() << " of the light, "
     << this->View.GetNumberOfPatches() << " of the view\n";
}

//------------------------------------------------------------------------------
std::string vtkAngleBasisBRDF::SetMatrix(Basis light, Basis view, std::vector<float> rgb)
{
  for (const std::string& problem : { FindProblem("light", light), FindProblem("view", view) })
  {
    if (!problem.empty())
    {
      return problem;
    }
  }
  const std::size_t count = 3u * static_cast<std::size_t>(light.GetNumberOfPatches()) *
                            static_cast<std::size_t>(view.GetNumberOfPatches());
  if (rgb.size() != count)
  {
    return "matrix: found " + std::to_string(rgb.size()) + " values, expected " +
           std::to_string(count);
  }
  const auto bad =
    std::find_if(rgb.begin(), rgb.end(), [](float value) { return !std::isfinite(value); });
  if (bad != rgb.end())
  {
    return "matrix: value " + std::to_string(bad - rgb.begin()) + " is not finite";
  }
  light.UpperTheta.back() = view.UpperTheta.back() = 90.0f;
  this->Light = std::move(light);
  this->View = std::move(view);
  this->Matrix = std::move(rgb);
  this->Draws.reset();
  this->ResetRenderable();
  this->Modified();
  return "";
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::GetDirectionalAlbedo(const double o[3], double albedo[3])
{
  this->SumPatches(o, false, albedo);
}

//------------------------------------------------------------------------------
// By the middles of patches. Those of the view are where it is continued through the surface.
void vtkAngleBasisBRDF::SumPatches(const double given[3], bool views, double rgb[3])
{
  std::fill_n(rgb, 3, 0.0);
  const Basis& basis = views ? this->View : this->Light;
  for (std::size_t ring = 0; ring < basis.Patches.size(); ++ring)
  {
    const double theta = ToRadians(0.5 * (GetLowerTheta(basis, ring) + basis.UpperTheta[ring]));
    const double weight = GetProjectedSolidAngle(basis, ring);
    for (int k = 0; k < basis.Patches[ring]; ++k)
    {
      const double phi = 2.0 * Pi * k / basis.Patches[ring] + (views ? Pi : 0.0);
      const double d[3] = { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
        std::cos(theta) };
      double f[3];
      this->Evaluate(views ? given : d, views ? d : given, f);
      for (int c = 0; c < 3; ++c)
      {
        rgb[c] += f[c] * weight;
      }
    }
  }
}

//------------------------------------------------------------------------------
const float* vtkAngleBasisBRDF::FindValue(const double i[3], const double o[3]) const
{
  const int row = FindPatch(this->Light, i[0], i[1], i[2]);
  const int column = FindPatch(this->View, -o[0], -o[1], o[2]);
  return &this->Matrix[3 * (static_cast<std::size_t>(row) *
                               static_cast<std::size_t>(this->View.GetNumberOfPatches()) +
                             static_cast<std::size_t>(column))];
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  if (!this->Matrix.empty())
  {
    const float* value = this->FindValue(i, o);
    std::transform(value, value + 3, f, [](float v) { return std::max(v, 0.0f); });
  }
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::Prepare()
{
  if (!this->Draws && !this->Matrix.empty())
  {
    this->Draws = std::make_shared<Sampler>(*this);
  }
}

//------------------------------------------------------------------------------
bool vtkAngleBasisBRDF::SampleAbove(const double o[3], double u1, double u2, double i[3])
{
  this->Prepare();
  if (!this->Draws)
  {
    return this->Superclass::SampleAbove(o, u1, u2, i);
  }
  const int column = FindPatch(this->View, -o[0], -o[1], o[2]);
  double rest = 0.0;
  const std::size_t row = this->Draws->Find(static_cast<std::size_t>(column), u1, rest);
  const Patch patch = LocatePatch(this->Light, static_cast<int>(row));
  const double inner = std::sin(ToRadians(GetLowerTheta(this->Light, patch.Ring)));
  const double outer = std::sin(ToRadians(this->Light.UpperTheta[patch.Ring]));
  const double square = inner * inner + rest * (outer * outer - inner * inner);
  const double phi = 2.0 * Pi * (patch.Azimuth + u2 - 0.5) / this->Light.Patches[patch.Ring];
  const double s = std::sqrt(square);
  i[0] = s * std::cos(phi);
  i[1] = s * std::sin(phi);
  i[2] = std::sqrt(std::max(1.0 - square, 0.0));
  return i[2] > 0.0;
}

//------------------------------------------------------------------------------
double vtkAngleBasisBRDF::PdfAbove(const double i[3], const double o[3])
{
  this->Prepare();
  if (!this->Draws)
  {
    return this->Superclass::PdfAbove(i, o);
  }
  const int row = FindPatch(this->Light, i[0], i[1], i[2]);
  const int column = FindPatch(this->View, -o[0], -o[1], o[2]);
  return i[2] *
         this->Draws->GetDensity(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
}

//------------------------------------------------------------------------------
void vtkAngleBasisBRDF::GetBounds(
  double vtkNotUsed(minimumCosine), double lower[3], double upper[3])
{
  FindBounds(this->Matrix, lower, upper);
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
  copy->Draws = this->Draws;
  copy->ShareRenderable(this);
  return copy;
}
