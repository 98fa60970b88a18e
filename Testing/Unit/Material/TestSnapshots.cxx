// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Snapshots: the same material or light, and no longer the original's.

#include "LowDiscrepancy.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace
{
std::vector<double> GetValues(vtkBRDF* brdf)
{
  brdf->Prepare();
  std::vector<double> values;
  const auto direction = [](unsigned int k, unsigned int base, double d[3])
  {
    d[2] = 1.0 - 0.95 * measuredbrdf::RadicalInverse(k, base);
    const double phi = 6.28 * measuredbrdf::RadicalInverse(k, base + 2);
    d[0] = std::sqrt(1.0 - d[2] * d[2]) * std::cos(phi);
    d[1] = std::sqrt(1.0 - d[2] * d[2]) * std::sin(phi);
  };
  for (unsigned int k = 1; k <= 50; ++k)
  {
    double i[3], o[3], f[3];
    direction(k, 3, i);
    direction(k, 5, o);
    brdf->Evaluate(i, o, f);
    values.insert(values.end(), f, f + 3);
    brdf->EvaluateSoft(i, o, 0.05, f);
    values.insert(values.end(), f, f + 3);
    values.push_back(brdf->Pdf(i, o));
  }
  return values;
}

// The same values now, and those still after the original changed.
template <typename Change>
void ExpectIndependent(vtkBRDF* original, Change change)
{
  original->SetName("one");
  original->SetSource("somewhere");
  original->SetResamplingTolerance(0.02);
  auto snapshot = vtkSmartPointer<vtkBRDF>::Take(original->NewSnapshot());
  ASSERT_TRUE(snapshot) << original->GetClassName();
  EXPECT_NE(snapshot.Get(), original);
  EXPECT_STREQ(snapshot->GetClassName(), original->GetClassName());
  EXPECT_EQ(snapshot->GetName(), "one");
  EXPECT_EQ(snapshot->GetSource(), "somewhere");
  EXPECT_EQ(snapshot->GetResamplingTolerance(), 0.02);
  EXPECT_EQ(snapshot->IsIsotropic(), original->IsIsotropic());
  const std::vector<double> values = GetValues(snapshot);
  EXPECT_EQ(values, GetValues(original)) << original->GetClassName();
  change();
  EXPECT_NE(values, GetValues(original)) << original->GetClassName();
  EXPECT_EQ(values, GetValues(snapshot)) << original->GetClassName();
}

/// What inherits copies without making its own.
class HalfPhong : public vtkBlinnPhongBRDF
{
public:
  static HalfPhong* New();
  vtkTypeMacro(HalfPhong, vtkBlinnPhongBRDF);

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Superclass::EvaluateAbove(i, o, f);
    f[0] *= 0.5;
  }
};
vtkStandardNewMacro(HalfPhong);

std::vector<float> MakeValues(std::size_t count, float offset)
{
  std::vector<float> values;
  for (std::size_t k = 0; k < count; ++k)
  {
    values.push_back(offset + 0.1f * static_cast<float>(k % 7));
  }
  return values;
}
}

TEST(Snapshots, ClosedForms)
{
  vtkNew<vtkLambertBRDF> lambert;
  lambert->SetAlbedo(0.1, 0.2, 0.3);
  ExpectIndependent(lambert, [&]() { lambert->SetAlbedo(0.3, 0.2, 0.1); });
  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetSpecular(0.3, 0.1, 0.2);
  phong->SetExponent(7.0);
  ExpectIndependent(phong, [&]() { phong->SetExponent(8.0); });
  vtkNew<vtkAshikhminShirleyBRDF> lobe;
  lobe->SetSpecularScale(0.9, 0.8, 0.7);
  lobe->SetReflectance(0.1, 0.2, 0.3);
  lobe->SetDiffuse(0.3, 0.4, 0.2);
  lobe->SetExponents(10.0, 30.0);
  lobe->SetFresnelModelToDielectric();
  lobe->SetIndexOfRefraction(1.7);
  ExpectIndependent(lobe, [&]() { lobe->SetExponentV(31.0); });
}

TEST(Snapshots, Tables)
{
  vtkNew<vtkDistributionBRDF> distribution;
  distribution->SetBlinnDistribution(30.0);
  ExpectIndependent(distribution, [&]() { distribution->SetBlinnDistribution(31.0); });

  vtkNew<vtkTabulatedBRDF> table;
  const int sizes[3] = { 5, 4, 3 };
  const auto fill = [&](float offset)
  {
    ASSERT_TRUE(table->SetVolume(vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::FULL_TURN,
      sizes, MakeValues(180, offset)));
  };
  fill(0.2f);
  table->SetCosineWeighted(true);
  ExpectIndependent(table, [&]() { fill(0.3f); });

  vtkNew<vtkBlinnPhongBRDF> phong;
  phong->SetExponent(5.0);
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(phong);
  projector->SetBasis(vtkBasisBRDF::HEMISPHERICAL);
  projector->SetOrder(3);
  ASSERT_TRUE(projector->Project());
  const vtkSmartPointer<vtkBasisBRDF> basis = projector->GetOutput();
  ExpectIndependent(basis, [&]() { basis->SetOutgoingCosine(!basis->GetOutgoingCosine()); });

  vtkNew<vtkAdaptiveWarpBRDF> warp;
  const auto setWarp = [&](float rgb)
  {
    vtkAdaptiveWarpBRDF::Tables tables;
    tables.ThetaI = { 0.1f, 0.8f, 1.5f };
    tables.PhiI = { 0.0f };
    tables.Ndf = { { 4, 4 }, MakeValues(16, 0.5f) };
    tables.Sigma = { { 4, 4 }, MakeValues(16, 0.5f) };
    tables.Vndf = { { 1, 3, 4, 4 }, MakeValues(48, 0.5f) };
    tables.Luminance = { { 1, 3, 4, 4 }, MakeValues(48, 0.5f) };
    tables.Rgb = { { 1, 3, 3, 4, 4 }, MakeValues(144, rgb) };
    ASSERT_EQ(warp->SetTables(std::move(tables)), "");
  };
  setWarp(0.2f);
  ExpectIndependent(warp, [&]() { setWarp(0.4f); });
}

TEST(Snapshots, SumsCopyTheirTerms)
{
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkBlinnPhongBRDF> phong;
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(phong);
  ExpectIndependent(sum, [&]() { phong->SetExponent(3.0); });
}

TEST(Snapshots, NoneOfWhatWouldLoseItsClass)
{
  vtkNew<HalfPhong> half;
  EXPECT_EQ(half->NewSnapshot(), nullptr);
  vtkNew<vtkLambertBRDF> lambert;
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(lambert);
  sum->AddTerm(half);
  EXPECT_EQ(sum->NewSnapshot(), nullptr);
}

TEST(Snapshots, Environments)
{
  vtkNew<vtkEnvironment> environment;
  environment->SetPixels(4, 2, std::vector<float>(24, 1.0f));
  environment->SetRotationY(30.0);
  environment->SetName("room");
  auto snapshot = vtkSmartPointer<vtkEnvironment>::Take(environment->NewSnapshot());
  EXPECT_EQ(snapshot->GetName(), "room");
  EXPECT_EQ(&snapshot->GetPixels(), &environment->GetPixels()); // not twice in memory
  double before[9], after[9];
  environment->GetWorldToEnvironment(before);
  environment->SetRotationY(60.0);
  snapshot->GetWorldToEnvironment(after);
  EXPECT_EQ(std::vector<double>(before, before + 9), std::vector<double>(after, after + 9));
  const vtkMTimeType time = snapshot->GetPixelsMTime();
  environment->SetPixels(2, 1, std::vector<float>(6, 2.0f));
  EXPECT_EQ(snapshot->GetWidth(), 4);
  EXPECT_EQ(snapshot->GetPixels(), std::vector<float>(24, 1.0f));
  EXPECT_EQ(snapshot->GetPixelsMTime(), time);
}
