// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From photographs of a flat sample to materials and weights: the work of vtkMaterialMapFitter.
 */

#ifndef MaterialMapFit_h
#define MaterialMapFit_h

#include "MapFitData.h"

class vtkPhotographSet;

namespace measuredbrdf
{
MapFitResult FitMaterialMap(vtkPhotographSet* photographs, const MapFitOptions& options);
} // namespace measuredbrdf

#endif
