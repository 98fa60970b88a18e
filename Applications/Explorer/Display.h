// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From radiance to the screen: exposure, roll-off of highlights, sRGB; on the GPU and for pictures.
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
/// Let an actor's shader, which writes radiance^(1/2.2), write what the functions below give.
void ShowRadiance(vtkActor* actor);

/// The factor of radiance for an actor of ShowRadiance.
void SetExposure(vtkActor* actor, double factor);

/// The factor that suits an environment, or, of null, a light of irradiance 1; times 2^stops.
double FindExposure(vtkEnvironment* environment, double stops);

/// tool::RollOff and tool::EncodeSRGB of radiance times a factor, RGBA of unsigned char.
vtkSmartPointer<vtkImageData> MakeImage(const tool::Picture& radiance, double factor);

/// 8-bit display values of a picture of display light, row 0 at the top.
QImage MakeQImage(const tool::Picture& display);

/// The environment, blurred and dimmed, to be seen behind the mesh: radiance, lat-long.
tool::Picture MakeBackdropPicture(vtkEnvironment* environment);
} // namespace explorer

#endif
