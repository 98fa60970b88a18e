// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Nine embedded materials on spheres, lit by the built-in sky through the renderer's environment
// texture: the way a scene made for VTK's PBR switches to measured materials.

#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkCamera.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"

int TestMeasuredMaterialsUnderSky(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(240, 240);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  renderer->SetBackground(0.2, 0.2, 0.22);
  renderer->SetAutomaticLightCreation(false);

  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  auto image = vtkSmartPointer<vtkImageData>::Take(sky->NewImageData());
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  renderer->SetEnvironmentTexture(texture);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  sphere->SetRadius(0.47);
  vtkNew<vtkLightSetRadianceIntegrator> lights;
  lights->SetGenerator(vtkNew<vtkLightSetGenerator>());
  const char* names[] = { "blue-fabric", "pink-fabric2", "gold-paint", "green-metallic-paint",
    "violet-rubber", "red-fabric2", "silver-metallic-paint", "pink-felt", "cherry-235" };
  for (int k = 0; k < 9; ++k)
  {
    auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(names[k]));
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    mapper->SetBRDF(brdf);
    mapper->SetIntegrator(lights);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(k % 3 - 1.0, 1.0 - k / 3, 0.0);
    renderer->AddActor(actor);
  }
  renderer->GetActiveCamera()->ParallelProjectionOn();
  renderer->ResetCamera();
  renderer->GetActiveCamera()->SetParallelScale(1.5);

  window->Render();
  const int result = vtkRegressionTestImage(window);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? 1 : 0;
}
