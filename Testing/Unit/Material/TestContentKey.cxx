// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What tells materials apart by their class, parameters and data.
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFModels.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace
{
// Of nobody's knowledge: what it adds to its superclass stays unknown.
class SecretBRDF : public vtkLambertBRDF
{
public:
  static SecretBRDF* New();
  vtkTypeMacro(SecretBRDF, vtkLambertBRDF);
  double Secret = 1.0;

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Superclass::EvaluateAbove(i, o, f);
    f[0] *= this->Secret;
  }
};
vtkStandardNewMacro(SecretBRDF);

// One without even a name of its own.
class NamelessBRDF : public vtkLambertBRDF
{
public:
  static NamelessBRDF* New() { VTK_STANDARD_NEW_BODY(NamelessBRDF); }
};
}

TEST(ContentKey, MaterialsThatDoNotSayWhatTheyAreHaveNone)
{
  const auto other = vtkSmartPointer<SecretBRDF>::New();
  EXPECT_EQ(vtkBRDFModels::GetContentKey(other), "");
  EXPECT_EQ(vtkBRDFModels::GetContentKey(vtkSmartPointer<NamelessBRDF>::New()), "");
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(vtkNew<vtkBlinnPhongBRDF>());
  EXPECT_NE(vtkBRDFModels::GetContentKey(sum), "");
  sum->AddTerm(other);
  EXPECT_EQ(vtkBRDFModels::GetContentKey(sum), "");
}

// Every parameter and every value counts; names and where the material is from do not.
TEST(ContentKey, EverythingThatCountsChangesIt)
{
  std::vector<std::string> keys;
  const auto add = [&keys](vtkBRDF* brdf)
  {
    const std::string key = vtkBRDFModels::GetContentKey(brdf);
    EXPECT_EQ(key.size(), 32u);
    EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 0) << brdf->GetClassName();
    keys.push_back(key);
    const auto copy = vtkSmartPointer<vtkBRDF>::Take(brdf->NewSnapshot());
    ASSERT_TRUE(copy);
    copy->SetName("another");
    copy->SetSource("elsewhere");
    EXPECT_EQ(vtkBRDFModels::GetContentKey(copy), key) << brdf->GetClassName();
    copy->SetResamplingTolerance(0.125);
    EXPECT_NE(vtkBRDFModels::GetContentKey(copy), key) << brdf->GetClassName();
  };
  vtkNew<vtkLambertBRDF> lambert;
  add(lambert);
  lambert->SetAlbedo(0.8, 0.8, 0.8000001);
  add(lambert);
  vtkNew<vtkBlinnPhongBRDF> phong;
  add(phong);
  phong->SetSpecular(0.1, 0.2, 0.1);
  add(phong);
  phong->SetExponent(51.0);
  add(phong);
  vtkNew<vtkAshikhminShirleyBRDF> lobe;
  add(lobe);
  lobe->SetSpecularScale(1.0, 1.0, 0.5);
  add(lobe);
  lobe->SetReflectance(0.04, 0.05, 0.04);
  add(lobe);
  lobe->SetDiffuse(0.0, 0.0, 0.1);
  add(lobe);
  lobe->SetExponentU(101.0);
  add(lobe);
  lobe->SetExponentV(102.0);
  add(lobe);
  lobe->SetFresnelModelToDielectric();
  add(lobe);
  lobe->SetIndexOfRefraction(1.6);
  add(lobe);
  vtkNew<vtkDistributionBRDF> distribution;
  add(distribution);
  ASSERT_TRUE(distribution->SetDistribution(1, 2, { 1.0f, 1.0f, 1.0f, 2.0f, 2.0f, 2.0f }));
  add(distribution);
  ASSERT_TRUE(distribution->SetDistribution(2, 1, { 1.0f, 1.0f, 1.0f, 2.0f, 2.0f, 2.0f }));
  add(distribution);
  ASSERT_TRUE(distribution->SetFresnel(1, { 1.0f, 1.0f, 0.5f }));
  add(distribution);
  std::vector<float> rgb(3 * 2 * 3 * 4, 0.5f);
  const int dimensions[3] = { 2, 3, 4 }, turned[3] = { 4, 3, 2 };
  vtkNew<vtkTabulatedBRDF> table;
  for (const int parameterization : { 0, 1 })
  {
    for (const int range : { 0, 1 })
    {
      ASSERT_TRUE(table->SetVolume(parameterization, range, dimensions, rgb));
      add(table);
    }
  }
  ASSERT_TRUE(table->SetVolume(0, 0, turned, rgb));
  add(table);
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    std::vector<float> other = rgb;
    other[k] = std::nextafter(other[k], 1.0f);
    ASSERT_TRUE(table->SetVolume(0, 0, dimensions, other));
    add(table);
  }
  table->SetCosineWeighted(true);
  add(table);
  table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
  add(table);
  table->SetResamplingError(0.1);
  add(table);
  vtkNew<vtkBasisBRDF> basis;
  const double zone[2] = { 9.0, 57.0 }, wide[2] = { 9.0, 60.0 };
  const auto set = [&](int type, int order, const double in[2], const double out[2], float last)
  {
    std::vector<float> values(3u * 4u * static_cast<std::size_t>(order * order + 2 * order + 1));
    values.back() = last;
    ASSERT_EQ(basis->SetCoefficients(type, order, in, out, 4, 1, values), "");
    add(basis);
  };
  set(vtkBasisBRDF::ZONAL, 1, zone, zone, 0.0f);
  set(vtkBasisBRDF::ZONAL, 1, zone, zone, 1.0f);
  set(vtkBasisBRDF::ZONAL, 1, wide, zone, 1.0f);
  set(vtkBasisBRDF::ZONAL, 1, zone, wide, 1.0f);
  set(vtkBasisBRDF::LEGENDRE_FOURIER, 1, zone, zone, 1.0f);
  set(vtkBasisBRDF::ZONAL, 2, zone, zone, 1.0f);
  basis->SetIncidentCosine(true);
  add(basis);
  basis->SetOutgoingCosine(true);
  add(basis);
  basis->SetResamplingError(0.5);
  add(basis);
  vtkAdaptiveWarpBRDF::Tables tables;
  tables.ThetaI = { 0.0f, 1.4f };
  tables.PhiI = { 0.0f };
  tables.Ndf = { { 2, 2 }, std::vector<float>(4, 1.0f) };
  tables.Sigma = tables.Ndf;
  tables.Vndf = { { 1, 2, 2, 2 }, std::vector<float>(8, 1.0f) };
  tables.Luminance = tables.Vndf;
  tables.Rgb = { { 1, 2, 3, 2, 2 }, std::vector<float>(24, 1.0f) };
  vtkNew<vtkAdaptiveWarpBRDF> warp;
  const auto addTables = [&]()
  {
    ASSERT_EQ(warp->SetTables(tables), "");
    add(warp);
  };
  addTables();
  tables.ThetaI[1] = 1.5f;
  addTables();
  tables.PhiI[0] = 0.1f;
  addTables();
  for (std::vector<float>* values : { &tables.Ndf.Values, &tables.Sigma.Values, &tables.Vndf.Values,
         &tables.Luminance.Values, &tables.Rgb.Values })
  {
    values->back() = 0.75f;
    addTables();
  }
  tables.Jacobian = false;
  addTables();
  vtkNew<vtkSumBRDF> sum;
  add(sum);
  sum->AddTerm(lambert);
  add(sum);
  sum->AddTerm(phong);
  add(sum);
  sum->RemoveAllTerms();
  sum->AddTerm(phong);
  sum->AddTerm(lambert);
  add(sum); // in another order: another form for the GPU
}
