// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AzimuthalBasis.h"
#include "HalfAngle.h"
#include "LocalFrame.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using measuredbrdf::AzimuthalBasis;
using measuredbrdf::Pi;

namespace
{
bool Go(double) { return true; }

// A lobe that grows towards grazing as measured ones do: h.z^n (n+2)/(2 pi) / (4 (i.z + o.z - i.z
// o.z)), Neumann et al. 1999.
class GrazingLobe : public vtkBRDF
{
public:
  static GrazingLobe* New();
  vtkTypeMacro(GrazingLobe, vtkBRDF);
  void GetBounds(double, double[3], double[3]) override {}
  void GetGPUForm(vtkBRDFGPUForm&) override {}
  double Exponent = 5.0;

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    const double h[3] = { i[0] + o[0], i[1] + o[1], i[2] + o[2] };
    const double cosine = h[2] / std::sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    f[0] = f[1] = f[2] = (this->Exponent + 2.0) / (2.0 * Pi) * std::pow(cosine, this->Exponent) /
                         (4.0 * std::max(i[2] + o[2] - i[2] * o[2], 1e-4));
  }
};
vtkStandardNewMacro(GrazingLobe);

vtkNew<vtkBlinnPhongBRDF> NewLobe(double exponent)
{
  vtkNew<vtkBlinnPhongBRDF> brdf;
  brdf->SetSpecular(0.4, 0.3, 0.2);
  brdf->SetExponent(exponent);
  return brdf;
}
} // namespace

//------------------------------------------------------------------------------
TEST(HalfAngle, QuadratureIsExactForPolynomials)
{
  for (const double low : { 0.0, measuredbrdf::MinimumViewCosine })
  {
    const measuredbrdf::Quadrature rule = measuredbrdf::HalfAngleQuadrature(64, low);
    for (const int degree : { 0, 1, 2, 7, 30, 63 })
    {
      double sum = 0.0;
      for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
      {
        EXPECT_GT(rule.Weights[k], 0.0);
        sum += rule.Weights[k] * std::pow(rule.Nodes[k], degree);
      }
      const double exact = (1.0 - std::pow(low, degree + 1)) / (degree + 1);
      EXPECT_NEAR(sum, exact, 1e-14) << degree;
    }
    for (const double cosine : { low, 0.3, 0.9999, 1.0 })
    {
      const double t = measuredbrdf::CosineToHalfAngle(cosine, low);
      EXPECT_NEAR(measuredbrdf::HalfAngleToCosine(t, low), cosine, 1e-14);
    }
  }
}

//------------------------------------------------------------------------------
TEST(AzimuthalBasis, ErrorIsWhatEckartAndYoungSay)
{
  const auto brdf = NewLobe(20.0);
  AzimuthalBasis basis;
  ASSERT_TRUE(basis.Compute(brdf, 0.0, Go));
  const int n = AzimuthalBasis::NumberOfNodes;
  const auto in = measuredbrdf::HalfAngleQuadrature(n, 0.0);
  const auto out = measuredbrdf::HalfAngleQuadrature(n, measuredbrdf::MinimumViewCosine);
  for (const double tolerance : { 0.3, 0.1, 0.02 })
  {
    const int count = basis.FindNumberOfTerms(tolerance, 1000);
    double difference = 0.0;
    double norm = 0.0;
    for (int a = 0; a < n; ++a)
    {
      for (int b = 0; b < n; ++b)
      {
        const std::size_t ka = static_cast<std::size_t>(a);
        const std::size_t kb = static_cast<std::size_t>(b);
        const double weight = in.Weights[ka] * in.Nodes[ka] * out.Weights[kb] * out.Nodes[kb];
        for (int p = 0; p < AzimuthalBasis::NumberOfAzimuths; ++p)
        {
          const double phi = 2.0 * Pi * p / AzimuthalBasis::NumberOfAzimuths;
          const double si = std::sqrt(1.0 - in.Nodes[ka] * in.Nodes[ka]);
          const double i[3] = { si * std::cos(phi), si * std::sin(phi), in.Nodes[ka] };
          const double o[3] = { std::sqrt(1.0 - out.Nodes[kb] * out.Nodes[kb]), 0.0,
            out.Nodes[kb] };
          double f[3];
          brdf->Evaluate(i, o, f);
          double sum = 0.0;
          for (int k = 0; k < count; ++k)
          {
            const AzimuthalBasis::Term& term = basis.GetTerms()[static_cast<std::size_t>(k)];
            sum += (term.Order > 0 ? 2.0 : 1.0) * term.Incident[a] * term.Cosine(b, 0) *
                   std::cos(term.Order * phi);
          }
          difference += weight * (sum - f[0]) * (sum - f[0]);
          norm += weight * f[0] * f[0];
        }
      }
    }
    const double error = std::sqrt(difference / norm);
    EXPECT_NEAR(error, basis.GetTruncationError(count), 1e-6);
    EXPECT_LE(error, tolerance);
    EXPECT_GT(basis.GetTruncationError(count - 1), tolerance);
  }
}

//------------------------------------------------------------------------------
TEST(AzimuthalBasis, NumbersOfFunctions)
{
  vtkNew<vtkLambertBRDF> lambert;
  AzimuthalBasis basis;
  ASSERT_TRUE(basis.Compute(lambert, 0.0, Go));
  EXPECT_EQ(basis.FindNumberOfTerms(1e-6, 100), 1);
  EXPECT_LT(basis.GetTruncationError(1), 1e-7);

  // Gauss-Legendre nodes over the whole hemisphere of views need this many for 10, 5, 2 and 1 %.
  const struct
  {
    double Exponent;
    int Functions[4];
  } cases[] = { { 5.0, { 8, 14, 24, 41 } }, { 20.0, { 25, 41, 74, 118 } } };
  const double tolerances[4] = { 0.1, 0.05, 0.02, 0.01 };
  for (const auto& expected : cases)
  {
    vtkNew<GrazingLobe> lobe;
    lobe->Exponent = expected.Exponent;
    ASSERT_TRUE(basis.Compute(lobe, 0.0, Go));
    for (int k = 0; k < 4; ++k)
    {
      const int count = basis.GetNumberOfFunctions(basis.FindNumberOfTerms(tolerances[k], 1000));
      std::printf(
        "n = %g, %g %%: %d functions\n", expected.Exponent, 100 * tolerances[k], count);
      EXPECT_NEAR(count, expected.Functions[k], 3) << tolerances[k];
    }
    EXPECT_LE(basis.GetNumberOfFunctions(basis.FindNumberOfTerms(0.01, 17)), 17);
    EXPECT_LT(basis.GetSineShare(), 1e-12);
  }
}
