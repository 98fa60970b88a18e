// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// f of many lights in the fastest way that a material offers, against f of one light.

#include "AnisotropicWarp.h"
#include "LightLanes.h"
#include "LobeViews.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

using measuredbrdf::LightLanes;

namespace
{
// Does something else than what it derives from.
class Doubled : public vtkAshikhminShirleyBRDF
{
public:
  static Doubled* New();
  vtkTypeMacro(Doubled, vtkAshikhminShirleyBRDF);

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Superclass::EvaluateAbove(i, o, f);
    for (int c = 0; c < 3; ++c)
    {
      f[c] *= 2.0;
    }
  }
};
vtkStandardNewMacro(Doubled);

// More than are evaluated at once, about the mirror direction.
std::vector<glm::dvec3> MakeLights(const glm::dvec3& view)
{
  std::vector<glm::dvec3> lights;
  for (int k = 0; k < 300; ++k)
  {
    const double angle = 2.399963229728653 * k;
    const double radius = 0.6 * k / 300.0;
    lights.push_back(glm::normalize(
      glm::dvec3(-view.x + radius * std::cos(angle), -view.y + radius * std::sin(angle), view.z)));
  }
  return lights;
}

std::vector<glm::dvec3> EvaluateFloats(
  const LightLanes& lanes, const std::vector<glm::dvec3>& lights, const glm::dvec3& view)
{
  std::vector<float> i[3], values[3];
  for (int c = 0; c < 3; ++c)
  {
    for (const glm::dvec3& light : lights)
    {
      i[c].push_back(static_cast<float>(light[c]));
    }
    values[c].assign(lights.size(), -1.0f);
  }
  const float* const from[3] = { i[0].data(), i[1].data(), i[2].data() };
  float* const to[3] = { values[0].data(), values[1].data(), values[2].data() };
  lanes.Evaluate(static_cast<int>(lights.size()), from, view, to);
  std::vector<glm::dvec3> f;
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    f.emplace_back(values[0][k], values[1][k], values[2][k]);
  }
  return f;
}

void ExpectSame(vtkBRDF* brdf, bool sideBySide, double floats = 3e-5)
{
  brdf->Prepare();
  const LightLanes lanes(brdf);
  EXPECT_EQ(lanes.AreSideBySide(), sideBySide) << brdf->GetClassName();
  for (const glm::dvec3& view : { glm::dvec3(std::sin(0.9), 0.0, std::cos(0.9)),
         glm::dvec3(0.6 * std::sin(1.3), -0.8 * std::sin(1.3), std::cos(1.3)) })
  {
    const std::vector<glm::dvec3> lights = MakeLights(view);
    std::vector<glm::dvec3> f(lights.size());
    lanes.Evaluate(lights.size(), lights.data(), view, f.data());
    const std::vector<glm::dvec3> rounded = EvaluateFloats(lanes, lights, view);
    for (std::size_t k = 0; k < lights.size(); ++k)
    {
      glm::dvec3 expected;
      brdf->Evaluate(&lights[k].x, &view.x, &expected.x);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(f[k][c], expected[c], (sideBySide ? floats : 0.0) * expected[c] + 1e-12)
          << brdf->GetClassName() << " " << k;
        EXPECT_NEAR(rounded[k][c], expected[c], floats * expected[c] + 1e-12)
          << brdf->GetClassName() << " " << k;
      }
    }
  }
}

vtkSmartPointer<vtkTabulatedBRDF> NewTable(const std::vector<float>& volume)
{
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  const int dimensions[3] = { 2, 2, 2 };
  EXPECT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, volume));
  return table;
}
}

//------------------------------------------------------------------------------
TEST(LightLanes, AreTheMaterial)
{
  vtkNew<vtkLambertBRDF> matte;
  matte->SetAlbedo(0.1, 0.5, 0.9);
  ExpectSame(matte, true);
  vtkNew<vtkAshikhminShirleyBRDF> gloss;
  gloss->SetExponents(900.0, 40.0);
  ExpectSame(gloss, true);
  vtkNew<Doubled> doubled;
  ExpectSame(doubled, false);
  vtkNew<vtkBlinnPhongBRDF> phong;
  ExpectSame(phong, false);

  vtkNew<vtkSumBRDF> sum;
  ExpectSame(sum, false); // of nothing
  sum->AddTerm(matte);
  sum->AddTerm(gloss);
  ExpectSame(sum, true);
  vtkNew<vtkSumBRDF> nested;
  nested->AddTerm(sum);
  nested->AddTerm(gloss);
  ExpectSame(nested, true);
  nested->AddTerm(phong);
  ExpectSame(nested, false);
  vtkNew<vtkSumBRDF> tables;
  std::vector<float> volume;
  for (int k = 0; k < 24; ++k)
  {
    volume.push_back(0.1f + 0.01f * static_cast<float>(k));
  }
  tables->AddTerm(NewTable(volume));
  tables->AddTerm(phong);
  ExpectSame(tables, false, 1e-4);
  vtkNew<vtkAdaptiveWarpBRDF> measured;
  gloss->SetExponents(50.0, 50.0);
  ASSERT_EQ(measured->SetTables(MakeAnisotropicTables(gloss, { 16, 1, 1, 65 })), "");
  vtkNew<vtkSumBRDF> withMeasured;
  withMeasured->AddTerm(measured);
  withMeasured->AddTerm(matte);
  ExpectSame(withMeasured, true, 1e-3);
  for (const char* name : { "nickel", "gold-metallic-paint3" })
  {
    const auto fit = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    ExpectSame(fit, true);
  }
}

//------------------------------------------------------------------------------
// Values whose sum overflows a float, and a table with an invalid cell.
TEST(LightLanes, SumsOfTables)
{
  std::vector<float> volume(24, 3e38f);
  const auto table = NewTable(volume);
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(table);
  sum->AddTerm(table);
  const glm::dvec3 view(0.0, 0.0, 1.0);
  EXPECT_TRUE(LightLanes(sum).AreSideBySide());
  for (const glm::dvec3& value : EvaluateFloats(LightLanes(sum), MakeLights(view), view))
  {
    EXPECT_TRUE(std::isfinite(value.x) && value.x > 1e38) << value.x;
  }
  vtkNew<vtkLambertBRDF> bright;
  bright->SetAlbedo(1e300, 1e300, 1e300);
  for (const glm::dvec3& value : EvaluateFloats(LightLanes(bright), MakeLights(view), view))
  {
    EXPECT_TRUE(std::isfinite(value.x) && value.x >= 0.0) << value.x;
  }
  volume[3] = NAN;
  const int dimensions[3] = { 2, 2, 2 };
  ASSERT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, volume));
  EXPECT_FALSE(LightLanes(sum).AreSideBySide());
}

//------------------------------------------------------------------------------
// What rounding to single precision makes of a matte table is no lobe.
TEST(LightLanes, RoundingIsNoLobe)
{
  const auto matte = NewTable(std::vector<float>(24, 0.2f / 3.14159265f));
  vtkNew<vtkLambertBRDF> ground;
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(matte);
  sum->AddTerm(ground);
  for (vtkBRDF* brdf : { static_cast<vtkBRDF*>(matte), static_cast<vtkBRDF*>(sum) })
  {
    for (const double theta : { 0.0, 0.5, 1.1, 1.5 })
    {
      const measuredbrdf::LobeQuadrature quadrature(
        brdf, { std::sin(theta), 0.0, std::cos(theta) }, 512);
      EXPECT_EQ(measuredbrdf::LobeMeans(quadrature).Amplitude, glm::dvec3(0.0)) << theta;
    }
  }
}
