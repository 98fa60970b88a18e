// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The maps of vtkEnvironmentProjection, formulas and conventions as documented there, for the inner
 * loops. Private to the lighting room.
 */

#ifndef ProjectionMaps_h
#define ProjectionMaps_h

#include <glm/glm.hpp>

namespace measuredbrdf
{
/// How the faces of a cube lie in an image; columns and rows in faces, from the upper left.
struct CubeLayout
{
  int Columns;
  int Rows;
  glm::ivec2 Cells[6]; // of +x -x +y -y +z -z
  bool TurnedBack;     // -z is upside down
};

/// Null for projections that are not cubes.
const CubeLayout* GetCubeLayout(int projection);

bool IsDisc(int projection);

/// Unit direction of (u,v) in [0,1]^2; false where the image shows no direction.
bool MapToDirection(int projection, const glm::dvec2& uv, glm::dvec3& direction);

/// Whether the rectangle, which lies in no two cells of a cube's layout, shows no direction at all.
bool ShowsNothing(int projection, const glm::dvec2& low, const glm::dvec2& high);

/// (u,v) of a direction of any length but 0.
glm::dvec2 MapToImage(int projection, const glm::dvec3& direction);

/// dOmega/(du dv). Beyond a disc's rim its formula goes on; 0 beside crosses.
double GetDensity(int projection, const glm::dvec2& uv);

/// Solid angle of the texel [x,x+1] x [y,y+1] of width x height.
double GetSolidAngle(int projection, int width, int height, int x, int y);
} // namespace measuredbrdf

#endif
