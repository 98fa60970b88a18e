// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the tests of the basis representation share: materials in and out of a basis's span, and a
 * quadrature that is not the module's.
 */

#ifndef TestBasisHelpers_h
#define TestBasisHelpers_h

#include "HalfVector.h"

#include "TestDirections.h"
#include "vtkBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace testbasis
{
using measuredbrdf::Pi;
using measuredbrdf::ToRadians;
constexpr double Zone[2] = { 9.0, 57.0 }; // degrees, of the thesis

inline glm::dvec3 FromCosine(double cosine, double phi)
{
  return FromAngles(std::acos(cosine), phi);
}

inline glm::dvec3 EvaluateSigned(vtkBasisBRDF* brdf, const glm::dvec3& i, const glm::dvec3& o)
{
  glm::dvec3 f;
  brdf->EvaluateSigned(&i.x, &o.x, &f.x);
  return f;
}

struct Node
{
  double X;
  double Weight;
};

/// Fejer's first rule on [-1, 1]: exact to degree n - 1.
inline std::vector<Node> MakeFejer(int n)
{
  std::vector<Node> rule;
  for (int k = 0; k < n; ++k)
  {
    const double theta = Pi * (k + 0.5) / n;
    double sum = 1.0;
    for (int j = 1; j <= n / 2; ++j)
    {
      sum -= 2.0 * std::cos(2.0 * j * theta) / (4.0 * j * j - 1.0);
    }
    rule.push_back({ std::cos(theta), 2.0 / n * sum });
  }
  return rule;
}

/// Sum over a zone of directions, solid angle as weight; zone in degrees, 180 for the sphere.
inline void ForZone(const double zone[2], int nCosine, int nPhi,
  const std::function<void(const glm::dvec3&, double)>& use)
{
  const double near = std::cos(ToRadians(zone[0]));
  const double far = std::cos(ToRadians(zone[1]));
  for (const Node& node : MakeFejer(nCosine))
  {
    const double cosine = far + 0.5 * (node.X + 1.0) * (near - far);
    for (int p = 0; p < nPhi; ++p)
    {
      use(FromCosine(cosine, 2.0 * Pi * (p + 0.25) / nPhi),
        node.Weight * 0.5 * (near - far) * 2.0 * Pi / nPhi);
    }
  }
}

/// Coefficients of a random material: the constant function dominates, the rest falls with degree.
inline std::vector<float> MakeCoefficients(
  int order, int nTheta, int nPhi, unsigned int seed = 3, double ripple = 0.3)
{
  std::mt19937 random(seed);
  const auto draw = [&random]() { return static_cast<double>(random()) * 0x1p-31 - 1.0; };
  std::vector<float> rgb;
  for (int l = 0; l <= order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      glm::dvec3 slope, phase, base;
      for (int c = 0; c < 3; ++c)
      {
        base[c] = l == 0 ? 2.0 : ripple * draw() / (1.0 + l * l);
        slope[c] = 0.3 * draw();
        phase[c] = Pi * draw();
      }
      for (int k = 0; k < nTheta * nPhi; ++k)
      {
        const double along = k / nPhi / (nTheta - 1.0);
        const glm::dvec3 turn =
          nPhi > 1 ? 0.2 * glm::cos(2.0 * Pi * (k % nPhi) / nPhi + phase) : glm::dvec3(0.0);
        const glm::vec3 value(base * (1.0 + slope * along + turn));
        rgb.insert(rgb.end(), &value.x, &value.x + 3);
      }
    }
  }
  return rgb;
}

inline vtkSmartPointer<vtkBasisBRDF> MakeBasis(int basis, int order, const double incident[2],
  const double outgoing[2], int nTheta, int nPhi, const std::vector<float>& rgb)
{
  auto brdf = vtkSmartPointer<vtkBasisBRDF>::New();
  const std::string problem =
    brdf->SetCoefficients(basis, order, incident, outgoing, nTheta, nPhi, rgb);
  return problem.empty() ? brdf : nullptr;
}

/// What a material would be without any table of basis values; o on a sample of theta_o, phi_o.
inline glm::dvec3 SumExactly(
  vtkBasisBRDF* brdf, const glm::dvec3& i, int t, int p, double turnBack = 0.0)
{
  const double phi = std::atan2(i.y, i.x) - turnBack;
  const double theta = std::acos(std::min(i.z, 1.0));
  const double* zone = brdf->GetIncidentZone();
  const bool own = brdf->GetBasis() >= vtkBasisBRDF::ZONAL;
  const glm::dvec3 inside =
    FromAngles(own ? std::clamp(theta, ToRadians(zone[0]), ToRadians(zone[1])) : theta, phi);
  const std::vector<double> values =
    vtkBasisBRDF::EvaluateBasis(brdf->GetBasis(), brdf->GetOrder(), zone, &inside.x);
  glm::dvec3 sum(0.0);
  for (int k = 0; k < brdf->GetNumberOfFunctions(); ++k)
  {
    const int sample = (k * brdf->GetNumberOfTheta() + t) * brdf->GetNumberOfPhi() + p;
    sum += values[k] * glm::dvec3(glm::make_vec3(&brdf->GetCoefficients()[3 * sample]));
  }
  return sum;
}

/// A material given by a function of i and o, gray.
class FunctionBRDF : public vtkBRDF
{
public:
  static FunctionBRDF* New();
  vtkTypeMacro(FunctionBRDF, vtkBRDF);
  bool IsIsotropic() override { return this->Isotropic; }
  bool IsReciprocal() override { return false; }
  void GetShaderInputs(vtkBRDFShaderInputs&) override {}

  std::function<glm::dvec3(const glm::dvec3& i, const glm::dvec3& o)> Function;
  bool Isotropic = true;

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    const glm::dvec3 value = this->Function(glm::make_vec3(i), glm::make_vec3(o));
    std::copy_n(&value.x, 3, f);
  }
};
inline vtkStandardNewMacro(FunctionBRDF);

/// The half-vector lobe that theory.md's figures were made with: a Blinn distribution of exponent n
/// over 4 (c_i + c_o - c_i c_o), and a Lambert term of albedo 0.1.
inline double HalfVectorLobe(double n, const glm::dvec3& i, const glm::dvec3& o)
{
  const double cosine = std::max(glm::normalize(i + o).z, 0.0);
  return (n + 2.0) / (2.0 * Pi) * std::pow(cosine, n) /
           (4.0 * std::max(i.z + o.z - i.z * o.z, 1e-6)) +
         0.1 / Pi;
}

inline vtkSmartPointer<FunctionBRDF> MakeLobe(double n)
{
  auto brdf = vtkSmartPointer<FunctionBRDF>::New();
  brdf->Function = [n](const glm::dvec3& i, const glm::dvec3& o)
  { return glm::dvec3(HalfVectorLobe(n, i, o)); };
  return brdf;
}
} // namespace testbasis

#endif
