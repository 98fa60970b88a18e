// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Directions of all texels of a lat-long image from one sine and cosine per column and per row.
 */

#ifndef TexelDirections_h
#define TexelDirections_h

#include "vtkEnvironment.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
struct TexelDirections
{
  TexelDirections(int width, int height)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 d;
      vtkEnvironment::GetDirection((x + 0.5) / width, 0.5, &d.x);
      this->Columns.emplace_back(d.x, d.z);
    }
    for (int y = 0; y < height; ++y)
    {
      glm::dvec3 d;
      vtkEnvironment::GetDirection(0.5, (y + 0.5) / height, &d.x);
      this->Rows.emplace_back(d.x, d.y);
    }
  }

  glm::dvec3 Get(int x, int y) const
  {
    const glm::dvec2& column = this->Columns[static_cast<std::size_t>(x)];
    const glm::dvec2& row = this->Rows[static_cast<std::size_t>(y)];
    return glm::dvec3(row.x * column.x, row.y, row.x * column.y);
  }

  std::vector<glm::dvec2> Columns; // cosine, sine of the azimuth
  std::vector<glm::dvec2> Rows;    // cosine, sine of the latitude
};
} // namespace measuredbrdf

#endif
