// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the tests of shading with hidden skies share.
 */

#ifndef OcclusionTools_h
#define OcclusionTools_h

#include "TraceSurface.h"
#include "vtkObject.h"

// Small tables: their own errors cancel.
template <typename Integrator>
void MakeSmall(Integrator* integrator)
{
  integrator->SetNumberOfRows(17);
  integrator->SetNumberOfViewAngles(6);
  integrator->SetNumberOfAzimuths(4);
}

#endif
