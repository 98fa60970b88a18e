// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Stacks of materials beside each other: of the same text, with numbers of their own.

#include "MaterialMapFixture.h"
#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace
{
// f = (value, 0.1, 0) / sr, read from a table of ones. Tables of two shapes do not go into one
// stack: a box about both would be nearly empty.
class ShapedBRDF : public vtkBRDF
{
public:
  static ShapedBRDF* New();
  vtkTypeMacro(ShapedBRDF, vtkBRDF);
  void GetBounds(double, double lower[3], double upper[3]) override
  {
    std::fill(lower, lower + 3, 0.0);
    std::fill(upper, upper + 3, 1.0);
  }
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override
  {
    ++this->Asked;
    vtkBRDFShaderInputs::Term term;
    term.Shader = "shaped term";
    term.Source = "uniform sampler3D brdfShapedINSTANCE;\nuniform float brdfShapedValueINSTANCE;\n"
                  "vec3 brdfTermINSTANCE(vec3 i, vec3 o)\n{\n"
                  "  return texture(brdfShapedINSTANCE, vec3(0.5)).r * "
                  "vec3(brdfShapedValueINSTANCE, 0.1, 0.0);\n}\n";
    term.Uniforms.push_back({ "brdfShapedValue", { static_cast<float>(this->Value) } });
    vtkBRDFShaderInputs::Texture texture;
    texture.Name = "brdfShaped";
    texture.ThreeD = true;
    texture.Dimensions = this->Shape;
    texture.Components = 1;
    texture.Data.assign(
      static_cast<std::size_t>(this->Shape[0] * this->Shape[1] * this->Shape[2]), 1.0f);
    term.Textures.push_back(texture);
    inputs.Terms.push_back(term);
  }
  double Value = 0.1;
  int Asked = 0; // for shader inputs
  std::array<int, 3> Shape = { 2, 2, 60 };

protected:
  void EvaluateAbove(const double*, const double*, double f[3]) override
  {
    f[0] = this->Value;
    f[1] = 0.1;
    f[2] = 0.0;
  }
};
vtkStandardNewMacro(ShapedBRDF);

class MaterialStacks : public MaterialMapping
{
protected:
  /// Classes 0 to 3 are of one shape, 4 to 7 of another, which meet at a line only.
  void ShowTwoShapes()
  {
    this->Mapper->SetEnvironment(nullptr);
    this->Mapper->SetIntegrator(nullptr);
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    this->Renderer->AddLight(light);
    for (int k = 0; k < 8; ++k)
    {
      vtkNew<ShapedBRDF> brdf;
      brdf->Value = 0.03 + 0.03 * k;
      if (k > 3)
      {
        brdf->Shape = { 2, 60, 2 };
      }
      this->Map->AddMaterial(brdf);
    }
    this->SetPoints([](vtkIdType point, int)
      { return static_cast<double>((point / 2) % 4 + (point % (Side + 1) > Side / 2 ? 4 : 0)); });
    this->Mapper->SetMaterialMap(this->Map);
    this->Mapper->ScalarVisibilityOff();
  }

  void ExpectSame(const FloatImage& stacked, const FloatImage& apart)
  {
    for (std::size_t k = 0; k < stacked.RGBA.size(); ++k)
    {
      ASSERT_NEAR(stacked.RGBA[k], apart.RGBA[k], 1.0 / 255.0)
        << k / 4 % Pixels << " " << k / 4 / Pixels;
    }
  }
};

// Both stacks have the same text but for the classes that they begin with.
TEST_F(MaterialStacks, OfTheSameTextHaveNumbersOfTheirOwn)
{
  this->ShowTwoShapes();
  std::set<std::string> stacks;
  vtkNew<vtkCallbackCommand> events;
  events->SetClientData(&stacks);
  events->SetCallback(
    [](vtkObject*, unsigned long, void* seen, void* program)
    {
      const std::string text =
        static_cast<vtkShaderProgram*>(program)->GetFragmentShader()->GetSource();
      if (text.find("brdfClassHere") != std::string::npos)
      {
        static_cast<std::set<std::string>*>(seen)->insert(text);
      }
    });
  this->Mapper->AddObserver(vtkCommand::UpdateShaderEvent, events);
  const FloatImage stacked = this->RenderLinear();
  EXPECT_EQ(stacks.size(), 2u);
  stacks.clear();
  this->Map->StackClassesOff();
  const FloatImage apart = this->RenderLinear();
  EXPECT_TRUE(stacks.empty());
  this->ExpectSame(stacked, apart);
  float least = 1.0f;
  float most = 0.0f;
  for (std::size_t k = 0; k < stacked.RGBA.size(); ++k)
  {
    least = k % 4 == 0 ? std::min(least, stacked.RGBA[k]) : least;
    most = k % 4 == 0 ? std::max(most, stacked.RGBA[k]) : most;
  }
  EXPECT_GT(most, 4.0f * least) << "the classes differ";
}

// They are found by the numbers of triangles, also of those between two stacks, which none draws.
TEST_F(MaterialStacks, ColorsOfCellsBetweenThemStayTheirOwn)
{
  this->ShowTwoShapes();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("colors");
  colors->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < this->Sheet->GetNumberOfCells(); ++cell)
  {
    colors->InsertNextTuple3(55 + (71 * cell) % 200, 55 + (37 * cell) % 200, 255);
  }
  const FloatImage plain = this->RenderLinear();
  this->Sheet->GetCellData()->AddArray(colors);
  this->Mapper->ScalarVisibilityOn();
  this->Mapper->SetScalarModeToUseCellFieldData();
  this->Mapper->SelectColorArray("colors");
  const FloatImage stacked = this->RenderLinear();
  EXPECT_NE(stacked.RGBA, plain.RGBA);
  this->Map->StackClassesOff();
  this->ExpectSame(stacked, this->RenderLinear());
}

// Views under environments of their own have stacks of their own, which stay from frame to frame.
TEST_F(MaterialStacks, OfTwoViewsStay)
{
  this->Mapper->SetEnvironment(nullptr);
  std::vector<vtkSmartPointer<ShapedBRDF>> materials;
  for (int k = 0; k < 4; ++k)
  {
    materials.push_back(vtkSmartPointer<ShapedBRDF>::New());
    materials.back()->Value = 0.03 + 0.03 * k;
    this->Map->AddMaterial(materials.back());
  }
  this->SetPoints([](vtkIdType point, int) { return static_cast<double>(point % 4); });
  this->Mapper->SetMaterialMap(this->Map);
  this->Mapper->ScalarVisibilityOff();
  vtkNew<vtkRenderer> right;
  this->Window->AddRenderer(right);
  right->AddActor(this->Actor);
  right->SetViewport(0.5, 0.0, 1.0, 1.0);
  this->Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  for (vtkRenderer* renderer : { this->Renderer.Get(), right.Get() })
  {
    vtkNew<vtkEnvironment> sky;
    ASSERT_TRUE(sky->SetPixels(8, 4, std::vector<float>(96, renderer == right ? 0.5f : 0.25f)));
    const auto image = vtkSmartPointer<vtkImageData>::Take(sky->NewImageData());
    vtkNew<vtkTexture> texture;
    texture->SetInputData(image);
    texture->SetColorModeToDirectScalars();
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    renderer->AddLight(light);
    renderer->UseImageBasedLightingOn();
    renderer->SetEnvironmentTexture(texture);
  }
  this->Window->Render();
  this->Window->Render();
  EXPECT_GT(materials[0]->Asked, 0);
  materials[0]->Asked = 0;
  this->Window->Render();
  EXPECT_EQ(materials[0]->Asked, 0) << "a view's stack was made anew for the other one";
}
}
