// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Samples that are drawn in sub-frames: in the end the picture of all samples, whatever it is drawn
// with, and never a part of it where somebody reads it.
#include "MaterialMapFixture.h"

#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkFilteredRadianceIntegrator.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkPlaneSource.h"
#include "vtkProperty.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSelection.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <cstdio>

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
constexpr double Hasty = 1e9;     // so that each picture has time for one sub-frame
constexpr double Rounding = 4e-5; // of sums of floats, relative to 1

double GetDifference(const FloatImage& a, const FloatImage& b)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < a.RGBA.size() && a.RGBA.size() == b.RGBA.size(); ++k)
  {
    largest = std::max<double>(largest, std::abs(a.RGBA[k] - b.RGBA[k]));
  }
  return a.RGBA.size() == b.RGBA.size() ? largest : 1e30;
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

constexpr int Subframes = 16; // of 64 samples

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
    this->Filtered->SetNumberOfSamples(4 * Subframes);
    this->Gloss->SetSpecular(0.4, 0.3, 0.2);
    this->Gloss->SetExponent(30.0);
    this->Mapper->SetInputData(NewSpheres());
    this->Mapper->SetIntegrator(this->Filtered);
    this->Mapper->SetBRDF(this->Gloss);
  }

  /// From now on somebody looks on.
  void LookOn()
  {
    this->Window->SetInteractor(this->Interactor);
    this->Window->SetDesiredUpdateRate(Hasty);
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
    EXPECT_EQ(GetDifference(first, whole) > 10.0 * Rounding, isPending);
    EXPECT_EQ(this->DrawToTheEnd(mapper), isPending ? Subframes - 1 : 1);
    EXPECT_LT(GetDifference(this->Shown, whole), Rounding);
  }

  vtkNew<vtkFilteredRadianceIntegrator> Filtered;
  vtkNew<vtkBlinnPhongBRDF> Gloss;
  vtkNew<Clock> Interactor;
  FloatImage Shown;
};
}

//------------------------------------------------------------------------------
TEST_F(Samples, Converge)
{
  const auto nickel = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("nickel"));
  const auto hall =
    vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("hall"));
  this->Mapper->SetBRDF(nickel);
  this->Mapper->SetEnvironment(hall);
  const FloatImage whole = this->RenderEncoded();
  this->LookOn();
  std::vector<double> errors;
  do
  {
    errors.push_back(GetError(this->RenderEncoded(), whole));
    std::printf("%zu sub-frames: %.4f\n", errors.size(), errors.back());
  } while (this->Mapper->GetPlanPending() && errors.size() < 2 * Subframes);
  ASSERT_EQ(errors.size(), Subframes);
  EXPECT_LT(errors[0], 0.5);
  EXPECT_LT(errors[3], 0.2);
  EXPECT_LT(errors[Subframes / 2], 0.1);
  EXPECT_LT(errors.back(), Rounding);
  // What is kept stays.
  EXPECT_LT(GetError(this->RenderEncoded(), whole), Rounding);
  EXPECT_FALSE(this->Mapper->GetPlanPending());
}

//------------------------------------------------------------------------------
// With multisamples edges have parts of several surfaces.
TEST_F(Samples, ShowTheSameAsAllAtOnce) { this->ExpectSame(this->Mapper.Get()); }

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
    vtkNew<vtkMeasuredBRDFMapper> other;
    other->ShallowCopy(this->Mapper);
    this->Actor->SetMapper(other);
    this->Window->SetInteractor(nullptr);
    EXPECT_LT(GetDifference(this->Shown, this->RenderEncoded()), Rounding);
    this->Actor->SetMapper(this->Mapper);
    this->Window->SetInteractor(this->Interactor);
  }
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
TEST_F(Samples, PicturesThatAreReadWait)
{
  this->Renderer->SetPass(nullptr);
  const auto read = [this]()
  {
    vtkNew<vtkWindowToImageFilter> reader;
    reader->SetInput(this->Window);
    reader->ReadFrontBufferOff();
    reader->Update();
    auto* bytes = static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer());
    return std::vector<unsigned char>(bytes, bytes + 3 * Pixels * Pixels);
  };
  this->Window->Render();
  const std::vector<unsigned char> whole = read();
  this->LookOn();
  this->Window->Render();
  EXPECT_TRUE(this->Mapper->GetPlanPending());
  const std::vector<unsigned char> screenshot = read();
  EXPECT_FALSE(this->Mapper->GetPlanPending());
  int largest = 0;
  for (std::size_t k = 0; k < whole.size(); ++k)
  {
    largest = std::max(largest, std::abs(int(whole[k]) - int(screenshot[k])));
  }
  EXPECT_LE(largest, 1);

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
  EXPECT_LT(GetDifference(this->RenderEncoded(), whole), Rounding);
}
