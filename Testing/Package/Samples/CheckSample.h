// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether a sample has drawn a surface that the environment lights, and nothing else does.
 */

#ifndef CheckSample_h
#define CheckSample_h

#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <cstdlib>
#include <iostream>

/// An exit status.
inline int CheckSample(vtkRenderWindow* window, vtkRenderer* renderer)
{
  const auto render = [&](vtkUnsignedCharArray* pixel)
  {
    window->Render();
    const int* size = window->GetSize();
    window->GetPixelData(size[0] / 2, size[1] / 2, size[0] / 2, size[1] / 2, 0, pixel);
  };
  vtkNew<vtkUnsignedCharArray> drawn;
  render(drawn);
  renderer->AutomaticLightCreationOff();
  renderer->RemoveAllLights();
  vtkNew<vtkUnsignedCharArray> unlit;
  render(unlit);
  for (int c = 0; c < 3; ++c)
  {
    std::cout << "found " << int(drawn->GetValue(c)) << " in the middle, and without lights "
              << int(unlit->GetValue(c)) << "\n";
    if (drawn->GetValue(c) < 16 || drawn->GetValue(c) != unlit->GetValue(c))
    {
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}

#endif
