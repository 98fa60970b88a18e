// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkLights on a measured material (thesis figures 3.1 to 3.3): a spot, a directional and a
// positional light, on an anisotropic brushed ring (tangents in the data), a clipped sphere and a
// whole one.

#include "vtkActor.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDF.h"
#include "vtkCamera.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkFloatArray.h"
#include "vtkLight.h"
#include "vtkLightSetGenerator.h"
#include "vtkLightSetRadianceIntegrator.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <cmath>

int TestMeasuredSceneLights(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(240, 240);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  renderer->SetBackground(0.1, 0.1, 0.12);

  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->SetPosition(4.0, 5.0, 6.0);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  sun->SetIntensity(2.0);
  renderer->AddLight(sun);
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetConeAngle(180.0);
  lamp->SetPosition(-2.0, 0.5, 1.5);
  lamp->SetAttenuationValues(0.0, 0.0, 0.4);
  lamp->SetDiffuseColor(1.0, 0.7, 0.4);
  renderer->AddLight(lamp);
  vtkNew<vtkLight> spot;
  spot->SetLightTypeToSceneLight();
  spot->PositionalOn();
  spot->SetPosition(0.8, -2.0, 3.0);
  spot->SetFocalPoint(0.6, -0.6, 0.0);
  spot->SetConeAngle(12.0);
  spot->SetExponent(1.0);
  spot->SetDiffuseColor(0.5, 0.7, 1.0);
  spot->SetIntensity(4.0);
  renderer->AddLight(spot);

  // Brushed around: tangents along the ring.
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(0.8);
  torus->SetCrossSectionRadius(0.35);
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(torus);
  source->SetUResolution(96);
  source->SetVResolution(48);
  source->Update();
  vtkPolyData* ring = source->GetOutput();
  vtkNew<vtkFloatArray> tangents;
  tangents->SetName("Tangents");
  tangents->SetNumberOfComponents(3);
  for (vtkIdType k = 0; k < ring->GetNumberOfPoints(); ++k)
  {
    const double* p = ring->GetPoint(k);
    const double r = std::hypot(p[0], p[1]);
    tangents->InsertNextTuple3(-p[1] / r, p[0] / r, 0.0);
  }
  ring->GetPointData()->SetTangents(tangents);
  vtkNew<vtkAshikhminShirleyBRDF> brushed;
  brushed->SetReflectance(0.7, 0.55, 0.3);
  brushed->SetDiffuse(0.6, 0.4, 0.2);
  brushed->SetExponents(8.0, 200.0);
  vtkNew<vtkLightSetRadianceIntegrator> lights;
  lights->SetGenerator(vtkNew<vtkLightSetGenerator>());
  vtkNew<vtkMeasuredBRDFMapper> ringMapper;
  ringMapper->SetInputData(ring);
  ringMapper->SetBRDF(brushed);
  ringMapper->SetIntegrator(lights);
  vtkNew<vtkActor> ringActor;
  ringActor->SetMapper(ringMapper);
  ringActor->SetPosition(0.0, 0.3, 0.0);
  ringActor->RotateX(-25.0);
  renderer->AddActor(ringActor);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  sphere->SetRadius(0.5);
  for (int k = 0; k < 2; ++k)
  {
    auto brdf = vtkSmartPointer<vtkBRDF>::Take(
      vtkEmbeddedMaterials::NewBRDF(k == 0 ? "red-fabric2" : "blue-metallic-paint"));
    vtkNew<vtkMeasuredBRDFMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    mapper->SetBRDF(brdf);
    mapper->SetIntegrator(lights);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(k == 0 ? -0.7 : 0.7, -0.8, 0.3);
    if (k == 0)
    {
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(-0.7, -0.7, 0.3);
      plane->SetNormal(0.3, -1.0, -0.4);
      mapper->AddClippingPlane(plane);
    }
    renderer->AddActor(actor);
  }
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.3);

  window->Render();
  const int result = vtkRegressionTestImage(window);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? 1 : 0;
}
