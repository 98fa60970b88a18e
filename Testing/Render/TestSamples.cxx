// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Samples that are drawn in sub-frames: in the end the picture of all samples, whatever it is drawn
// with, and never a part of it where somebody reads it.
#include "MaterialMapFixture.h"
#include "vtkAppendPolyData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHardwareSelector.h"
#include "vtkOpaquePass.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSelection.h"
#include "vtkShaderProperty.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkWindowToImageFilter.h"

#include <chrono>
#include <thread>

namespace
{
/// Its timers fire when they are told to.
class Clock : public vtkRenderWindowInteractor
{
public:
  static Clock* New();
  vtkTypeMacro(Clock, vtkRenderWindowInteractor);

  /// False: there was none.
  bool Fire()
  {
    int timer = this->Last;
    this->Last = 0;
    if (timer != 0)
    {
      this->InvokeEvent(vtkCommand::TimerEvent, &timer);
    }
    return timer != 0;
  }

protected:
  int InternalCreateTimer(int timer, int, unsigned long) override { return this->Last = timer; }

private:
  int Last = 0;
};

vtkStandardNewMacro(Clock);

constexpr double Still = 1e-4;    // pictures a second
constexpr double Hasty = 1e9;     // so that each picture has time for a sub-frame of one sample
constexpr double Rounding = 4e-5; // of sums of floats, relative to 1
constexpr double Strict = 0.002;  // tolerance, which only samples come near to for gloss

/// The same of bytes.
int GetLargest(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b)
{
  int largest = a.size() == b.size() ? 0 : 255;
  for (std::size_t k = 0; largest < 255 && k < a.size(); ++k)
  {
    largest = std::max(largest, std::abs(int(a[k]) - int(b[k])));
  }
  return largest;
}

double GetSeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of linear radiance, relative L1.
double GetError(const FloatImage& picture, const FloatImage& whole)
{
  double error = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < whole.RGBA.size(); ++k)
  {
    if (k % 4 != 3)
    {
      error += std::abs(std::pow(picture.RGBA[k], 2.2) - std::pow(whole.RGBA[k], 2.2));
      sum += std::pow(whole.RGBA[k], 2.2);
    }
  }
  return error / sum;
}

constexpr int Subframes = 16; // as many as samples

/// A sphere before another one.
vtkSmartPointer<vtkPolyData> NewSpheres()
{
  vtkNew<vtkAppendPolyData> both;
  for (int k = 0; k < 2; ++k)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(0.5 * k - 0.2, 0.0, 0.6 * k);
    sphere->SetRadius(0.7 - 0.2 * k);
    sphere->SetThetaResolution(40);
    sphere->SetPhiResolution(40);
    both->AddInputConnection(sphere->GetOutputPort());
  }
  both->Update();
  return both->GetOutput();
}

class Samples : public MaterialMapping
{
protected:
  void SetUp() override
  {
    MaterialMapping::SetUp();
    if (IsSkipped())
    {
      return;
    }
    if (this->IsWithoutDisplay())
    {
      GTEST_SKIP() << "this window cannot be shown";
    }
    this->Window->SetOffScreenRendering(0);
    this->Filtered->SetNumberOfSamples(Subframes);
    this->Gloss->SetSpecular(0.4, 0.3, 0.2);
    this->Gloss->SetExponent(30.0);
    this->Mapper->SetInputData(NewSpheres());
    this->Mapper->SetIntegrator(this->Filtered);
    this->Mapper->SetBRDF(this->Gloss);
  }

  static std::vector<unsigned char> Read(vtkRenderWindow* window)
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    const int* size = window->GetSize();
    window->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 1, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  /// By a map of three materials.
  void DivideSheet()
  {
    this->Mapper->SetInputData(this->Sheet);
    this->AddMaterials(3);
    this->SetPoints([](vtkIdType k, int) { return (k / 3) % 3; });
    this->Mapper->SetMaterialMap(this->Map);
  }

  /// A screenshot, for which the filter renders.
  std::vector<unsigned char> ReadByFilter()
  {
    vtkNew<vtkWindowToImageFilter> reader;
    reader->SetInput(this->Window);
    reader->ReadFrontBufferOff();
    reader->Update();
    auto* bytes = static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer());
    return { bytes, bytes + 3 * Pixels * Pixels };
  }

  /// From now on somebody looks on.
  void LookOn()
  {
    this->Window->SetInteractor(this->Interactor);
    this->Window->SetDesiredUpdateRate(Hasty);
  }

  /// Of the same picture, which has not begun to add up.
  vtkSmartPointer<vtkMeasuredBRDFMapper> NewMapper()
  {
    auto other = vtkSmartPointer<vtkMeasuredBRDFMapper>::New();
    other->SetInputData(this->Mapper->GetInput());
    other->SetBRDF(this->Gloss);
    other->SetEnvironment(this->Environment);
    other->SetIntegrator(this->Filtered);
    return other;
  }

  /// Pictures until nothing is pending.
  template <typename SomeMapper>
  int DrawToTheEnd(SomeMapper* mapper)
  {
    int pictures = 0;
    do
    {
      this->Shown = this->RenderEncoded();
      ++pictures;
    } while (mapper->GetPlanPending() && pictures < 10 * Subframes);
    return pictures;
  }

  /// Sub-frames show the same in the end as all samples at once did.
  template <typename SomeMapper>
  void ExpectSame(SomeMapper* mapper, bool isPending = true)
  {
    const FloatImage whole = this->RenderEncoded();
    EXPECT_FALSE(mapper->GetPlanPending());
    this->LookOn();
    const FloatImage first = this->RenderEncoded();
    EXPECT_EQ(mapper->GetPlanPending(), isPending);
    EXPECT_EQ(GetLargestDifference(first, whole) > 10.0 * Rounding, isPending);
    EXPECT_EQ(this->DrawToTheEnd(mapper), isPending ? Subframes - 1 : 1);
    EXPECT_LT(GetLargestDifference(this->Shown, whole), Rounding);
  }

  vtkNew<vtkFilteredRadianceIntegrator> Filtered;
  vtkNew<vtkBlinnPhongBRDF> Gloss;
  vtkNew<Clock> Interactor;
  FloatImage Shown;
};
}

//------------------------------------------------------------------------------
TEST_F(Samples, ShowTheSameAsAllAtOnce)
{
  // The scene's lights, colors and a texture come on top.
  vtkNew<vtkLight> light;
  light->SetPosition(3.0, 2.0, 4.0);
  this->Renderer->AddLight(light);
  this->ExpectSame(this->Mapper.Get());
}

//------------------------------------------------------------------------------
// Pixels at edges have parts of several triangles, whose radiance is the pixel's.
TEST_F(Samples, ShowTheSameWithMultisamples)
{
  this->Window->SetMultiSamples(8);
  this->Renderer->SetPass(nullptr);
  this->Window->Render();
  const std::vector<unsigned char> whole = this->Read(this->Window);
  this->LookOn();
  do
  {
    this->Window->Render();
  } while (this->Mapper->GetPlanPending());
  const std::vector<unsigned char> added = this->Read(this->Window);
  double sum = 0.0;
  for (std::size_t k = 0; k < whole.size(); ++k)
  {
    sum += std::abs(int(whole[k]) - int(added[k]));
  }
  EXPECT_LT(sum / static_cast<double>(whole.size()), 0.3); // levels of 255
}

//------------------------------------------------------------------------------
TEST_F(Samples, ShowTheSameInTwoWindows)
{
  const FloatImage whole = this->RenderEncoded();
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<Clock> clock;
  window->SetMultiSamples(0);
  window->SetSize(48, 48);
  window->AddRenderer(renderer);
  window->SetDesiredUpdateRate(Hasty);
  renderer->SetAutomaticLightCreation(false);
  renderer->AddActor(this->Actor);
  renderer->SetActiveCamera(this->Renderer->GetActiveCamera());
  window->Render(); // a new renderer has its actors release all that they have
  const std::vector<unsigned char> alone = this->Read(window);
  window->SetInteractor(clock);
  this->LookOn();
  for (int k = 1; k < Subframes; ++k)
  {
    this->RenderEncoded();
    window->Render();
    EXPECT_TRUE(this->Mapper->GetPlanPending());
  }
  EXPECT_LT(GetLargestDifference(this->RenderEncoded(), whole), Rounding);
  EXPECT_TRUE(this->Mapper->GetPlanPending()) << "in the other window";
  window->Render();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
  EXPECT_LT(GetLargestDifference(this->RenderEncoded(), whole), Rounding);
  EXPECT_LE(GetLargest(this->Read(window), alone), 1);
}

//------------------------------------------------------------------------------
TEST_F(Samples, StayUnderPicking)
{
  const FloatImage whole = this->RenderEncoded();
  this->LookOn();
  this->RenderEncoded();
  this->Renderer->SetPass(nullptr);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Renderer);
  selector->SetArea(0, 0, Pixels - 1, Pixels - 1);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  EXPECT_GT(selection->GetNumberOfNodes(), 0u);
  EXPECT_TRUE(this->Mapper->GetPlanPending());
  EXPECT_LT(this->DrawToTheEnd(this->Mapper.Get()), Subframes);
  EXPECT_LT(GetLargestDifference(this->Shown, whole), Rounding);
}

//------------------------------------------------------------------------------
// What passes draw more than once is drawn with all samples.
TEST_F(Samples, ShowTheSameUnderShadowMaps)
{
  this->AddSceneLight(3.0, 2.0, 4.0, 40.0);
  vtkNew<vtkShadowMapPass> shadows;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkRenderPassCollection> passes;
  vtkNew<vtkSequencePass> sequence;
  passes->AddItem(this->Lights);
  passes->AddItem(opaque);
  sequence->SetPasses(passes);
  shadows->GetShadowMapBakerPass()->SetOpaqueSequence(sequence);
  shadows->SetOpaqueSequence(sequence);
  this->Passes->RemoveAllItems();
  this->Passes->AddItem(shadows->GetShadowMapBakerPass());
  this->Passes->AddItem(shadows);
  this->ExpectSame(this->Mapper.Get(), false);
}

//------------------------------------------------------------------------------
// So is what shows through, but not what a program's shaders do with the radiance afterwards.
TEST_F(Samples, ShowTheSameWhereTranslucentOrChanged)
{
  this->Actor->GetProperty()->SetOpacity(0.5);
  this->ExpectSame(this->Mapper.Get(), false);
  this->Actor->GetProperty()->SetOpacity(1.0);
  this->Window->SetInteractor(nullptr);
  this->Actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", false,
    "//VTK::Light::Impl\n  gl_FragData[0].rgb *= vec3(0.5, 0.7, 0.9);\n", false);
  this->ExpectSame(this->Mapper.Get());
}

//------------------------------------------------------------------------------
TEST_F(Samples, ShowTheSameWithOcclusion)
{
  this->Mapper->SetOcclusionModeToOn();
  this->ExpectSame(this->Mapper.Get());
}

//------------------------------------------------------------------------------
TEST_F(Samples, ShowTheSameOnMaterialMaps)
{
  this->DivideSheet();
  this->ExpectSame(this->Mapper.Get());
}

//------------------------------------------------------------------------------
// Parts, of which one is drawn by a table and one waits for its plan.
TEST_F(Samples, ShowTheSameOnPartsWithPlans)
{
  vtkNew<vtkLambertBRDF> matte;
  vtkNew<vtkBlinnPhongBRDF> changing;
  changing->SetExponent(30.0);
  this->Map->AddMaterial(matte);
  this->Map->AddMaterial(this->Gloss);
  this->Map->AddMaterial(changing);
  this->SetPoints([](vtkIdType k, int) { return (k / 3) % 3; });
  const auto draw = [&](vtkMeasuredBRDFMapper* mapper)
  {
    mapper->SetInputData(this->Sheet);
    mapper->SetMaterialMap(this->Map);
    mapper->SetIntegrator(nullptr);
    mapper->SetErrorTolerance(Strict);
    this->Actor->SetMapper(mapper);
    do
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(20)); // which the plan's threads have
      this->Shown = this->RenderEncoded();
    } while (mapper->GetPlanPending());
    return this->Shown;
  };
  this->Mapper->SetPlanningModeToBackgroundFromStart();
  this->Window->SetInteractor(this->Interactor);
  for (const double specular : { 0.1, 0.3 })
  {
    changing->SetSpecular(specular, 0.2, 0.2);
    this->Renderer->GetActiveCamera()->Azimuth(10.0); // the others add up again
    const FloatImage added = draw(this->Mapper);
    EXPECT_NE(this->Mapper->GetPlan().find("table, "), std::string::npos);
    EXPECT_NE(this->Mapper->GetPlan().find("filtered, "), std::string::npos);
    this->Window->SetInteractor(nullptr);
    EXPECT_LT(GetLargestDifference(added, draw(this->NewMapper())), Rounding);
    this->Window->SetInteractor(this->Interactor);
  }
}

//------------------------------------------------------------------------------
// Where a frame has time for all samples, and it is known how long they take.
TEST_F(Samples, AreDrawnWhileOneInteracts)
{
  this->Window->SetSize(8, 8);
  this->Window->SetInteractor(this->Interactor);
  this->Mapper->SetIntegrator(nullptr);
  this->Mapper->SetErrorTolerance(Strict);
  const auto isDrawn = [this](double rate)
  {
    this->Renderer->GetActiveCamera()->Azimuth(1.0);
    this->Window->SetDesiredUpdateRate(rate);
    this->DrawToTheEnd(this->Mapper.Get());
    return this->Mapper->GetCurrentIntegrator()->GetMethodName() == "filtered";
  };
  EXPECT_FALSE(isDrawn(1.0)) << "it is not known";
  EXPECT_TRUE(isDrawn(Still));
  EXPECT_TRUE(isDrawn(Still)) << "without the time to compile shaders";
  EXPECT_TRUE(isDrawn(1.0));
  EXPECT_FALSE(isDrawn(Hasty));
  EXPECT_TRUE(isDrawn(1.0)) << "it is still known";
  EXPECT_FALSE(isDrawn(Hasty));
  EXPECT_TRUE(isDrawn(Still));
  this->Mapper->SetMaximumCost(4.0);
  EXPECT_FALSE(isDrawn(Still));
  EXPECT_NE(this->Mapper->GetPlan().find("costs more than MaximumCost"), std::string::npos);
}

//------------------------------------------------------------------------------
TEST_F(Samples, ShowTheSameOnMixtures)
{
  this->Mapper->SetInputData(this->Sheet);
  this->AddMaterials(3);
  this->SetPoints([](vtkIdType k, int c) { return 1.0 + (k + c) % 3; }, 3);
  this->Map->SetModeToWeights();
  this->Mapper->SetMaterialMap(this->Map);
  this->ExpectSame(this->Mapper.Get());
}

//------------------------------------------------------------------------------
TEST_F(Samples, ShowTheSameOnComposites)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, NewSpheres());
  blocks->SetBlock(1, this->Sheet);
  vtkNew<vtkCompositeMeasuredBRDFMapper> composite;
  vtkNew<vtkLambertBRDF> white;
  composite->SetInputDataObject(blocks);
  composite->SetBRDF(this->Gloss);
  composite->SetBlockBRDF(2, white);
  composite->SetEnvironment(this->Environment);
  composite->SetIntegrator(this->Filtered);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  composite->SetCompositeDataDisplayAttributes(attributes);
  this->Actor->SetMapper(composite);
  this->ExpectSame(composite.Get());

  // A translucent block beside opaque ones.
  this->Window->SetInteractor(nullptr);
  attributes->SetBlockOpacity(this->Sheet, 0.5);
  composite->Modified();
  this->LookOn();
  EXPECT_EQ(this->DrawToTheEnd(composite.Get()), Subframes);
}

//------------------------------------------------------------------------------
TEST_F(Samples, BeginAnewWhenTheViewChanges)
{
  this->LookOn();
  for (int k = 0; k < 5; ++k)
  {
    this->RenderEncoded();
  }
  for (const bool camera : { true, false })
  {
    if (camera)
    {
      this->Renderer->GetActiveCamera()->Azimuth(20.0);
    }
    else
    {
      this->Gloss->SetSpecular(0.1, 0.5, 0.3);
    }
    EXPECT_EQ(this->DrawToTheEnd(this->Mapper.Get()), Subframes);
    const auto other = this->NewMapper();
    this->Actor->SetMapper(other);
    this->Window->SetInteractor(nullptr);
    EXPECT_LT(GetLargestDifference(this->Shown, this->RenderEncoded()), Rounding);
    this->Actor->SetMapper(this->Mapper);
    this->Window->SetInteractor(this->Interactor);
  }
}

//------------------------------------------------------------------------------
// Whoever draws while samples are pending comes to an end. A second view looks away.
TEST_F(Samples, AreNotWaitedForOutOfView)
{
  this->LookOn();
  vtkNew<vtkRenderer> away;
  away->AddActor(this->Actor);
  away->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0);
  away->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 10.0);
  away->SetViewport(0.0, 0.0, 0.2, 0.2);
  this->Window->AddRenderer(away);
  this->Window->Render();
  EXPECT_TRUE(this->Mapper->GetPlanPending()) << "the view that sees it goes on";
  this->Actor->SetPosition(1000.0, 0.0, 0.0);
  this->Window->Render();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
  this->Actor->SetPosition(0.0, 0.0, 0.0);
  this->Window->Render();
  EXPECT_TRUE(this->Mapper->GetPlanPending());
  this->Window->RemoveRenderer(away);
}

//------------------------------------------------------------------------------
TEST_F(Samples, TimersDrawTheNextPicture)
{
  this->LookOn();
  this->RenderEncoded();
  int fired = 0;
  while (this->Mapper->GetPlanPending() && this->Interactor->Fire())
  {
    ++fired;
  }
  EXPECT_EQ(fired, Subframes - 1);
  EXPECT_FALSE(this->Mapper->GetPlanPending());
}

//------------------------------------------------------------------------------
// The first picture of a view, too.
TEST_F(Samples, PicturesThatTheFilterReadsWait)
{
  this->Renderer->SetPass(nullptr);
  this->LookOn();
  this->Interactor->Initialize();
  const std::vector<unsigned char> screenshot = this->ReadByFilter();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
  this->Actor->SetMapper(this->NewMapper());
  this->Window->SetInteractor(nullptr);
  EXPECT_LE(GetLargest(screenshot, this->ReadByFilter()), 1);
}

//------------------------------------------------------------------------------
TEST_F(Samples, PicturesThatAreReadWait)
{
  this->Renderer->SetPass(nullptr);
  this->DivideSheet();
  this->Window->Render();
  const std::vector<unsigned char> whole = this->ReadByFilter();
  this->LookOn();
  this->Window->Render();
  EXPECT_TRUE(this->Mapper->GetPlanPending());
  const std::vector<unsigned char> screenshot = this->ReadByFilter();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
  EXPECT_LE(GetLargest(whole, screenshot), 1);

  this->Renderer->GetActiveCamera()->Azimuth(10.0);
  this->Window->Render();
  EXPECT_TRUE(this->Mapper->GetPlanPending()) << "after a screenshot as before";
  this->Window->SwapBuffersOff();
  this->Window->Render();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
}

//------------------------------------------------------------------------------
// What is drawn off screen is whole, and can be aborted where somebody looks after that.
TEST_F(Samples, StopAndGoOn)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetDesiredUpdateRate(Hasty);
  const FloatImage whole = this->RenderEncoded();
  vtkNew<vtkCallbackCommand> nothing;
  nothing->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  this->Window->AddObserver(vtkCommand::AbortCheckEvent, nothing);
  vtkNew<vtkCallbackCommand> abort; // when Render has begun, which clears it
  abort->SetClientData(this->Window);
  abort->SetCallback([](vtkObject*, unsigned long, void* window, void*)
    { static_cast<vtkRenderWindow*>(window)->SetAbortRender(1); });
  const unsigned long tag = this->Mapper->AddObserver(vtkCommand::EndEvent, abort);
  for (int k = 1; k < Subframes; ++k)
  {
    this->RenderEncoded();
    ASSERT_TRUE(this->Mapper->GetPlanPending()) << k; // a sub-frame each
  }
  this->Mapper->RemoveObserver(tag);
  this->RenderEncoded();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
  EXPECT_LT(GetLargestDifference(this->RenderEncoded(), whole), Rounding);
}

//------------------------------------------------------------------------------
// After each sub-frame, which has as many samples as take a tenth of a second or a frame's time,
// one to begin with.
TEST_F(Samples, AskOftenWhetherToStop)
{
  this->Window->SetOffScreenRendering(1);
  this->Window->SetSize(160, 160);
  double asked[3]; // when last; the longest time from one to the next; how often
  vtkNew<vtkCallbackCommand> ask;
  ask->SetClientData(asked);
  ask->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*)
    {
      auto* values = static_cast<double*>(data);
      const double now = GetSeconds();
      values[1] = std::max(values[1], now - values[0]);
      values[0] = now;
      ++values[2];
    });
  this->Window->AddObserver(vtkCommand::AbortCheckEvent, ask);
  for (const auto& [samples, rate] : { std::pair(Subframes, Hasty), std::pair(256, Still) })
  {
    this->Filtered->SetNumberOfSamples(samples);
    this->Window->SetDesiredUpdateRate(rate);
    asked[0] = GetSeconds();
    asked[1] = asked[2] = 0.0;
    this->RenderEncoded();
    EXPECT_FALSE(this->Mapper->GetPlanPending());
    EXPECT_GE(asked[2], rate == Hasty ? samples - 1 : 1);
  }
}
