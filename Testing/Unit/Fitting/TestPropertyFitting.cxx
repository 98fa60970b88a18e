// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The vtkProperty nearest to a material.
#include "ErrorCatcher.h"
#include "HalfVector.h"
#include "SpherePairs.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkProperty.h"

#include <sstream>

namespace
{
using measuredbrdf::Pi;

//------------------------------------------------------------------------------
// What VTK's fragment shader adds for a light (vtkPBRFunctions.glsl), written out once more.
class StockBRDF : public vtkBRDF
{
public:
  static StockBRDF* New();
  vtkTypeMacro(StockBRDF, vtkBRDF);

  void GetShaderInputs(vtkBRDFShaderInputs&) override {}

  vtkNew<vtkProperty> Property;

protected:
  static double Specular(double ndh, double ndv, double ndl, double hdl, double roughness,
    double f0, double f90, double& f)
  {
    const double a = roughness * roughness;
    const double d = (ndh * a * a - ndh) * ndh + 1.0;
    const double ggxV = ndl * std::sqrt(a + ndv * (ndv - a * ndv));
    const double ggxL = ndv * std::sqrt(a + ndl * (ndl - a * ndl));
    f = f0 + (f90 - f0) * std::pow(1.0 - hdl, 5);
    return a * a / (Pi * d * d) * 0.5 / (ggxV + ggxL) * f;
  }

  void EvaluateAbove(const double i[3], const double o[3], double rgb[3]) override
  {
    vtkProperty* p = this->Property;
    const glm::dvec3 l(i[0], i[1], i[2]);
    const glm::dvec3 h = glm::normalize(l + glm::dvec3(o[0], o[1], o[2]));
    const double hdl = std::min(glm::dot(h, l), 1.0);
    const double metallic = p->GetMetallic();
    const double base = p->ComputeReflectanceOfBaseLayer();
    const double* albedo = p->GetDiffuseColor();
    double f0[3];
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      f0[c] = base * (1.0 - metallic) + albedo[c] * metallic;
      sum += 16.5 * f0[c];
    }
    for (int c = 0; c < 3; ++c)
    {
      const double f90 = std::min(sum, 1.0) * (1.0 - metallic) + p->GetEdgeTint()[c] * metallic;
      double f = 0.0;
      double specular = Specular(h.z, o[2], i[2], hdl, p->GetRoughness(), f0[c], f90, f);
      double diffuse = (1.0 - metallic) * (1.0 - f) * albedo[c] / Pi;
      if (p->GetCoatStrength() > 0.0)
      {
        const double coatF0 = vtkProperty::ComputeReflectanceFromIOR(p->GetCoatIOR(), 1.0);
        double fc = 0.0;
        const double coat = Specular(h.z, o[2], i[2], hdl, p->GetCoatRoughness(), coatF0, 1.0, fc) *
                            p->GetCoatStrength();
        fc *= p->GetCoatStrength();
        specular = specular * (1.0 - fc) * (1.0 - fc) + coat;
        diffuse *= 1.0 - fc;
      }
      rgb[c] = diffuse + specular;
    }
  }
};
vtkStandardNewMacro(StockBRDF);

//------------------------------------------------------------------------------
// Relative L1 of two materials' pictures of a sphere under the neutral light, texel by texel.
double GetPictureError(vtkBRDF* model, vtkBRDF* exact)
{
  constexpr int height = 64;
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < 2 * height; ++x)
    {
      double d[3];
      vtkEnvironment::GetDirection((x + 0.5) / (2 * height), (y + 0.5) / height, d);
      pixels.insert(
        pixels.end(), 3, static_cast<float>(vtkPBRPropertyFitter::GetNeutralRadiance(d)));
    }
  }
  vtkNew<vtkEnvironment> light;
  EXPECT_TRUE(light->SetPixels(2 * height, height, std::move(pixels)));
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
vtkSmartPointer<vtkPBRPropertyFitter> Fit(vtkBRDF* brdf, bool usual = true)
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
    const auto fitter = Fit(lambert);
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
  const auto fitter = Fit(gold);
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
  vtkNew<StockBRDF> stock;
  stock->Property->SetColor(0.7, 0.5, 0.2);
  stock->Property->SetMetallic(1.0);
  stock->Property->SetRoughness(0.35);
  vtkSmartPointer<vtkPBRPropertyFitter> fitter = Fit(stock);
  EXPECT_NEAR(fitter->GetMetallic(), 1.0, 0.02);
  EXPECT_NEAR(fitter->GetRoughness(), 0.35, 0.01);
  EXPECT_NEAR(fitter->GetBaseColor()[0], 0.7, 0.01);
  EXPECT_NEAR(fitter->GetBaseColor()[2], 0.2, 0.01);
  EXPECT_LT(fitter->GetRelativeError(), 2e-3);

  // A clear coat over metal flakes. (Over plastic it would be a glossier plastic.)
  stock->Property->SetColor(0.5, 0.1, 0.05);
  stock->Property->SetMetallic(0.9);
  stock->Property->SetRoughness(0.7);
  stock->Property->SetCoatStrength(1.0);
  stock->Property->SetCoatRoughness(0.1);
  stock->Property->SetCoatIOR(1.6);
  fitter = Fit(stock, false);
  EXPECT_GT(fitter->GetCoatStrength(), 0.5);
  EXPECT_LT(fitter->GetRelativeError(), 0.02);
}

//------------------------------------------------------------------------------
// The error that is returned is that of the property that is set: summed texel by texel, with a
// clear coat's terms, too.
TEST(PropertyFitter, ErrorIsTheSetPropertys)
{
  vtkNew<StockBRDF> coated;
  coated->Property->SetColor(0.5, 0.1, 0.05);
  coated->Property->SetRoughness(0.5);
  coated->Property->SetMetallic(0.6);
  coated->Property->SetCoatStrength(0.8);
  coated->Property->SetCoatRoughness(0.3);
  std::vector<vtkSmartPointer<vtkBRDF>> materials = { coated.Get() };
  for (const char* name : { "pink-felt", "blue-metallic-paint" })
  {
    materials.push_back(vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name)));
  }
  for (const auto& brdf : materials)
  {
    vtkNew<StockBRDF> stock;
    const double plain = GetPictureError(stock, brdf);
    const double error = vtkPBRPropertyFitter::Fit(brdf, stock->Property);
    const double summed = GetPictureError(stock, brdf);
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
    const auto usual = Fit(brdf);
    EXPECT_TRUE(usual->GetMetallic() == 0.0 || usual->GetMetallic() >= 0.3);
    EXPECT_LE(usual->GetRoughness(), usual->GetMetallic() > 0.0 ? 0.6 : 1.0);
    EXPECT_LE(std::max(usual->GetBaseIOR(), usual->GetCoatIOR()), 2.0);
    for (const char* plain : { "fabric", "felt", "rubber", "plastic", "wood" })
    {
      EXPECT_FALSE(kind == plain && usual->GetMetallic() > 0.0);
    }
    if (name == "pink-felt") // whose closest has a metallic part of 0.46
    {
      EXPECT_EQ(usual->GetClosestError(), Fit(brdf, false)->GetRelativeError());
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
