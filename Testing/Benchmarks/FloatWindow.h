// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An offscreen window with a float framebuffer that shows one surface, z up, and its pixels' rays.
 */

#ifndef FloatWindow_h
#define FloatWindow_h

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkFramebufferPass.h"
#include "vtkImageData.h"
#include "vtkLightsPass.h"
#include "vtkNew.h"
#include "vtkOpaquePass.h"
#include "vtkPNGWriter.h"
#include "vtkPixelBufferObject.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderPass.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkTextureObject.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

struct FloatPicture
{
  int Size = 0;
  std::vector<float> Encoded; // RGBA, x^(1/2.2)

  glm::dvec3 Get(int x, int y) const
  {
    const float* at = &this->Encoded[4 * static_cast<std::size_t>(y * this->Size + x)];
    return { std::pow(at[0], 2.2), std::pow(at[1], 2.2), std::pow(at[2], 2.2) };
  }

  void Write(const std::string& file) const
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(this->Size, this->Size, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
    for (std::size_t k = 0; k < this->Encoded.size() / 4; ++k)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        bytes[3 * k + c] = static_cast<unsigned char>(
          255.0f * std::clamp(this->Encoded[4 * k + c], 0.0f, 1.0f) + 0.5f);
      }
    }
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(file.c_str());
    writer->Write();
  }
};

class FloatWindow
{
public:
  static constexpr int Side = 500;

  FloatWindow(vtkPolyDataMapper* mapper, vtkPolyData* surface)
  {
    this->Actor->SetMapper(mapper);
    this->Renderer->SetAutomaticLightCreation(false);
    this->Renderer->SetEnvironmentUp(0.0, 1.0, 0.0);
    this->Renderer->AddActor(this->Actor);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Side, Side);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    double bounds[6];
    surface->GetBounds(bounds);
    const double center[3] = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
      0.5 * (bounds[4] + bounds[5]) };
    const double size =
      std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
    camera->SetFocalPoint(center);
    camera->SetPosition(center[0] + 0.9 * size, center[1] + 0.8 * size, center[2] + 1.3 * size);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetViewAngle(32.0);
    camera->SetClippingRange(0.1 * size, 10.0 * size);
    this->Passes->AddItem(this->Lights);
    this->Passes->AddItem(this->Opaque);
    this->Sequence->SetPasses(this->Passes);
    this->CameraPass->SetDelegatePass(this->Sequence);
    this->Framebuffer->SetDelegatePass(this->CameraPass);
    this->Framebuffer->SetColorFormat(vtkTextureObject::Float32);
    this->Renderer->SetPass(this->Framebuffer);
  }

  int GetSize() const { return Side; }

  /// Ends when the frame is done.
  void Draw()
  {
    this->Window->Render();
    this->Window->WaitForCompletion();
  }

  FloatPicture Render()
  {
    this->Draw();
    vtkTextureObject* color = this->Framebuffer->GetColorTexture();
    vtkPixelBufferObject* buffer = color->Download();
    const int components = color->GetComponents();
    std::vector<float> raw(static_cast<std::size_t>(components * Side * Side));
    unsigned int dimensions[2] = { color->GetWidth(), color->GetHeight() };
    vtkIdType increments[2] = { 0, 0 };
    buffer->Download2D(VTK_FLOAT, raw.data(), dimensions, components, increments);
    buffer->Delete();
    FloatPicture picture;
    picture.Size = Side;
    picture.Encoded.resize(static_cast<std::size_t>(4 * Side * Side), 1.0f);
    for (int k = 0; k < Side * Side; ++k)
    {
      for (int c = 0; c < std::min(components, 3); ++c)
      {
        picture.Encoded[static_cast<std::size_t>(4 * k + c)] =
          raw[static_cast<std::size_t>(components * k + c)];
      }
    }
    return picture;
  }

  /// Through the middle of a pixel, from the camera.
  void GetRay(int x, int y, double origin[3], double direction[3])
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    glm::dvec3 eye, focus, up;
    camera->GetPosition(&eye.x);
    camera->GetFocalPoint(&focus.x);
    camera->GetViewUp(&up.x);
    const glm::dvec3 forward = glm::normalize(focus - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    const double scale = std::tan(0.5 * camera->GetViewAngle() * 3.14159265358979 / 180.0);
    const glm::dvec3 d =
      forward + scale * ((2.0 * (x + 0.5) / Side - 1.0) * right +
                          (2.0 * (y + 0.5) / Side - 1.0) * glm::cross(right, forward));
    std::copy_n(&eye.x, 3, origin);
    std::copy_n(&d.x, 3, direction);
  }

private:
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkLightsPass> Lights;
  vtkNew<vtkOpaquePass> Opaque;
  vtkNew<vtkRenderPassCollection> Passes;
  vtkNew<vtkSequencePass> Sequence;
  vtkNew<vtkCameraPass> CameraPass;
  vtkNew<vtkFramebufferPass> Framebuffer;
};

#endif
