// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The legend of a material map: its entries, its pictures, where they are drawn.

#include "RenderFixture.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialLegendActor.h"
#include "vtkMaterialMap.h"
#include "vtkUnsignedCharArray.h"

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
    this->Renderer->AddActor2D(this->Legend);
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

TEST_F(MaterialLegend, ListsMaterialsWithTheirNames)
{
  ASSERT_EQ(this->Legend->GetNumberOfEntries(), 2);
  EXPECT_EQ(this->Legend->GetLabel(0), "4");
  EXPECT_EQ(this->Legend->GetLabel(1), "sky");
  EXPECT_EQ(this->Legend->GetLabel(2), "");
  EXPECT_EQ(this->Legend->GetSphere(-1), nullptr);
  this->Legend->SetSphereResolution(64);
  vtkImageData* sphere = this->Legend->GetSphere(1);
  ASSERT_NE(sphere, nullptr);
  EXPECT_EQ(sphere->GetDimensions()[0], 64);
  EXPECT_EQ(sphere->GetScalarComponentAsDouble(0, 0, 0, 3), 0.0);
  EXPECT_EQ(sphere->GetScalarComponentAsDouble(32, 32, 0, 3), 255.0);
  EXPECT_NEAR(
    sphere->GetScalarComponentAsDouble(32, 32, 0, 2), 255.0 * std::pow(0.5, 1 / 2.2), 4.0);
  EXPECT_EQ(this->Legend->GetSphere(1), sphere); // made once
  this->Red->SetAlbedo(0.2, 0.2, 0.2);
  EXPECT_EQ(this->Legend->GetSphere(1), sphere); // another one's change
  this->Legend->SetMaterialMap(nullptr);
  EXPECT_EQ(this->Legend->GetNumberOfEntries(), 0);
}

TEST_F(MaterialLegend, DrawsSpheresBelowEachOtherOrSideBySide)
{
  ExpectAlbedo(this->GetPixel(50, 150), 0.5, 0.1, 0.1); // the first one on top
  ExpectAlbedo(this->GetPixel(50, 50), 0.1, 0.1, 0.5);
  EXPECT_EQ(this->GetPixel(2, 100)[0], 0.0);
  this->Blue->SetAlbedo(0.3, 0.3, 0.3);
  ExpectAlbedo(this->GetPixel(50, 50), 0.3, 0.3, 0.3);
  this->Legend->HorizontalOn();
  this->Legend->SetTitle("materials");
  ExpectAlbedo(this->GetPixel(50, 140), 0.5, 0.1, 0.1);
  ExpectAlbedo(this->GetPixel(150, 140), 0.3, 0.3, 0.3);
}
}
