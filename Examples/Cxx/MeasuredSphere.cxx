// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A sphere of a measured material under an environment, drawn offscreen into a PNG.
//
//   MeasuredSphere [IMAGE.png [MATERIAL [ENVIRONMENT]]]
//
// MATERIAL is a built-in material's name or a BRDF file; ENVIRONMENT a lat-long HDR image.

#include <vtkActor.h>
#include <vtkBRDF.h>
#include <vtkBRDFReader.h>
#include <vtkCamera.h>
#include <vtkEmbeddedMaterials.h>
#include <vtkEnvironment.h>
#include <vtkEnvironmentReader.h>
#include <vtkLightSet.h>
#include <vtkMeasuredBRDFMapper.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char* argv[])
{
  const std::string image = argc > 1 ? argv[1] : "MeasuredSphere.png";
  const std::string material = argc > 2 ? argv[2] : "gold-paint";

  vtkSmartPointer<vtkBRDF> brdf;
  vtkNew<vtkBRDFReader> materialReader;
  if (material.find_first_of("./#") != std::string::npos) // no built-in name has these
  {
    materialReader->SetFileName(material);
    materialReader->Read();
    brdf = materialReader->GetBRDF();
  }
  else
  {
    brdf.TakeReference(vtkEmbeddedMaterials::NewBRDF(material));
  }
  if (!brdf)
  {
    return EXIT_FAILURE; // they have said why
  }

  vtkNew<vtkEnvironment> sky;
  sky->SetToProceduralSky();
  vtkSmartPointer<vtkEnvironment> environment = sky;
  vtkNew<vtkEnvironmentReader> environmentReader;
  if (argc > 3)
  {
    environmentReader->SetFileName(argv[3]);
    if (!environmentReader->Read())
    {
      return EXIT_FAILURE;
    }
    environment = environmentReader->GetEnvironment();
  }

  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(128);
  sphere->SetPhiResolution(64);

  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  mapper->SetBRDF(brdf);
  mapper->SetEnvironment(environment);

  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.5);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0); // the same edges on every driver
  window->SetSize(400, 400);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(image.c_str());
  writer->Write();
  std::cout << material << ": " << mapper->GetPlan() << "\nwrote " << image << "\n";
  return EXIT_SUCCESS;
}
