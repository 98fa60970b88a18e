// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A stock actor with the fitted property, drawn by VTK's own shading, against the measured
// material.
#include "RenderFixture.h"

#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkPBRPropertyFitter.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"

#include <cstdio>

class FittedProperty : public RenderFixture
{
protected:
  /// Mean |a - b| over mean b of what both cover.
  static double Compare(const FloatImage& a, const FloatImage& b)
  {
    double difference = 0.0;
    double sum = 0.0;
    for (int y = 0; y < b.Height; ++y)
    {
      for (int x = 0; x < b.Width; ++x)
      {
        const double dx = 2.0 * (x + 0.5) / b.Width - 1.0;
        const double dy = 2.0 * (y + 0.5) / b.Height - 1.0;
        for (int c = 0; c < 3 && dx * dx + dy * dy < 0.9; ++c) // the rim is not the material's
        {
          difference += std::abs(a.At(x, y)[c] - b.At(x, y)[c]);
          sum += b.At(x, y)[c];
        }
      }
    }
    return difference / sum;
  }
};

TEST_F(FittedProperty, IsNearerThanTheDefault)
{
  if (this->IsSkipped())
  {
    return;
  }
  constexpr int height = 128;
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < 2 * height; ++x)
    {
      double d[3];
      vtkEnvironment::GetDirection((x + 0.5) / (2 * height), (y + 0.5) / height, d);
      pixels.insert(
        pixels.end(), 3, static_cast<float>(vtkPBRPropertyFitter::GetNeutralRadiance(d)));
    }
  }
  vtkNew<vtkEnvironment> environment;
  ASSERT_TRUE(environment->SetPixels(2 * height, height, std::move(pixels)));
  const auto image = vtkSmartPointer<vtkImageData>::Take(environment->NewImageData());
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  texture->MipmapOn();
  texture->InterpolateOn();
  this->Renderer->UseImageBasedLightingOn();
  this->Renderer->SetEnvironmentTexture(texture);
  // The light is smooth; VTK's 1024 samples take long on a software renderer.
  auto* renderer = vtkOpenGLRenderer::SafeDownCast(this->Renderer);
  ASSERT_TRUE(renderer);
  renderer->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(128);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(96);
  sphere->SetPhiResolution(96);
  vtkNew<vtkMeasuredBRDFMapper> measured;
  measured->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkOpenGLPolyDataMapper> stock;
  stock->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  this->Renderer->AddActor(actor);
  for (const char* name : { "gold-paint", "pink-felt", "nickel", "blue-car-paint" })
  {
    const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    measured->SetBRDF(brdf);
    actor->SetMapper(measured);
    vtkNew<vtkProperty> property;
    actor->SetProperty(property);
    const FloatImage exact = this->RenderLinear();

    actor->SetMapper(stock);
    property->SetInterpolationToPBR();
    const double plain = Compare(this->RenderLinear(), exact);
    const double promised = vtkPBRPropertyFitter::Fit(brdf, property);
    const double fitted = Compare(this->RenderLinear(), exact);
    std::printf(
      "%s: default %.3f, fitted %.3f, error returned %.3f\n", name, plain, fitted, promised);
    EXPECT_LT(fitted, 0.4 * plain) << name;
    EXPECT_LT(fitted, 0.5) << name;
  }
}

TEST_F(FittedProperty, ByTheMapper)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  vtkNew<vtkProperty> property;
  EXPECT_LT(mapper->FitProperty(property), 0.0);
  EXPECT_EQ(property->GetInterpolation(), VTK_GOURAUD);
  mapper->SetBRDF(brdf);
  EXPECT_LT(mapper->FitProperty(nullptr), 0.0);
  const double error = mapper->FitProperty(property);
  EXPECT_GT(error, 0.0);
  EXPECT_LT(error, 0.06);
  EXPECT_EQ(property->GetInterpolation(), VTK_PBR);
}
