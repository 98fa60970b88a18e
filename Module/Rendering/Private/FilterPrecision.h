// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How finely a renderer's texture units resolve the weights of linear interpolation. Private to the
 * module.
 */

#ifndef FilterPrecision_h
#define FilterPrecision_h

class vtkRenderWindow;

namespace measuredbrdf
{
/// The bits of the weights, for vtkRadianceIntegrator::SetFilterWeightBits; 0: more than 11. -1:
/// nothing can be drawn. The window's context is current afterwards.
int MeasureFilterWeightBits(vtkRenderWindow* window);
} // namespace measuredbrdf

#endif
