// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The numbers of vtkEnvironmentProjection::ProjectionType, for what the class itself is made of.
 * Private to the lighting room.
 */

#ifndef Projections_h
#define Projections_h

namespace measuredbrdf
{
/// vtkEnvironmentProjection describes them.
struct Projections
{
  enum Type
  {
    LAT_LONG = 0,
    ANGULAR_MAP,
    MIRROR_BALL,
    CUBE_HORIZONTAL_CROSS,
    CUBE_VERTICAL_CROSS,
    CUBE_HORIZONTAL_STRIP,
    CUBE_VERTICAL_STRIP
  };
};
} // namespace measuredbrdf

#endif
