// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An offscreen window with a 32-bit float framebuffer: what the mapper writes, before any clamping.
 * And the headers that most tests of pictures need.
 */

#ifndef RenderFixture_h
#define RenderFixture_h

#include "vtkActor.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkFloatArray.h"
#include "vtkFramebufferPass.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkLambertBRDF.h"
#include "vtkLight.h"
#include "vtkLightsPass.h"
#include "vtkMaterialMap.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPixelBufferObject.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTableRadianceIntegrator.h"
#include "vtkTexture.h"
#include "vtkTextureObject.h"
#include "vtkTranslucentPass.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVersionMacros.h"
#include "vtkWeakPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// Counts an object's events of a kind, and keeps their texts.
struct EventCounter
{
  EventCounter(vtkObject* object, unsigned long event)
    : Object(object)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        auto* counter = static_cast<EventCounter*>(self);
        ++counter->Count;
        counter->Text = text ? static_cast<const char*>(text) : "";
        counter->Texts.push_back(counter->Text);
      });
    this->Tag = object->AddObserver(event, this->Command);
  }
  ~EventCounter()
  {
    if (this->Object)
    {
      this->Object->RemoveObserver(this->Tag);
    }
  }
  EventCounter(const EventCounter&) = delete;
  void operator=(const EventCounter&) = delete;

  int Count = 0;
  std::string Text; // the last one
  std::vector<std::string> Texts;

private:
  vtkNew<vtkCallbackCommand> Command;
  vtkWeakPointer<vtkObject> Object;
  unsigned long Tag;
};

/// Of all threads of the program, in seconds.
inline double GetProcessorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Linear RGB and alpha of every pixel, rows from the bottom.
struct FloatImage
{
  int Width = 0;
  int Height = 0;
  std::vector<float> RGBA;

  const float* At(int x, int y) const { return &this->RGBA[4 * (y * this->Width + x)]; }
};

inline double GetLargestDifference(const FloatImage& a, const FloatImage& b)
{
  double largest = a.RGBA.size() == b.RGBA.size() ? 0.0 : 1e30;
  for (std::size_t k = 0; largest < 1e30 && k < a.RGBA.size(); ++k)
  {
    largest = std::max<double>(largest, std::abs(a.RGBA[k] - b.RGBA[k]));
  }
  return largest;
}

/// The radiance that an integrator finds for one normal, view and, if there is one, tangent.
inline std::array<double, 3> IntegrateOne(vtkRadianceIntegrator* integrator, const double normal[3],
  const double view[3], const double* tangent = nullptr)
{
  vtkNew<vtkDoubleArray> arrays[3];
  vtkNew<vtkDoubleArray> radiance;
  const double* const values[3] = { normal, view, tangent };
  for (int k = 0; k < 3; ++k)
  {
    arrays[k]->SetNumberOfComponents(3);
    if (values[k])
    {
      arrays[k]->InsertNextTuple(values[k]);
    }
  }
  EXPECT_TRUE(
    integrator->Integrate(arrays[0], arrays[1], radiance, tangent ? arrays[2].Get() : nullptr));
  std::array<double, 3> rgb{};
  radiance->GetTuple(0, rgb.data());
  return rgb;
}

class RenderFixture : public ::testing::Test
{
protected:
  /// What a test draws; called where there is a window.
  virtual void SetUpScene() {}

  void SetUp() override
  {
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
    if (!std::getenv("DISPLAY"))
    {
      GTEST_SKIP() << "this VTK needs an X display (run under xvfb-run)";
    }
#endif
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(64, 64);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetAutomaticLightCreation(false);
    this->Renderer->GetActiveCamera()->ParallelProjectionOn();
    this->Renderer->GetActiveCamera()->SetParallelScale(1.0);
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0);
    this->Renderer->GetActiveCamera()->SetClippingRange(0.1, 20.0);

    this->Passes->AddItem(this->Lights);
    this->Passes->AddItem(this->Opaque);
    this->Passes->AddItem(this->Translucent);
    this->Sequence->SetPasses(this->Passes);
    this->CameraPass->SetDelegatePass(this->Sequence);
    this->Framebuffer->SetDelegatePass(this->CameraPass);
    this->Framebuffer->SetColorFormat(vtkTextureObject::Float32);
    this->SetUpScene();
  }

  /// A new light of the renderer, at the camera.
  vtkSmartPointer<vtkLight> AddHeadlight(
    double intensity = 1.0, double red = 1.0, double green = 1.0, double blue = 1.0)
  {
    auto light = vtkSmartPointer<vtkLight>::New();
    light->SetLightTypeToHeadlight();
    light->SetIntensity(intensity);
    light->SetDiffuseColor(red, green, blue);
    this->Renderer->AddLight(light);
    return light;
  }

  /// A new light of the renderer that shines from a place towards the origin: from far away, or
  /// from that very place, into a cone (180: everywhere).
  vtkSmartPointer<vtkLight> AddSceneLight(double x, double y, double z, double coneAngle = 0.0)
  {
    auto light = vtkSmartPointer<vtkLight>::New();
    light->SetLightTypeToSceneLight();
    light->SetPosition(x, y, z);
    light->SetPositional(coneAngle > 0.0);
    light->SetConeAngle(coneAngle > 0.0 ? coneAngle : 30.0);
    this->Renderer->AddLight(light);
    return light;
  }

  /// VTK's windows that need no display (9.6): no interactor works there, and resources that are
  /// released with another window leave that window's context current, of VTK's own mapper, too.
  bool IsWithoutDisplay() const
  {
    return std::string(this->Window->GetClassName()) == "vtkEGLRenderWindow";
  }

  /// The steps of the weights by which texture units interpolate: those of graphics cards, 2^-8,
  /// the coarsest that Direct3D allows. Mesa's llvmpipe has a float's: 0.
  double GetWeightStep()
  {
    if (this->WeightStep < 0.0)
    {
      this->Window->Render(); // makes the context
      const std::string report = this->Window->ReportCapabilities();
      this->WeightStep = report.find("llvmpipe") == std::string::npos ? std::exp2(-8.0) : 0.0;
    }
    return this->WeightStep;
  }

  /// What the shader wrote, still encoded as x^(1/2.2).
  FloatImage RenderEncoded()
  {
    this->Renderer->SetPass(this->Framebuffer);
    this->Window->Render();
    vtkTextureObject* color = this->Framebuffer->GetColorTexture();
    FloatImage image;
    image.Width = static_cast<int>(color->GetWidth());
    image.Height = static_cast<int>(color->GetHeight());
    vtkPixelBufferObject* buffer = color->Download();
    const int components = color->GetComponents();
    std::vector<float> raw(static_cast<std::size_t>(components) * image.Width * image.Height);
    unsigned int dimensions[2] = { color->GetWidth(), color->GetHeight() };
    vtkIdType increments[2] = { 0, 0 };
    buffer->Download2D(VTK_FLOAT, raw.data(), dimensions, components, increments);
    buffer->Delete();
    image.RGBA.resize(4 * static_cast<std::size_t>(image.Width) * image.Height, 1.0f);
    for (int k = 0; k < image.Width * image.Height; ++k)
    {
      for (int c = 0; c < components; ++c)
      {
        image.RGBA[4 * k + c] = raw[components * k + c];
      }
    }
    return image;
  }

  /// The same, linear.
  FloatImage RenderLinear()
  {
    FloatImage image = this->RenderEncoded();
    for (std::size_t k = 0; k < image.RGBA.size(); ++k)
    {
      if (k % 4 != 3)
      {
        image.RGBA[k] = std::pow(image.RGBA[k], 2.2f);
      }
    }
    return image;
  }

  double WeightStep = -1.0; // GetWeightStep, before it was asked for
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderPassCollection> Passes;
  vtkNew<vtkLightsPass> Lights;
  vtkNew<vtkOpaquePass> Opaque;
  vtkNew<vtkTranslucentPass> Translucent;
  vtkNew<vtkSequencePass> Sequence;
  vtkNew<vtkCameraPass> CameraPass;
  vtkNew<vtkFramebufferPass> Framebuffer;
};

#endif
