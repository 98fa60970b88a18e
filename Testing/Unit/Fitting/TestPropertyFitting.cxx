// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The vtkProperty nearest to a material.
#include "ErrorCatcher.h"
#include "HalfVector.h"
#include "SpherePairs.h"
#include "SurfaceModel.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkProperty.h"

#include <sstream>

namespace
{
using measuredbrdf::Pi;

//------------------------------------------------------------------------------
// What VTK's fragment shader adds for a light, as `measured-brdf export` has it.
vtkSmartPointer<vtkBRDF> NewStock(vtkProperty* p)
{
  const double* color = p->GetDiffuseColor();
  const double* tint = p->GetEdgeTint();
  auto stock = tool::SurfaceModel::Make("vtk_pbr");
  stock->SetValues(
    { color[0], color[1], color[2], p->GetMetallic(), p->GetRoughness(), p->GetBaseIOR(), tint[0],
      tint[1], tint[2], p->GetCoatStrength(), p->GetCoatRoughness(), p->GetCoatIOR(), 0.0, 0.0 });
  return stock;
}

//------------------------------------------------------------------------------
// Relative L1 of two materials' pictures of a sphere under the neutral light, texel by texel.
double GetPictureError(vtkBRDF* model, vtkBRDF* exact)
{
  vtkNew<vtkEnvironment> light;
  vtkPBRPropertyFitter::SetToNeutralStudio(light, 64);
  SpherePairs pairs;
  constexpr int count = 150;
  for (int k = 0; k < count; ++k)
  {
    const double r = std::sqrt((k + 0.5) / count);
    const double phi = Pi * (3.0 - std::sqrt(5.0)) * k;
    pairs.Add({ r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - r * r) }, { 0.0, 0.0, 1.0 });
  }
  const auto a = pairs.IntegrateExactly(model, light);
  const auto b = pairs.IntegrateExactly(exact, light);
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      difference += std::abs(a[k][c] - b[k][c]);
      sum += b[k][c];
    }
  }
  return difference / sum;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPBRPropertyFitter> FitProperty(vtkBRDF* brdf, bool usual = true)
{
  auto fitter = vtkSmartPointer<vtkPBRPropertyFitter>::New();
  fitter->SetBRDF(brdf);
  fitter->SetUsualValues(usual);
  EXPECT_TRUE(fitter->Update());
  std::ostringstream text;
  fitter->Print(text);
  std::fputs(text.str().substr(text.str().find("  BaseColor")).c_str(), stdout);
  return fitter;
}
}

//------------------------------------------------------------------------------
TEST(PropertyFitter, LambertAndBlack)
{
  vtkNew<vtkLambertBRDF> lambert;
  for (const double share : { 1.0, 0.0 })
  {
    lambert->SetAlbedo(0.6 * share, 0.3 * share, 0.1 * share);
    const auto fitter = FitProperty(lambert);
    EXPECT_NEAR(fitter->GetBaseColor()[0], 0.6 * share, 2e-3 * share);
    EXPECT_NEAR(fitter->GetBaseColor()[1], 0.3 * share, 2e-3 * share);
    EXPECT_NEAR(fitter->GetBaseColor()[2], 0.1 * share, 2e-3 * share);
    EXPECT_EQ(fitter->GetMetallic(), 0.0);
    EXPECT_EQ(fitter->GetRoughness(), 1.0); // for what takes 4 % of reflection as given
    EXPECT_EQ(fitter->GetCoatStrength(), 0.0);
    EXPECT_LE(fitter->GetRelativeError(), 2e-3 * share);
  }
}

//------------------------------------------------------------------------------
TEST(PropertyFitter, Gold)
{
  vtkNew<vtkAshikhminShirleyBRDF> gold;
  gold->SetSpecularScale(1.0, 1.0, 1.0);
  gold->SetReflectance(1.0, 0.77, 0.34);
  gold->SetDiffuse(0.0, 0.0, 0.0);
  gold->SetExponents(200.0, 200.0);
  const auto fitter = FitProperty(gold);
  EXPECT_GT(fitter->GetMetallic(), 0.8);
  const double* color = fitter->GetBaseColor();
  EXPECT_GT(color[0], 1.15 * color[1]);
  EXPECT_GT(color[1], 1.8 * color[2]);
  // Blinn's exponent n and GGX's roughness: n = 2 / roughness^4 - 2.
  EXPECT_NEAR(fitter->GetRoughness(), std::pow(2.0 / 202.0, 0.25), 0.1);
  EXPECT_LT(fitter->GetRelativeError(), 0.08); // GGX has longer tails
}

//------------------------------------------------------------------------------
TEST(PropertyFitter, FindsVTKsOwn)
{
  vtkNew<vtkProperty> stock;
  stock->SetColor(0.7, 0.5, 0.2);
  stock->SetMetallic(1.0);
  stock->SetRoughness(0.35);
  vtkSmartPointer<vtkPBRPropertyFitter> fitter = FitProperty(NewStock(stock));
  EXPECT_NEAR(fitter->GetMetallic(), 1.0, 0.02);
  EXPECT_NEAR(fitter->GetRoughness(), 0.35, 0.01);
  EXPECT_NEAR(fitter->GetBaseColor()[0], 0.7, 0.01);
  EXPECT_NEAR(fitter->GetBaseColor()[2], 0.2, 0.01);
  EXPECT_LT(fitter->GetRelativeError(), 2e-3);

  // A clear coat over metal flakes. (Over plastic it would be a glossier plastic.)
  stock->SetColor(0.5, 0.1, 0.05);
  stock->SetMetallic(0.9);
  stock->SetRoughness(0.7);
  stock->SetCoatStrength(1.0);
  stock->SetCoatRoughness(0.1);
  stock->SetCoatIOR(1.6);
  fitter = FitProperty(NewStock(stock), false);
  EXPECT_GT(fitter->GetCoatStrength(), 0.5);
  EXPECT_LT(fitter->GetRelativeError(), 0.02);
}

//------------------------------------------------------------------------------
// The error that is returned is that of the property that is set: summed texel by texel, with a
// clear coat's terms, too.
TEST(PropertyFitter, ErrorIsTheSetPropertys)
{
  vtkNew<vtkProperty> coated;
  coated->SetColor(0.5, 0.1, 0.05);
  coated->SetRoughness(0.5);
  coated->SetMetallic(0.6);
  coated->SetCoatStrength(0.8);
  coated->SetCoatRoughness(0.3);
  std::vector<vtkSmartPointer<vtkBRDF>> materials = { NewStock(coated) };
  for (const char* name : { "pink-felt", "blue-metallic-paint" })
  {
    materials.push_back(vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name)));
  }
  for (const auto& brdf : materials)
  {
    vtkNew<vtkProperty> stock;
    const double plain = GetPictureError(NewStock(stock), brdf);
    const double error = vtkPBRPropertyFitter::Fit(brdf, stock);
    const double summed = GetPictureError(NewStock(stock), brdf);
    EXPECT_NEAR(error, summed, 0.1 * summed + 2e-3) << brdf->GetName();
    EXPECT_LT(error, 0.06) << brdf->GetName();
    EXPECT_LT(error, 0.1 * plain) << brdf->GetName();
  }
}

//------------------------------------------------------------------------------
// Nobody sets the metallic part of a felt to a half. What usual values cost is told.
TEST(PropertyFitter, UsualValues)
{
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    const std::string kind = vtkEmbeddedMaterials::GetKind(k);
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    SCOPED_TRACE(name);
    const auto usual = FitProperty(brdf);
    EXPECT_TRUE(usual->GetMetallic() == 0.0 || usual->GetMetallic() >= 0.3);
    EXPECT_LE(usual->GetRoughness(), usual->GetMetallic() > 0.0 ? 0.6 : 1.0);
    EXPECT_LE(std::max(usual->GetBaseIOR(), usual->GetCoatIOR()), 2.0);
    for (const char* plain : { "fabric", "felt", "rubber", "plastic", "wood" })
    {
      EXPECT_FALSE(kind == plain && usual->GetMetallic() > 0.0);
    }
    if (name == "pink-felt") // whose closest has a metallic part of 0.46
    {
      EXPECT_EQ(usual->GetClosestError(), FitProperty(brdf, false)->GetRelativeError());
    }
    EXPECT_GE(usual->GetRelativeError(), usual->GetClosestError());
    EXPECT_LT(usual->GetRelativeError(), usual->GetClosestError() + 0.08);
  }
}

//------------------------------------------------------------------------------
TEST(PropertyFitter, LeavesTheRest)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  vtkNew<vtkProperty> property;
  property->SetOpacity(0.25);
  property->SetRepresentationToWireframe();
  property->EdgeVisibilityOn();
  property->SetEdgeColor(0.1, 0.2, 0.3);
  property->SetLineWidth(3.0);
  property->BackfaceCullingOn();
  property->SetAmbient(0.125);
  property->SetAnisotropy(0.5);
  property->SetDiffuse(0.5);
  ASSERT_GT(vtkPBRPropertyFitter::Fit(brdf, property), 0.0);
  EXPECT_EQ(property->GetOpacity(), 0.25);
  EXPECT_EQ(property->GetRepresentation(), VTK_WIREFRAME);
  EXPECT_TRUE(property->GetEdgeVisibility());
  EXPECT_EQ(property->GetEdgeColor()[2], 0.3);
  EXPECT_EQ(property->GetLineWidth(), 3.0f);
  EXPECT_TRUE(property->GetBackfaceCulling());
  EXPECT_EQ(property->GetAmbient(), 0.125);
  // And what is the material's.
  EXPECT_EQ(property->GetInterpolation(), VTK_PBR);
  EXPECT_EQ(property->GetAnisotropy(), 0.0);
  EXPECT_EQ(property->GetDiffuse(), 1.0);
  EXPECT_GT(property->GetDiffuseColor()[0], property->GetDiffuseColor()[2]);
  EXPECT_GT(property->GetSpecular(), 0.0);
  EXPECT_GE(property->GetSpecularPower(), 1.0);
}

//------------------------------------------------------------------------------
TEST(PropertyFitter, NothingToFit)
{
  vtkNew<vtkPBRPropertyFitter> fitter;
  ErrorCatcher errors(fitter);
  EXPECT_FALSE(fitter->Update());
  EXPECT_EQ(errors.Take(), 1);
  fitter->Apply(nullptr);
  EXPECT_EQ(errors.Take(), 1);
  vtkNew<vtkLambertBRDF> lambert;
  EXPECT_LT(vtkPBRPropertyFitter::Fit(lambert, nullptr), 0.0);
}
