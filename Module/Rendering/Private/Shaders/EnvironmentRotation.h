// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How environments are turned against the view. Private to the rendering room.
 */

#ifndef EnvironmentRotation_h
#define EnvironmentRotation_h

#include <array>

class vtkEnvironment;
class vtkRenderer;

namespace measuredbrdf
{
/// From view coordinates to the environment's own axes, by rows: VTK's envMatrix, which leads to
/// the renderer's environment, and the environment's own rotation (null: none). One matrix, because
/// a fragment's directions are turned where software renderers pay for each multiplication.
std::array<double, 9> GetViewToEnvironment(vtkRenderer* renderer, vtkEnvironment* environment);
} // namespace measuredbrdf

#endif
