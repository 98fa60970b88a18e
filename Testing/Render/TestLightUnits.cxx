// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps may be in any unit: a factor on the light and its inverse on the exposure leave every
// picture as it is, with what a mesh hides from itself, and of several materials.

#include "RenderFixture.h"
#include "ScaledLight.h"

#include "vtkBlinnPhongBRDF.h"
#include "vtkCellData.h"
#include "vtkEnvironment.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkMaterialMap.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkSumBRDF.h"
#include "vtkSurfaceVisibilityFilter.h"

#include <algorithm>
#include <string>

namespace
{
// Of both decimal units and powers of two: the lights that stand for a map may be others where its
// digits are rounded otherwise.
constexpr double Units[] = { LightUnits[0], 1e5 };

class LightUnits8Bit : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    // A hollow, which hides itself.
    vtkNew<vtkSphereSource> bowl;
    bowl->SetRadius(0.95);
    bowl->SetThetaResolution(32);
    bowl->SetPhiResolution(24);
    bowl->SetEndPhi(110.0);
    this->Visibility->SetInputConnection(bowl->GetOutputPort());
    this->Visibility->BothSidesOn();
    this->Visibility->BounceOn();
    this->Visibility->Update();
    this->Surface = vtkPolyData::SafeDownCast(this->Visibility->GetOutputDataObject(0));
    this->Hall->SetToProceduralHall();
    this->Mapper->SetInputData(this->Surface);
    this->Mapper->SetOcclusionModeToOff();
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->GetActiveCamera()->SetPosition(1.0, -2.0, 4.0);
  }

  static vtkSmartPointer<vtkBRDF> NewGlossyCoat(double exponent, double red = 0.8)
  {
    vtkNew<vtkLambertBRDF> base;
    base->SetAlbedo(red, 0.4, 0.2);
    vtkNew<vtkBlinnPhongBRDF> gloss;
    gloss->SetSpecular(0.1, 0.1, 0.1);
    gloss->SetExponent(exponent);
    auto coat = vtkSmartPointer<vtkSumBRDF>::New();
    coat->AddTerm(base);
    coat->AddTerm(gloss);
    return coat;
  }

  /// The picture under the light in each unit, shown with that exposure, is the same.
  void ExpectSamePictures(const std::string& what)
  {
    this->Mapper->SetEnvironment(this->Hall);
    const FloatImage expected = this->RenderLinear();
    float brightest = 0.0f;
    for (const double unit : Units)
    {
      this->Mapper->SetEnvironment(NewScaledLight(this->Hall, unit));
      const FloatImage found = this->RenderLinear();
      long most = 0;
      double off = 0.0;
      double all = 0.0;
      for (std::size_t k = 0; k < expected.RGBA.size(); ++k)
      {
        const float value = expected.RGBA[k];
        brightest = std::max(brightest, value);
        const double scaled = k % 4 == 3 ? found.RGBA[k] : found.RGBA[k] / unit;
        most = std::max(most, std::labs(ToByte(scaled) - ToByte(static_cast<double>(value))));
        off += std::abs(scaled - static_cast<double>(value));
        all += static_cast<double>(value);
      }
      EXPECT_LE(most, 1) << what << ", times " << unit;
      EXPECT_LT(off, 2e-3 * all) << what << ", times " << unit; // highlights, too
    }
    EXPECT_GT(brightest, 0.1f) << what;
  }

  static long ToByte(double radiance)
  {
    return std::lround(255.0 * std::pow(std::clamp(radiance, 0.0, 1.0), 1.0 / 2.2));
  }

  vtkNew<vtkSurfaceVisibilityFilter> Visibility;
  vtkSmartPointer<vtkPolyData> Surface;
  vtkNew<vtkEnvironment> Hall;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> Actor;
};
}

// A plan's, beside what the hollow hides, and what that sends back.
TEST_F(LightUnits8Bit, WithSelfShadowing)
{
  this->Mapper->SetOcclusionModeToOn();
  this->Mapper->SetBRDF(NewGlossyCoat(20000.0, 0.5));
  this->ExpectSamePictures("shadowed");
  this->Mapper->SetBRDF(NewGlossyCoat(300.0));
  this->Mapper->OcclusionBounceOn();
  this->ExpectSamePictures("with a bounce");
}

TEST_F(LightUnits8Bit, OfMaterialMaps)
{
  constexpr int classes = 4;
  vtkNew<vtkIntArray> array;
  array->SetName("material");
  for (vtkIdType k = 0; k < this->Surface->GetNumberOfCells(); ++k)
  {
    array->InsertNextValue(static_cast<int>(k) % classes);
  }
  this->Surface->GetCellData()->AddArray(array);
  vtkNew<vtkMaterialMap> map;
  map->SetArrayName("material");
  for (int k = 0; k < classes; ++k)
  {
    map->AddMaterial(NewGlossyCoat(20.0 + 60.0 * k, 0.2 * (k + 1)));
  }
  this->Mapper->SetMaterialMap(map);
  this->ExpectSamePictures("classes");
  this->Mapper->SetOcclusionModeToOn();
  this->ExpectSamePictures("classes, shadowed");
}
