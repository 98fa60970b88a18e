// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Many classes of cells, which are drawn one after the other from common buffers: each shows what
// its material shows alone, whatever the last one has left behind.

#include "MaterialMapFixture.h"

#include "vtkActor.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <string>
#include <vector>

namespace
{
class ManyClasses : public MaterialMapping
{
protected:
  static constexpr int Count = 12;

  void SetUp() override
  {
    MaterialMapping::SetUp();
    if (!IsSkipped())
    {
      this->SetCells([](vtkIdType cell, int) { return static_cast<double>((5 * cell) % Count); });
    }
  }

  void AddMaterialsOfSeveralShaders()
  {
    this->AddMaterials(Count);
    this->RemoveSomeTerms();
  }

  void ExpectEachAlone()
  {
    this->RenderAlone();
    this->ExpectMixture([](const Place& place, int k)
      { return place.OnDiagonal ? -1.0 : ((5 * place.Cell) % Count == k ? 1.0 : 0.0); });
  }

  /// The picture of another mapper that never drew anything else.
  FloatImage RenderAnew()
  {
    vtkNew<vtkMeasuredBRDFMapper> other;
    other->SetInputData(this->Sheet);
    other->SetEnvironment(this->Environment);
    other->SetMaterialMap(this->Map);
    other->SetIntegrator(this->Mapper->GetIntegrator());
    other->SetErrorTolerance(this->Mapper->GetErrorTolerance());
    this->Actor->SetMapper(other);
    const FloatImage picture = this->RenderLinear();
    this->Actor->SetMapper(this->Mapper);
    return picture;
  }
};

TEST_F(ManyClasses, OfSeveralShadersUnderALight)
{
  this->AddMaterialsOfSeveralShaders();
  this->AddLight();
  this->ExpectEachAlone();
  const FloatImage first = this->RenderLinear();
  this->Renderer->RemoveAllLights();
  this->ExpectSame(this->RenderLinear(), this->RenderAnew(), "without the light");
  this->AddLight();
  this->ExpectSame(this->RenderLinear(), first, "with it again");
}

// A cell's color is found by the number of its triangle in what is drawn at once.
TEST_F(ManyClasses, ColorsOfCellsStayTheirOwn)
{
  this->AddMaterialsOfSeveralShaders();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("colors");
  colors->SetNumberOfComponents(3);
  for (int cell = 0; cell < 2 * Side * Side; ++cell)
  {
    colors->InsertNextTuple3(40 + cell, 255 - cell, 50 + (37 * cell) % 200);
  }
  this->Sheet->GetCellData()->AddArray(colors);
  this->Mapper->SetScalarModeToUseCellFieldData();
  this->Mapper->SelectColorArray("colors");
  this->ExpectEachAlone();
}

// What is known of a frame's materials holds until something changes.
TEST_F(ManyClasses, FollowEveryChange)
{
  this->AddMaterials(Count);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(0.3);
  this->Mapper->SetMaterialMap(this->Map);
  FloatImage last = this->RenderLinear();
  this->ExpectSame(this->RenderLinear(), last, "nothing changed");
  const auto expectChange = [this, &last](const char* what)
  {
    const FloatImage now = this->RenderLinear();
    this->ExpectSame(now, this->RenderAnew(), what);
    double largest = 0.0;
    for (int y = 0; y < Pixels; ++y)
    {
      for (int x = 0; x < Pixels; ++x)
      {
        largest = std::max(largest, std::abs(double(now.At(x, y)[1]) - last.At(x, y)[1]));
      }
    }
    EXPECT_GT(largest, 1e-3) << what;
    last = now;
  };
  vtkLambertBRDF::SafeDownCast(this->Materials[3]->GetTerm(0))->SetAlbedo(0.9, 0.9, 0.9);
  expectChange("a material");
  this->Environment->SetRotationY(90.0);
  expectChange("the environment's rotation");
  this->Map->SetBRDF(5, this->Materials[3]);
  expectChange("the map");
  this->SetCells([](vtkIdType cell, int) { return static_cast<double>((7 * cell) % Count); });
  expectChange("the data");
  this->Mapper->ReleaseGraphicsResources(this->Window);
  this->ExpectSame(this->RenderLinear(), last, "resources released");
  this->Actor->GetProperty()->EdgeVisibilityOn(); // each class has a mapper of its own now
  expectChange("edges");
  this->Actor->GetProperty()->EdgeVisibilityOff();
  expectChange("no edges");
}

// A window that the surface leaves loses none of its own buffers, although the mapper's are in
// another window by then; nor does it where the data change.
TEST_F(ManyClasses, LeaveOtherWindowsAlone)
{
  if (this->IsWithoutDisplay())
  {
    GTEST_SKIP() << "VTK's EGL windows cannot share a mapper";
  }
  this->AddMaterialsOfSeveralShaders();
  this->Mapper->SetMaterialMap(this->Map);
  vtkNew<vtkPolyDataMapper> plain;
  plain->SetInputData(this->Sheet);
  plain->ScalarVisibilityOff();
  vtkNew<vtkActor> stays;
  stays->SetMapper(plain);
  stays->SetScale(0.5);
  this->AddLight();
  this->Renderer->RemoveActor(this->Actor);
  this->Renderer->AddActor(stays);
  const FloatImage alone = this->RenderLinear();
  vtkNew<vtkRenderer> otherRenderer;
  vtkNew<vtkRenderWindow> other;
  other->SetOffScreenRendering(1);
  other->SetSize(32, 32);
  other->AddRenderer(otherRenderer);
  otherRenderer->AddActor(this->Actor);
  for (int turn = 1; turn <= 2; ++turn)
  {
    this->Renderer->AddActor(this->Actor);
    this->RenderLinear();
    other->Render();
    this->SetCells([turn](vtkIdType cell, int) { return (cell + turn) % Count; });
    if (turn == 2)
    {
      this->RenderLinear();
      other->Render();
    }
    this->Renderer->RemoveActor(this->Actor);
    this->ExpectSame(this->RenderLinear(), alone, "after the surface has left");
    other->Render();
  }
}
}
