// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Where vtkBRDFEnvironmentTable.glsl, which comes behind it, has tiles of a finer map. C++ twins:
// TableTiles, RadianceTable.
uniform sampler2D brdfTilePlacesINSTANCE; // 1 + a tile's place in the table's slices; 0: it has none
uniform float brdfTileAcrossINSTANCE; // tiles side by side there

// The axis' place in a slice in texels, of a tile below so many rows; (-1, -1): there is none.
vec2 brdfTilePositionINSTANCE(vec2 position, float rows)
{
  vec2 size = vec2(textureSize(brdfTilePlacesINSTANCE, 0));
  vec2 exact = vec2(fract(position.x), position.y) * size;
  vec2 tile = min(floor(exact), size - 1.0);
  float place = texelFetch(brdfTilePlacesINSTANCE, ivec2(tile), 0).x - 1.0;
  float down = floor((place + 0.5) / brdfTileAcrossINSTANCE);
  vec2 inTile = 8.0 * (exact - tile) + 9.0 * vec2(place - down * brdfTileAcrossINSTANCE, down);
  return place < 0.0 ? vec2(-1.0) : inTile + vec2(0.0, rows);
}
