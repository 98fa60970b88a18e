// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Grids of directions of light and view, and values at them. Private to the IO room.
 */

#ifndef GonioGrid_h
#define GonioGrid_h

#include "GonioReadings.h"
#include "vtkAngularTableBRDF.h"

#include <cstddef>
#include <vector>

namespace measuredbrdf
{
constexpr float Horizon = 90.0f;   // degrees from the normal
constexpr float FullTurn = 360.0f; // degrees

/// Of lights and views together.
constexpr double MaximumGonioNodes = 4e6;

struct GonioGrid
{
  using Nodes = vtkAngularTableBRDF::Nodes;

  Nodes Light;
  Nodes View;

  std::size_t GetLights() const { return this->Light.Theta.size() * this->Light.Phi.size(); }
  std::size_t GetViews() const { return this->View.Theta.size() * this->View.Phi.size(); }
  std::size_t GetSize() const { return this->GetLights() * this->GetViews(); }
};

/// The readings' directions; angles less than 0.01 degrees apart are one.
GonioGrid FindGonioGrid(const std::vector<GonioAngles>& readings);

/// The node of the light that a reading has.
std::size_t FindGonioLight(const GonioGrid& grid, const GonioAngles& reading);

/// RGB at the grid's nodes.
struct GonioValues
{
  std::vector<float> RGB;
  std::size_t Filled = 0;   // of values that the readings lack
  std::size_t Repeated = 0; // of readings of the same directions
};

/// Values where the readings are, and between them: holes are filled linearly around the circle of
/// the same polar angle, empty circles from their neighbors.
GonioValues FillGonioGrid(const GonioGrid& grid, const GonioReadings& readings);

/// For each light that is not known, the known ones' views of it, in the same way; size: values of
/// a light. Returns the number of lights, those along the normal aside.
std::size_t FillGonioLights(
  const GonioGrid& grid, std::size_t size, float* values, std::vector<char> known);

/// Gives directions along the normal one value, and adds nodes on the horizon, which have what the
/// last ones have: nothing is extrapolated.
void CloseGonioGrid(GonioGrid& grid, bool isotropic, std::vector<float>& rgb);
} // namespace measuredbrdf

#endif
