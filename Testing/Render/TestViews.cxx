// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// One mapper in several viewports, windows and passes: each gets its own plan, and only those that
// show colors get any.

#include "EventCounter.h"
#include "RenderFixture.h"

#include "../Unit/Support/GatedBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace
{
class Views : public RenderFixture
{
protected:
  void SetUpScene() override
  {
    this->BRDF->SetSpecular(0.4, 0.3, 0.2);
    this->BRDF->SetExponent(5.0);
    this->Measured->SetInputConnection(this->Sphere->GetOutputPort());
    this->Measured->SetBRDF(this->BRDF);
    this->Measured->SetErrorTolerance(0.3);
    this->Actor->SetMapper(this->Measured);
    this->Renderer->AddActor(this->Actor);
    for (int k = 0; k < 2; ++k)
    {
      // Red from one side, blue from the other; or green from above.
      vtkNew<vtkFloatArray> radiance;
      radiance->SetNumberOfComponents(3);
      for (int texel = 0; texel < 16 * 8; ++texel)
      {
        const float side = texel % 16 < 8 ? 1.0f : 0.1f;
        const float above = texel / 16 >= 4 ? 1.0f : 0.05f;
        const float rgb[2][3] = { { side, 0.2f, 1.1f - side }, { 0.1f, above, 0.1f } };
        radiance->InsertNextTuple(rgb[k]);
      }
      vtkNew<vtkImageData> image;
      image->SetDimensions(16, 8, 1);
      image->GetPointData()->SetScalars(radiance);
      this->Textures[k]->SetInputData(image);
      this->Textures[k]->MipmapOn();
      this->Textures[k]->InterpolateOn();
    }
  }
  void TearDown() override { this->BRDF->Door->OpenUp(); }

  static std::vector<unsigned char> Read(vtkRenderWindow* window)
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    const int* size = window->GetSize();
    window->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  static void SetUpWindow(vtkRenderWindow* window)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(64, 64);
  }

  void SetUpRenderer(vtkRenderer* renderer, vtkTexture* light, vtkActor* actor)
  {
    renderer->SetAutomaticLightCreation(false);
    renderer->SetActiveCamera(this->Renderer->GetActiveCamera());
    renderer->SetEnvironmentTexture(light);
    renderer->AddActor(actor);
  }

  /// What a fresh mapper shows under this light.
  std::vector<unsigned char> RenderAlone(vtkTexture* light)
  {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    vtkNew<vtkActor> actor;
    SetUpWindow(window);
    window->SetSize(32, 64);
    window->AddRenderer(renderer);
    mapper->ShallowCopy(this->Measured);
    actor->SetMapper(mapper);
    this->SetUpRenderer(renderer, light, actor);
    window->Render();
    return Read(window);
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<GatedBRDF> BRDF;
  vtkNew<vtkMeasuredBRDFMapper> Measured;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkTexture> Textures[2];
};
}

//------------------------------------------------------------------------------
TEST_F(Views, TwoViewportsTwoLights)
{
  const std::vector<unsigned char> alone[2] = { this->RenderAlone(this->Textures[0]),
    this->RenderAlone(this->Textures[1]) };
  ASSERT_NE(alone[0], alone[1]);
  vtkNew<vtkRenderer> right;
  this->Window->AddRenderer(right);
  this->Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  right->SetViewport(0.5, 0.0, 1.0, 1.0);
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->SetUpRenderer(right, this->Textures[1], this->Actor);
  const EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  for (const bool background : { false, true })
  {
    this->Measured->SetPlanningMode(
      background ? vtkMeasuredBRDFMapper::BACKGROUND : vtkMeasuredBRDFMapper::FOREGROUND);
    this->Window->Render();
    while (this->Measured->GetPlanPending())
    {
      ASSERT_TRUE(WaitUntil([this]() { return this->Measured->GetPlanReady(); }));
      this->Window->Render();
    }
    EXPECT_EQ(plans.Count, 2); // what was planned in the foreground serves in the background, too
    this->BRDF->Door->TakePasses();
    for (int frame = 0; frame < 3; ++frame)
    {
      this->Window->Render();
      EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);
      const std::vector<unsigned char> both = Read(this->Window);
      int wrong = 0;
      for (std::size_t k = 0; k < both.size(); ++k)
      {
        const std::size_t x = k / 4 % 64;
        wrong += both[k] != alone[x / 32][(k / 256 * 32 + x % 32) * 4 + k % 4] ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0);
    }
  }
  this->Window->RemoveRenderer(right);
}

//------------------------------------------------------------------------------
// A mapper's buffers go whenever another window draws it; what is in the making stays.
TEST_F(Views, TwoWindowsGetTheirBackgroundPlan)
{
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  SetUpWindow(window);
  window->AddRenderer(renderer);
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->SetUpRenderer(renderer, this->Textures[0], this->Actor);
  this->Measured->SetPlanningModeToBackground();
  this->Window->Render();
  window->Render();
  const std::string old = this->Measured->GetPlan();
  this->BRDF->Door->Close();
  this->BRDF->SetExponent(40.0);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->Window->Render();
    window->Render();
  }
  ASSERT_TRUE(WaitUntil([this]() { return this->BRDF->Door->IsAwaited(); }));
  EXPECT_EQ(this->Measured->GetPlan(), old);
  this->BRDF->Door->SettlePasses();
  // As many frames as it takes, in either window, do not begin it anew.
  this->Window->Render();
  window->Render();
  EXPECT_EQ(this->BRDF->Door->TakePasses(), 0);
  this->BRDF->Door->OpenUp();
  ASSERT_TRUE(WaitUntil([this]() { return this->Measured->GetPlanReady(); }));
  this->Window->Render();
  window->Render();
  EXPECT_FALSE(this->Measured->GetPlanPending());
  EXPECT_NE(this->Measured->GetPlan(), old);
  renderer->RemoveActor(this->Actor);
}

//------------------------------------------------------------------------------
TEST_F(Views, ShadowMapsNeedNoPlans)
{
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->AddSceneLight(8.0, 2.0, 0.0, 40.0); // from the side

  vtkNew<vtkShadowMapPass> shadows;
  this->Passes->RemoveAllItems();
  this->Passes->AddItem(shadows->GetShadowMapBakerPass());
  this->Passes->AddItem(shadows);
  this->Renderer->SetPass(this->CameraPass);
  const EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->Actor->SetPosition(0.01 * frame, 0.0, 0.0); // or the maps stay as they are
    this->Window->Render();
    EXPECT_EQ(plans.Count, 1) << frame;
  }
}

//------------------------------------------------------------------------------
TEST_F(Views, SelectionNeedsNoPlans)
{
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  const EventCounter plans(this->Measured, vtkCommand::UpdateDataEvent);
  this->Window->SetSize(64, 64);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Renderer);
  selector->SetArea(0, 0, 63, 63);
  this->Actor->VisibilityOff(); // the first frame makes the window
  this->Window->Render();
  this->Actor->VisibilityOn();
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_EQ(selection->GetNumberOfNodes(), 1u);
  EXPECT_EQ(plans.Count, 0);
  EXPECT_EQ(this->Measured->GetTextureBytes(), 0);
  this->Window->Render();
  EXPECT_EQ(plans.Count, 1);
  const vtkIdType bytes = this->Measured->GetTextureBytes();
  const auto again = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_EQ(again->GetNumberOfNodes(), 1u);
  EXPECT_EQ(plans.Count, 1);
  EXPECT_EQ(this->Measured->GetTextureBytes(), bytes);
}

//------------------------------------------------------------------------------
// A wireframe's surface that only hides lines.
TEST_F(Views, HiddenLinesNeedNoPlans)
{
  this->Renderer->SetEnvironmentTexture(this->Textures[0]);
  this->Renderer->UseHiddenLineRemovalOn();
  this->Actor->GetProperty()->SetRepresentationToWireframe();
  vtkNew<vtkActor> plain; // of another mapper, drawn as it is
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(this->Sphere->GetOutputPort());
  mapper->SetBRDF(this->BRDF);
  mapper->SetErrorTolerance(0.3);
  plain->SetMapper(mapper);
  this->Renderer->AddActor(plain);
  const EventCounter plans(mapper, vtkCommand::UpdateDataEvent);
  const EventCounter none(this->Measured, vtkCommand::UpdateDataEvent);
  this->Window->Render();
  EXPECT_EQ(plans.Count, 1);
  EXPECT_EQ(none.Count, 0);
}

namespace
{
/// Has no memory.
class Hungry : public vtkBlinnPhongBRDF
{
public:
  static Hungry* New();
  vtkTypeMacro(Hungry, vtkBlinnPhongBRDF);
  bool IsIsotropic() override
  {
    ++this->Asked;
    throw std::bad_alloc();
  }
  void GetShaderInputs(vtkBRDFShaderInputs&) override
  {
    ++this->Asked;
    throw std::bad_alloc();
  }
  int Asked = 0;
};
vtkStandardNewMacro(Hungry);
}

//------------------------------------------------------------------------------
TEST_F(Views, WithoutMemoryRenderSaysSoOnce)
{
  vtkNew<Hungry> hungry;
  this->Measured->SetBRDF(hungry);
  const EventCounter errors(this->Measured, vtkCommand::ErrorEvent);
  for (const bool lit : { true, false })
  {
    // Planning, or the material's own textures for a light.
    if (!lit)
    {
      this->AddHeadlight();
    }
    this->Renderer->SetEnvironmentTexture(lit ? this->Textures[0].Get() : nullptr);
    ASSERT_NO_THROW(this->Window->Render());
    const int count = errors.Count;
    const int asked = hungry->Asked;
    EXPECT_GE(count, 1);
    for (int frame = 0; frame < 3; ++frame)
    {
      ASSERT_NO_THROW(this->Window->Render());
    }
    EXPECT_EQ(errors.Count, count);
    EXPECT_EQ(hungry->Asked, asked);
  }
  // Drawn as the superclass does.
  const std::vector<unsigned char> shown = Read(this->Window);
  this->Measured->SetBRDF(nullptr);
  this->Window->Render();
  EXPECT_EQ(Read(this->Window), shown);
}
