// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Tables made cell by cell, for materials that no sample can be.
 */

#ifndef FilledTable_h
#define FilledTable_h

#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace tool::stability
{
/// A table in half and difference angles. fill(cell, i, o) gives the values of cell number `cell`
/// as an array of three; i and o are null where the cell lies below the horizon.
template <typename Fill>
vtkSmartPointer<vtkTabulatedBRDF> FillTable(
  const std::array<int, 3>& dimensions, int azimuthRange, const Fill& fill)
{
  std::vector<float> rgb;
  std::size_t cell = 0;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      for (int x = 0; x < dimensions[0]; ++x, ++cell)
      {
        double i[3];
        double o[3];
        const bool isAbove = vtkTabulatedBRDF::GetCellDirections(
          vtkTabulatedBRDF::HALF_DIFFERENCE, azimuthRange, dimensions.data(), x, y, z, i, o);
        const std::array<double, 3> values =
          fill(cell, isAbove ? i : nullptr, isAbove ? o : nullptr);
        for (const double value : values)
        {
          rgb.push_back(static_cast<float>(value));
        }
      }
    }
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, azimuthRange, dimensions.data(), std::move(rgb));
  return table;
}

} // namespace tool::stability

#endif
