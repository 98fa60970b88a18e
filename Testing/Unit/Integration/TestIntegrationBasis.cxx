// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AzimuthalBasis.h"
#include "CosinePowerWarp.h"
#include "ErrorCatcher.h"
#include "LocalFrame.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBasisProjector.h"
#include "vtkBasisRadianceIntegrator.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkExactRadianceIntegrator.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <vector>

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
  void GetShaderInputs(vtkBRDFShaderInputs&) override {}
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

struct Pairs
{
  vtkNew<vtkDoubleArray> Normals, Views;

  explicit Pairs(int count)
  {
    this->Normals->SetNumberOfComponents(3);
    this->Views->SetNumberOfComponents(3);
    std::mt19937 engine(5);
    const auto draw = [&engine]()
    {
      const double z = 2.0 * (engine() * 0x1p-32) - 1.0;
      const double phi = 2.0 * Pi * (engine() * 0x1p-32);
      const double s = std::sqrt(1.0 - z * z);
      return glm::dvec3(s * std::cos(phi), s * std::sin(phi), z);
    };
    for (int k = 0; k < count; ++k)
    {
      const glm::dvec3 n = draw();
      glm::dvec3 v = draw();
      v = glm::normalize((glm::dot(n, v) < 0.0 ? -v : v) + 0.2 * n);
      this->Add(n, v);
    }
  }

  void Add(const glm::dvec3& n, const glm::dvec3& v)
  {
    this->Normals->InsertNextTuple(&n.x);
    this->Views->InsertNextTuple(&v.x);
  }

  std::vector<glm::dvec3> Integrate(vtkRadianceIntegrator* integrator)
  {
    vtkNew<vtkDoubleArray> radiance;
    EXPECT_TRUE(integrator->Integrate(this->Normals, this->Views, radiance));
    std::vector<glm::dvec3> result;
    for (vtkIdType k = 0; k < radiance->GetNumberOfTuples(); ++k)
    {
      glm::dvec3 rgb;
      radiance->GetTuple(k, &rgb.x);
      result.push_back(rgb);
    }
    return result;
  }
};

// Relative L1 over pairs and channels.
double GetError(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& reference)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < reference.size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_TRUE(std::isfinite(a[k][c]) && a[k][c] >= 0.0);
      difference += std::abs(a[k][c] - reference[k][c]);
      sum += reference[k][c];
    }
  }
  return difference / sum;
}

double CompareToExact(vtkBRDF* brdf, vtkEnvironment* environment,
  vtkBasisRadianceIntegrator* integrator, int count = 60)
{
  Pairs pairs(count);
  vtkNew<vtkExactRadianceIntegrator> exact;
  exact->SetBRDF(brdf);
  exact->SetEnvironment(environment);
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(environment);
  return GetError(pairs.Integrate(integrator), pairs.Integrate(exact));
}

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
    const measuredbrdf::Quadrature rule = measuredbrdf::WarpQuadrature(64, low);
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
      const double t = measuredbrdf::CosineToWarp(cosine, low);
      EXPECT_NEAR(measuredbrdf::WarpToCosine(t, low), cosine, 1e-14);
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
  const auto in = measuredbrdf::WarpQuadrature(n, 0.0);
  const auto out = measuredbrdf::WarpQuadrature(n, measuredbrdf::MinimumViewCosine);
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
      std::printf("n = %g, %g %%: %d functions\n", expected.Exponent, 100 * tolerances[k], count);
      EXPECT_NEAR(count, expected.Functions[k], 3) << tolerances[k];
    }
    EXPECT_LE(basis.GetNumberOfFunctions(basis.FindNumberOfTerms(0.01, 17)), 17);
    EXPECT_LT(basis.GetSineShare(), 1e-12);
  }
}

//------------------------------------------------------------------------------
TEST(BasisIntegrator, ConvergesToTheReference)
{
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBasisRadianceIntegrator> integrator;
  EXPECT_LT(CompareToExact(lambert, sky, integrator), 1e-3);

  EXPECT_EQ(integrator->GetNumberOfTerms(), 1);
  for (const double exponent : { 5.0, 20.0 })
  {
    double last = 1.0;
    for (const double tolerance : { 0.1, 0.03, 0.01 })
    {
      integrator->SetTolerance(tolerance);
      const double error = CompareToExact(NewLobe(exponent), sky, integrator);
      std::printf("n = %g, tolerance %g: %d terms, truncation %.4f, relative L1 %.5f\n", exponent,
        tolerance, integrator->GetNumberOfTerms(), integrator->GetTruncationError(), error);
      EXPECT_LT(error, tolerance);
      EXPECT_LT(error, last);
      last = error;
    }
  }
}

//------------------------------------------------------------------------------
TEST(BasisIntegrator, WhiteFurnaceIsTheDirectionalAlbedo)
{
  vtkNew<vtkEnvironment> white;
  ASSERT_TRUE(white->SetPixels(256, 128, std::vector<float>(3 * 256 * 128, 1.0f)));
  const auto brdf = NewLobe(10.0);
  vtkNew<vtkBasisRadianceIntegrator> integrator;
  integrator->SetBRDF(brdf);
  integrator->SetEnvironment(white);
  Pairs pairs(40);
  const auto radiance = pairs.Integrate(integrator);
  for (vtkIdType k = 0; k < 40; ++k)
  {
    glm::dvec3 n, v;
    pairs.Normals->GetTuple(k, &n.x);
    pairs.Views->GetTuple(k, &v.x);
    const double c = glm::dot(n, v);
    const double o[3] = { std::sqrt(1.0 - c * c), 0.0, c };
    double albedo[3];
    brdf->GetDirectionalAlbedo(o, albedo);
    EXPECT_NEAR(radiance[static_cast<std::size_t>(k)][0], albedo[0], 0.02 * albedo[0]);
  }
}

//------------------------------------------------------------------------------
TEST(BasisIntegrator, ContinuousOverSeamAndPoles)
{
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkBasisRadianceIntegrator> integrator;
  integrator->SetMapSize(64);
  integrator->SetBRDF(NewLobe(20.0));
  integrator->SetEnvironment(sky);
  Pairs pairs(0);
  const double e = 1e-6;
  for (int k = 0; k < 24; ++k)
  {
    const double phi = 2.0 * Pi * k / 24;
    const glm::dvec3 rim(std::cos(phi), std::sin(phi), 0.0);
    const glm::dvec3 view = glm::normalize(rim + glm::dvec3(0.3, 0.2, 0.6));
    pairs.Add(glm::normalize(rim + glm::dvec3(0, 0, e)), view);
    pairs.Add(glm::normalize(rim - glm::dvec3(0, 0, e)), view);
    const glm::dvec3 pole(0.0, 0.0, k % 2 == 0 ? 1.0 : -1.0);
    pairs.Add(glm::normalize(pole + e * rim), glm::normalize(pole + glm::dvec3(0.5, 0.3, 0.0)));
    pairs.Add(glm::normalize(pole - e * rim), glm::normalize(pole + glm::dvec3(0.5, 0.3, 0.0)));
    pairs.Add(rim, glm::normalize(rim + 1e-4 * glm::dvec3(0, 0, 1))); // along the normal
    pairs.Add(rim, glm::normalize(rim - 1e-4 * glm::dvec3(0, 0, 1)));
  }
  const auto radiance = pairs.Integrate(integrator);
  for (std::size_t k = 0; k < radiance.size(); k += 2)
  {
    EXPECT_NEAR(radiance[k].x / radiance[k + 1].x, 1.0, 5e-3) << k;
  }
}

//------------------------------------------------------------------------------
TEST(BasisIntegrator, TurningEverythingChangesNothing)
{
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkBasisRadianceIntegrator> integrator;
  integrator->SetBRDF(NewLobe(5.0));
  integrator->SetEnvironment(sky);
  Pairs pairs(40);
  Pairs turned(0);
  const double a = 70.0 * Pi / 180.0;
  for (vtkIdType k = 0; k < 40; ++k)
  {
    glm::dvec3 n, v;
    pairs.Normals->GetTuple(k, &n.x);
    pairs.Views->GetTuple(k, &v.x);
    const auto turn = [a](const glm::dvec3& d)
    {
      return glm::dvec3(
        std::cos(a) * d.x + std::sin(a) * d.z, d.y, std::cos(a) * d.z - std::sin(a) * d.x);
    };
    turned.Add(turn(n), turn(v));
  }
  const auto before = pairs.Integrate(integrator);
  sky->SetRotationY(70.0);
  EXPECT_LT(GetError(turned.Integrate(integrator), before), 1e-10);
  EXPECT_GT(GetError(pairs.Integrate(integrator), before), 1e-2);
}

//------------------------------------------------------------------------------
TEST(BasisIntegrator, OwnBasis)
{
  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(NewLobe(3.0));
  projector->SetBasis(vtkBasisBRDF::HEMISPHERICAL);
  projector->SetOrder(6);
  ASSERT_TRUE(projector->Project());
  vtkNew<vtkBasisRadianceIntegrator> integrator;
  integrator->UseOwnBasisOn();
  const double error = CompareToExact(projector->GetOutput(), sky, integrator);
  std::printf("own basis: %d terms, relative L1 %.5f\n", integrator->GetNumberOfTerms(), error);
  EXPECT_EQ(integrator->GetNumberOfTerms(), 49);
  EXPECT_EQ(integrator->GetTruncationError(), 0.0);
  EXPECT_LT(error, 5e-3);
}

//------------------------------------------------------------------------------
TEST(BasisIntegrator, RefusesAndKeepsGoing)
{
  vtkNew<vtkEnvironment> black;
  ASSERT_TRUE(black->SetPixels(16, 8, std::vector<float>(3 * 16 * 8, 0.0f)));
  vtkNew<vtkBasisRadianceIntegrator> integrator;
  ErrorCatcher errors(integrator);
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetExponents(10.0, 100.0);
  integrator->SetBRDF(brushed);
  EXPECT_FALSE(integrator->Prepare());
  integrator->SetEnvironment(black);
  EXPECT_FALSE(integrator->Prepare());
  EXPECT_EQ(errors.Take(), 2);
  EXPECT_NE(errors.GetText().find("anisotropic"), std::string::npos);
  integrator->SetBRDF(NewLobe(5.0));
  Pairs pairs(5);
  for (const glm::dvec3& rgb : pairs.Integrate(integrator))
  {
    EXPECT_EQ(rgb, glm::dvec3(0.0));
  }
  // Aborted, then again.
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* self, unsigned long, void*, void*)
    { static_cast<vtkRadianceIntegrator*>(self)->SetAbort(true); });
  const unsigned long tag = integrator->AddObserver(vtkCommand::ProgressEvent, stop);
  integrator->SetMapSize(16);
  EXPECT_FALSE(integrator->Prepare());
  EXPECT_EQ(errors.Take(), 1);
  integrator->RemoveObserver(tag);
  EXPECT_TRUE(integrator->Prepare());
}

//------------------------------------------------------------------------------
TEST(BasisIntegrator, RealMaterials)
{
  const std::string folder = MEASUREDBRDF_SHARED_DATA;
  if (!std::ifstream(folder + "/materials/rgl/cardboard_rgb.bsdf"))
  {
    GTEST_SKIP() << "no measured files beside the checkout";
  }
  for (const char* light : { "interior.exr", "pmndrs_sunrise.hdr" })
  {
    vtkNew<vtkEnvironmentReader> environment;
    environment->SetFileName(folder + "/environments/" + light);
    ASSERT_TRUE(environment->Read());
    for (const char* name : { "acrylic_felt_white", "cardboard" })
    {
      vtkNew<vtkBRDFReader> reader;
      reader->SetFileName(folder + "/materials/rgl/" + name + "_rgb.bsdf");
      ASSERT_TRUE(reader->Read());
      vtkNew<vtkBasisRadianceIntegrator> integrator;
      const double error =
        CompareToExact(reader->GetBRDF(), environment->GetEnvironment(), integrator, 6);
      std::printf("%s under %s: %d terms, truncation %.4f, relative L1 %.4f\n", name, light,
        integrator->GetNumberOfTerms(), integrator->GetTruncationError(), error);
      EXPECT_LT(error, integrator->GetTruncationError());
    }
  }
}
