// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The program around README.md's C++ sample: a mesh, a window, and a file and a texture as it
// names.
#include "CheckSample.h"
#include "vtkActor.h"
#include "vtkBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBRDFWriter.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkImageData.h"
#include "vtkMeasuredBRDFMapper.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"

#include <cstdio>

int main()
{
  // Readers recognize files by their first bytes, so that any name will do.
  vtkNew<vtkBRDFWriter> writer;
  const auto material = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("gold-paint"));
  writer->SetBRDF(material);
  writer->SetFileName("sample.exr");
  if (!writer->Write() || std::rename("sample.exr", "satin_purple_rgb.bsdf") != 0)
  {
    return EXIT_FAILURE;
  }
  vtkNew<vtkImageData> sky;
  sky->SetDimensions(32, 16, 1);
  sky->AllocateScalars(VTK_FLOAT, 3);
  for (int k = 0; k < 3 * 32 * 16; ++k)
  {
    static_cast<float*>(sky->GetScalarPointer())[k] = 0.5f;
  }
  vtkNew<vtkTexture> hdr;
  hdr->SetInputData(sky);
  hdr->SetColorModeToDirectScalars();
  vtkNew<vtkSphereSource> mesh;
  mesh->SetThetaResolution(64);
  mesh->SetPhiResolution(32);
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);

#include "README.inc"

  return CheckSample(window, renderer);
}
