// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From radiance to the screen as the mapper shows it, and exposure; on the GPU and for pictures.
 */

#ifndef Display_h
#define Display_h

#include "Picture.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <QImage>

class vtkActor;
class vtkEnvironment;

namespace explorer
{
/// Let SetExposure scale the radiance that an actor's shader writes as radiance^(1/2.2).
void ShowRadiance(vtkActor* actor);

/// The factor of radiance for an actor of ShowRadiance.
void SetExposure(vtkActor* actor, double factor);

/**
 * The factor of radiance: 2^stops, so that 0 stops show what the mapper shows. Without an
 * environment, 0 stops show a white diffuse surface that faces a light of irradiance 1 as 0.7.
 */
double FindExposure(vtkEnvironment* environment, double stops);

/// (radiance times a factor)^(1/2.2), RGBA of unsigned char.
vtkSmartPointer<vtkImageData> MakeImage(const tool::Picture& radiance, double factor);

/// 8-bit display values of a picture of display light, row 0 at the top.
QImage MakeQImage(const tool::Picture& display);

/// The environment, blurred and dimmed, to be seen behind the mesh: radiance, lat-long.
tool::Picture MakeBackdropPicture(vtkEnvironment* environment);
} // namespace explorer

#endif
