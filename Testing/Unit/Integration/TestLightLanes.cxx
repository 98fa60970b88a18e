// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// f of many lights by what a material can, against f of one light.

#include "LightLanes.h"
#include "ManyLights.h"
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

const glm::dvec3 View(std::sin(0.9), 0.0, std::cos(0.9));

// More than are evaluated at once, about the mirror direction.
std::vector<glm::dvec3> MakeLights()
{
  std::vector<glm::dvec3> lights;
  for (int k = 0; k < 300; ++k)
  {
    const double angle = 2.399963229728653 * k;
    const double radius = 0.6 * k / 300.0;
    lights.push_back(glm::normalize(
      glm::dvec3(-View.x + radius * std::cos(angle), radius * std::sin(angle), View.z)));
  }
  return lights;
}

void ExpectSame(vtkBRDF* brdf, bool sideBySide)
{
  brdf->Prepare();
  EXPECT_EQ(LightLanes(brdf).AreSideBySide(), sideBySide) << brdf->GetClassName();
  const std::vector<glm::dvec3> lights = MakeLights();
  std::vector<glm::dvec3> f(lights.size());
  measuredbrdf::EvaluateManyLights(brdf, lights.size(), lights.data(), View, f.data());
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    glm::dvec3 expected;
    brdf->Evaluate(&lights[k].x, &View.x, &expected.x);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(f[k][c], expected[c], (sideBySide ? 3e-5 : 0.0) * expected[c] + 1e-12)
        << brdf->GetClassName() << " " << k;
    }
  }
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
  for (const char* name : { "nickel", "gold-metallic-paint3" })
  {
    const auto fit = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    ExpectSame(fit, true);
  }
}

//------------------------------------------------------------------------------
// A table with an invalid cell in a sum, and values that nothing can add up.
TEST(LightLanes, SumsOfTables)
{
  vtkNew<vtkTabulatedBRDF> table;
  const int dimensions[3] = { 2, 2, 2 };
  std::vector<float> volume(24, 3e38f);
  ASSERT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, volume));
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(table);
  sum->AddTerm(table);
  const std::vector<glm::dvec3> lights = MakeLights();
  std::vector<glm::dvec3> f(lights.size());
  EXPECT_TRUE(LightLanes(sum).AreSideBySide());
  measuredbrdf::EvaluateManyLights(sum, lights.size(), lights.data(), View, f.data());
  for (const glm::dvec3& value : f)
  {
    EXPECT_TRUE(std::isfinite(value.x) && value.x > 1e38) << value.x;
  }
  volume[3] = NAN;
  ASSERT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, volume));
  EXPECT_FALSE(LightLanes(sum).AreSideBySide());
}
