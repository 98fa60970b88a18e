// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What benchmarks of frames draw: a window that a sphere fills, VTK's PBR under an environment,
 * materials, and spheres with bumps.
 */

#ifndef FrameScene_h
#define FrameScene_h

#include "vtkActor.h"
#include "vtkBasisBRDF.h"
#include "vtkBasisProjector.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCamera.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkLambertBRDF.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"
#include "vtkTexture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

/// One for each picture: no state of one slows another. The mapper and the light are the program's,
/// and so is the clipping range.
struct FrameScene
{
  FrameScene(int width, int height, double radius)
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(width, height);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetAutomaticLightCreation(false);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(radius);
    camera->SetPosition(0.0, 0.0, 4.0 * radius + 1.0);
  }

  /// VTK's PBR and image-based light.
  void ShadeByPBR(vtkEnvironment* environment)
  {
    this->Actor->GetProperty()->SetInterpolationToPBR();
    this->Actor->GetProperty()->SetMetallic(0.7);
    this->Actor->GetProperty()->SetRoughness(0.3);
    const auto image = vtkSmartPointer<vtkImageData>::Take(environment->NewImageData());
    vtkNew<vtkTexture> texture;
    texture->SetInputData(image);
    texture->SetColorModeToDirectScalars();
    texture->MipmapOn();
    texture->InterpolateOn();
    this->Renderer->UseImageBasedLightingOn();
    this->Renderer->SetEnvironmentTexture(texture);
  }

  /// Milliseconds by the clock until the frame is drawn.
  double Draw()
  {
    const auto begin = std::chrono::steady_clock::now();
    this->Window->Render();
    this->Window->WaitForCompletion();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
  }

  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window; // goes first
};

inline double GetMedian(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline vtkSmartPointer<vtkBRDF> GetEmbedded(const std::string& name)
{
  return vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
}

/// MERL's size; values do not matter for the time.
inline vtkSmartPointer<vtkBRDF> MakeLargeTable()
{
  const int dimensions[3] = { 180, 90, 90 };
  std::vector<float> rgb(3 * 180 * 90 * 90);
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    rgb[k] = 0.1f + 0.05f * std::sin(0.001f * static_cast<float>(k));
  }
  auto brdf = vtkSmartPointer<vtkTabulatedBRDF>::New();
  brdf->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, std::move(rgb));
  return brdf;
}

/// The thesis's functions, (order + 1)^2 of them.
inline vtkSmartPointer<vtkBRDF> MakeBasis(int order)
{
  const auto fabric = GetEmbedded("blue-fabric");
  vtkNew<vtkBasisProjector> projector;
  projector->SetInput(fabric);
  projector->SetBasis(vtkBasisBRDF::SPHERICAL_HARMONICS);
  projector->SetOrder(order);
  projector->Project();
  return projector->GetOutput();
}

/// Materials that differ. exponent: of the gloss of each.
template <typename Exponent>
std::vector<vtkSmartPointer<vtkBRDF>> MakeMaterials(int count, const Exponent& exponent)
{
  std::vector<vtkSmartPointer<vtkBRDF>> materials;
  for (int k = 0; k < count; ++k)
  {
    vtkNew<vtkLambertBRDF> base;
    base->SetAlbedo(0.1 + 0.8 * k / count, 0.3, 0.2);
    vtkNew<vtkBlinnPhongBRDF> gloss;
    gloss->SetSpecular(0.1, 0.1, 0.1);
    gloss->SetExponent(exponent(k));
    vtkNew<vtkSumBRDF> material;
    material->AddTerm(base);
    material->AddTerm(gloss);
    materials.push_back(material.Get());
  }
  return materials;
}

/// By default of 64,000 triangles.
inline vtkSmartPointer<vtkPolyData> MakeSphere(double radius, int resolution = 180)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  sphere->SetRadius(radius);
  sphere->Update();
  return sphere->GetOutput();
}

/// A sphere of half a million triangles, with bumps: their depth, and turns (radians per length)
/// across and along z.
inline vtkSmartPointer<vtkPolyData> MakeBumps(
  double radius, double depth, double across, double along)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(500);
  sphere->SetPhiResolution(502);
  sphere->SetRadius(radius);
  sphere->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->DeepCopy(sphere->GetOutput());
  vtkPoints* points = surface->GetPoints();
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
  {
    double p[3];
    points->GetPoint(k, p);
    const double bump = std::sin(across * p[0]) * std::sin(across * p[1]) + std::sin(along * p[2]);
    vtkMath::MultiplyScalar(p, 1.0 - depth * bump);
    points->SetPoint(k, p);
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SplittingOff();
  normals->Update();
  return normals->GetOutput();
}

#endif
