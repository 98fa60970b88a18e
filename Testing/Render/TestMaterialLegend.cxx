// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The legend of a material map: its entries, its pictures, where they are drawn.

#include "RenderFixture.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialLegendActor.h"
#include "vtkMaterialMap.h"
#include "vtkRenderStepsPass.h"
#include "vtkToneMappingPass.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{
/// The picture of the window, without the passes of this fixture, which leave out 2D actors.
class MaterialLegend : public RenderFixture
{
protected:
  void SetUp() override
  {
    RenderFixture::SetUp();
    if (IsSkipped())
    {
      return;
    }
    this->White->SetPixels(8, 4, std::vector<float>(96, 1.0f));
    this->Red->SetAlbedo(0.5, 0.1, 0.1);
    this->Blue->SetAlbedo(0.1, 0.1, 0.5);
    this->Map->AddMaterial(this->Red, 4.0);
    this->Map->AddMaterial(nullptr, 5.0, "nothing");
    this->Map->AddMaterial(this->Blue, 6.0, "sky");
    this->Legend->SetMaterialMap(this->Map);
    this->Legend->SetEnvironment(this->White);
    this->Legend->SetPosition(0.0, 0.0);
    this->Legend->SetPosition2(1.0, 1.0);
    this->Renderer->AddViewProp(this->Legend);
    this->Window->SetSize(200, 200);
  }

  /// RGB of a pixel, from 0 to 1.
  std::array<double, 3> GetPixel(int x, int y)
  {
    this->Window->Render();
    vtkNew<vtkUnsignedCharArray> pixel;
    this->Window->GetRGBACharPixelData(x, y, x, y, 0, pixel);
    return { pixel->GetValue(0) / 255.0, pixel->GetValue(1) / 255.0, pixel->GetValue(2) / 255.0 };
  }
  static void ExpectAlbedo(const std::array<double, 3>& pixel, double r, double g, double b)
  {
    const double expected[3] = { r, g, b };
    for (std::size_t c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(pixel[c], std::pow(expected[c], 1.0 / 2.2), 0.02);
    }
  }

  vtkNew<vtkEnvironment> White;
  vtkNew<vtkLambertBRDF> Red;
  vtkNew<vtkLambertBRDF> Blue;
  vtkNew<vtkMaterialMap> Map;
  vtkNew<vtkMaterialLegendActor> Legend;
};

TEST_F(MaterialLegend, DrawsSpheresBelowEachOther)
{
  ExpectAlbedo(this->GetPixel(50, 150), 0.5, 0.1, 0.1); // the first one on top
  ExpectAlbedo(this->GetPixel(50, 50), 0.1, 0.1, 0.5);
  EXPECT_EQ(this->GetPixel(2, 100)[0], 0.0);
  this->Blue->SetAlbedo(0.3, 0.3, 0.3);
  ExpectAlbedo(this->GetPixel(50, 50), 0.3, 0.3, 0.3);
  this->Legend->SetTitle("materials");
  ExpectAlbedo(this->GetPixel(40, 130), 0.5, 0.1, 0.1);
  ExpectAlbedo(this->GetPixel(40, 40), 0.3, 0.3, 0.3);
}

// As the scene is, whose light is in cd/m2, say.
TEST_F(MaterialLegend, IsExposedByAToneMappingPass)
{
  this->White->SetPixels(8, 4, std::vector<float>(96, 1000.0f));
  vtkNew<vtkToneMappingPass> exposure;
  vtkNew<vtkRenderStepsPass> steps;
  exposure->SetToneMappingType(vtkToneMappingPass::Exponential);
  exposure->SetExposure(1e-3f);
  exposure->SetDelegatePass(steps);
  this->Renderer->SetPass(exposure);
  ExpectAlbedo(
    this->GetPixel(50, 150), 1.0 - std::exp(-0.5), 1.0 - std::exp(-0.1), 1.0 - std::exp(-0.1));
}

// 60 materials in four columns; in a window of another size, too; the map's changes show.
TEST_F(MaterialLegend, ManyMaterialsInColumns)
{
  this->Map->RemoveAllMaterials();
  this->Legend->SetSphereResolution(16);
  for (int k = 0; k < 60; ++k)
  {
    this->Map->AddMaterial(k == 15 ? this->Blue : this->Red, k);
  }
  ExpectAlbedo(this->GetPixel(6, 193), 0.5, 0.1, 0.1);
  ExpectAlbedo(this->GetPixel(56, 193), 0.1, 0.1, 0.5);
  ExpectAlbedo(this->GetPixel(56, 180), 0.5, 0.1, 0.1);
  this->Map->SetBRDF(15, this->Red);
  this->Map->SetBRDF(16, this->Blue);
  ExpectAlbedo(this->GetPixel(56, 193), 0.5, 0.1, 0.1);
  ExpectAlbedo(this->GetPixel(56, 180), 0.1, 0.1, 0.5);
  this->Window->SetSize(400, 400);
  ExpectAlbedo(this->GetPixel(112, 360), 0.1, 0.1, 0.5);
  this->Map->RemoveAllMaterials();
  EXPECT_EQ(this->GetPixel(112, 360)[2], 0.0);
}

// Names that are too long are small, and end where the legend does.
TEST_F(MaterialLegend, LongNamesEndWithTheLegend)
{
  this->Map->SetName(0, "a name too long for 100 pixels");
  this->Map->SetName(2, "\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC\xC3\xA4\xC3\xB6\xC3\xBC");
  this->Legend->SetPosition2(0.5, 1.0);
  this->Window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  this->Window->GetRGBACharPixelData(0, 0, 199, 199, 0, pixels);
  int lit = 0;
  for (vtkIdType p = 0; p < 200 * 200; ++p)
  {
    const bool isText = pixels->GetTypedComponent(p, 0) > 60 &&
                        pixels->GetTypedComponent(p, 0) == pixels->GetTypedComponent(p, 2);
    lit += isText ? 1 : 0;
    ASSERT_TRUE(p % 200 < 102 || pixels->GetTypedComponent(p, 0) == 0) << p % 200 << " " << p / 200;
  }
  EXPECT_GT(lit, 10);
}
}
