// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of anisotropic materials against the reference.

#include "AnisotropicWarp.h"
#include "HalfVector.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkObjectFactory.h"
#include "vtkTableRadianceIntegrator.h"

#include <cmath>
#include <cstdio>

namespace
{
using measuredbrdf::Pi;

vtkNew<vtkTableRadianceIntegrator> NewAnisotropicTable(
  vtkBRDF* brdf, vtkEnvironment* environment, const std::vector<int>& sizes = {})
{
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetBRDF(brdf);
  table->SetEnvironment(environment);
  EXPECT_TRUE(table->SetSizes(sizes));
  return table;
}

vtkNew<vtkAshikhminShirleyBRDF> NewCoated(double u, double v)
{
  vtkNew<vtkAshikhminShirleyBRDF> brdf;
  brdf->SetDiffuse(0.1, 0.2, 0.4);
  brdf->SetSpecularScale(0.2, 0.5, 1.0);
  brdf->SetExponents(u, v);
  return brdf;
}

/// Cloth with a nap: it reflects more of what comes from one side.
class NapBRDF : public vtkBRDF
{
public:
  static NapBRDF* New();
  vtkTypeMacro(NapBRDF, vtkBRDF);
  bool IsIsotropic() override { return false; }
  void GetShaderInputs(vtkBRDFShaderInputs&) override {}

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    const double side = std::exp(2.0 * (i[0] + 0.3 * i[1] + 0.5 * o[0]));
    f[0] = 0.05 * side;
    f[1] = 0.04 * side;
    f[2] = 0.02 + 0.01 * side;
  }
};
vtkStandardNewMacro(NapBRDF);

double GetError(vtkRadianceIntegrator* table, int count = 120)
{
  SpherePairs pairs;
  pairs.AddRandom(count);
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(table->GetBRDF());
  reference->SetEnvironment(table->GetEnvironment());
  return GetRelativeError(pairs.Integrate(table), pairs.Integrate(reference));
}
}

//------------------------------------------------------------------------------
// What it is for: broad and medium brushed metal in 12 MB.
TEST(AnisotropicTable, BrushedMetalInTwelveMegabytes)
{
  const auto environment = NewSmallEnvironment(true);
  const auto broad = NewAnisotropicTable(NewBrushedMetal(0.2, 0.5), environment, { 25, 8, 20, 8 });
  const auto medium = NewAnisotropicTable(NewBrushedMetal(0.1, 0.4), environment, { 33, 6, 24, 6 });
  const double errors[] = { GetError(broad), GetError(medium) };
  std::printf("(0.2, 0.5) %.4f, (0.1, 0.4) %.4f\n", errors[0], errors[1]);
  EXPECT_LT(errors[0], 0.02);
  EXPECT_LT(errors[1], 0.05);
  EXPECT_LT(broad->EstimateTextureBytes(), 12000000);
  EXPECT_LT(medium->EstimateTextureBytes(), 12000000);
  EXPECT_EQ(broad->GetNumberOfPeriods(), 2);
}

//------------------------------------------------------------------------------
// Every size that grows gains; a Lambert part is in it.
TEST(AnisotropicTable, Converges)
{
  const auto environment = NewSmallEnvironment(true);
  const auto brdf = NewCoated(60.0, 8.0);
  double before = 1.0;
  for (const std::vector<int>& sizes : { std::vector<int>{ 17, 6, 8, 4 }, { 33, 10, 16, 8 } })
  {
    const double error = GetError(NewAnisotropicTable(brdf, environment, sizes));
    std::printf("%d rows: %.4f\n", sizes[0], error);
    EXPECT_LT(error, 0.5 * before);
    before = error;
  }
  EXPECT_LT(before, 0.015);
}

//------------------------------------------------------------------------------
TEST(AnisotropicTable, ClothWithANapHasOnePeriod)
{
  vtkNew<NapBRDF> nap;
  const auto environment = NewSmallEnvironment(true);
  const auto table = NewAnisotropicTable(nap, environment, { 25, 8, 12, 16 });
  EXPECT_EQ(table->GetNumberOfPeriods(), 0);
  const double error = GetError(table);
  std::printf("%.4f\n", error);
  EXPECT_LT(error, 0.015);
  EXPECT_EQ(table->GetNumberOfPeriods(), 1);
}

//------------------------------------------------------------------------------
TEST(AnisotropicTable, WhiteFurnaceIsTheDirectionalAlbedo)
{
  const auto environment = NewConstantEnvironment(64, 32, 2.0f);
  vtkNew<NapBRDF> nap;
  const auto metal = NewBrushedMetal(0.1, 0.4);
  const auto coated = NewCoated(100.0, 5.0);
  for (vtkBRDF* brdf :
    { static_cast<vtkBRDF*>(nap), static_cast<vtkBRDF*>(metal), static_cast<vtkBRDF*>(coated) })
  {
    brdf->Prepare();
    vtkNew<vtkDoubleArray> normals, views, tangents, radiance;
    std::vector<glm::dvec3> expected, actual;
    for (vtkDoubleArray* array : { normals.Get(), views.Get(), tangents.Get() })
    {
      array->SetNumberOfComponents(3);
    }
    for (const double degrees : { 0.0, 20.0, 45.0, 65.0, 80.0 })
    {
      for (const double turn : { 0.0, 0.3, 1.2, 2.9, 4.0, 6.2 })
      {
        const double s = std::sin(degrees * Pi / 180.0);
        const glm::dvec3 o(s * std::cos(turn), s * std::sin(turn), std::cos(degrees * Pi / 180.0));
        normals->InsertNextTuple3(0.0, 0.0, 1.0);
        tangents->InsertNextTuple3(1.0, 0.0, 0.0);
        views->InsertNextTuple(&o.x);
        glm::dvec3 albedo;
        brdf->GetDirectionalAlbedo(&o.x, &albedo.x);
        expected.push_back(2.0 * albedo);
      }
    }
    const auto table = NewAnisotropicTable(brdf, environment, { 17, 6, 8, 6 });
    ASSERT_TRUE(table->Integrate(normals, views, radiance, tangents));
    for (vtkIdType k = 0; k < radiance->GetNumberOfTuples(); ++k)
    {
      glm::dvec3 rgb;
      radiance->GetTuple(k, &rgb.x);
      actual.push_back(rgb);
    }
    EXPECT_LT(GetRelativeError(actual, expected), 0.01) << brdf->GetClassName();
  }
}

//------------------------------------------------------------------------------
// Everything is built in the environment's own frame; half a turn of the sample changes nothing.
TEST(AnisotropicTable, FollowsRotations)
{
  const auto environment = NewSmallEnvironment(true);
  const auto table = NewAnisotropicTable(NewBrushedMetal(0.15, 0.5), environment, { 25, 6, 16, 6 });
  SpherePairs pairs;
  pairs.AddRandom(40);
  vtkNew<vtkDoubleArray> tangents, turned[4], results[3];
  for (vtkDoubleArray* array :
    { tangents.Get(), turned[0].Get(), turned[1].Get(), turned[2].Get(), turned[3].Get() })
  {
    array->SetNumberOfComponents(3);
  }
  for (vtkIdType k = 0; k < pairs.Normals->GetNumberOfTuples(); ++k)
  {
    const glm::dvec3 t = glm::normalize(glm::dvec3(std::sin(3.0 * k), 1.0, std::cos(2.0 * k)));
    tangents->InsertNextTuple(&t.x);
    turned[3]->InsertNextTuple3(-t.x, -t.y, -t.z);
    int at = 0;
    for (vtkDoubleArray* from : { pairs.Normals.Get(), pairs.Views.Get(), tangents.Get() })
    {
      double d[3];
      from->GetTuple(k, d);
      turned[at++]->InsertNextTuple3(d[2], d[1], -d[0]);
    }
  }
  ASSERT_TRUE(table->Integrate(pairs.Normals, pairs.Views, results[0], tangents));
  ASSERT_TRUE(table->Integrate(pairs.Normals, pairs.Views, results[1], turned[3]));
  environment->SetRotationY(90.0);
  ASSERT_TRUE(table->Integrate(turned[0], turned[1], results[2], turned[2]));
  for (vtkIdType k = 0; k < 3 * pairs.Normals->GetNumberOfTuples(); ++k)
  {
    const double value = results[0]->GetValue(k);
    EXPECT_NEAR(results[1]->GetValue(k), value, 1e-9 * value) << k;
    EXPECT_NEAR(results[2]->GetValue(k), value, 1e-9 * value) << k;
  }
}

//------------------------------------------------------------------------------
TEST(AnisotropicTable, ShaderInputs)
{
  const auto table =
    NewAnisotropicTable(NewCoated(40.0, 10.0), NewSmallEnvironment(false), { 9, 3, 6, 4 });
  vtkBRDFShaderInputs inputs;
  ASSERT_TRUE(table->GetShaderInputs(inputs));
  ASSERT_EQ(inputs.Terms.size(), 1u);
  ASSERT_EQ(inputs.Terms[0].Textures.size(), 3u);
  const vtkBRDFShaderInputs::Texture& radiance = inputs.Terms[0].Textures[1];
  EXPECT_EQ(radiance.Dimensions[0], 16);
  EXPECT_EQ(radiance.Dimensions[1], 9 * 4);
  EXPECT_EQ(radiance.Dimensions[2], 3 * 7);
  EXPECT_NEAR(static_cast<double>(inputs.GetTextureBytes()),
    static_cast<double>(table->EstimateTextureBytes()), 1.0);
  EXPECT_EQ(
    inputs.Description, "anisotropic radiance table, 16 x 9 axes x 6 azimuths x 3 x 4 views");
}
