// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An offscreen window with a 32-bit float framebuffer: what the mapper writes, before any clamping.
 */

#ifndef RenderFixture_h
#define RenderFixture_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkFramebufferPass.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPixelBufferObject.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkTextureObject.h"
#include "vtkTranslucentPass.h"
#include "vtkVersionMacros.h"

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <gtest/gtest.h>

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

class RenderFixture : public ::testing::Test
{
protected:
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
