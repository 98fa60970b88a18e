// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The scene of same_scene.py in C++: same_scene MESH.vtp MATERIAL ENVIRONMENT X,Y,Z PICTURE.png

#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkCamera.h"
#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkWindowToImageFilter.h"
#include "vtkXMLPolyDataReader.h"

#include <cstdlib>
#include <iostream>
#include <sstream>

int main(int argc, char* argv[])
{
  if (argc != 6)
  {
    std::cerr << "usage: same_scene MESH.vtp MATERIAL ENVIRONMENT X,Y,Z PICTURE.png\n";
    return EXIT_FAILURE;
  }
  double position[3];
  char comma;
  std::istringstream(argv[4]) >> position[0] >> comma >> position[1] >> comma >> position[2];

  vtkNew<vtkXMLPolyDataReader> surface;
  surface->SetFileName(argv[1]);
  vtkNew<vtkBRDFReader> material;
  material->SetFileName(argv[2]);
  vtkNew<vtkEnvironmentReader> environment;
  environment->SetFileName(argv[3]);
  if (!material->Read() || !environment->Read())
  {
    return EXIT_FAILURE;
  }
  vtkNew<vtkMeasuredBRDFMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->SetBRDF(material->GetBRDF());
  mapper->SetEnvironment(environment->GetEnvironment());

  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(position);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetViewAngle(30.0);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(300, 300);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff(); // it would change the last digit of the view angle
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(argv[5]);
  writer->Write();
  std::cout << mapper->GetPlan() << "\n";
  return EXIT_SUCCESS;
}
