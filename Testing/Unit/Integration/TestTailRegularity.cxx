// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Which materials' lights may be shared by a window and a table.
#include "vtkEmbeddedMaterials.h"
#include "vtkHybridRadianceIntegrator.h"
#include "vtkSmartPointer.h"
#include "vtkTabulatedBRDF.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace
{
// A lobe of a cosine power of 20 over a diffuse base, cell by cell, then changed.
vtkSmartPointer<vtkTabulatedBRDF> NewTable(
  int range, const std::function<double(std::size_t, double)>& change)
{
  const std::array<int, 3> dimensions{ 12, 24, 32 };
  std::vector<float> rgb;
  for (int cell = 0; cell < 12 * 24 * 32; ++cell)
  {
    double i[3], o[3];
    double value = 0.1;
    if (vtkTabulatedBRDF::GetCellDirections(vtkTabulatedBRDF::HALF_DIFFERENCE, range,
          dimensions.data(), cell % 12, cell / 12 % 24, cell / (12 * 24), i, o))
    {
      const double h = std::hypot(i[0] + o[0], i[1] + o[1], i[2] + o[2]);
      value += std::pow((i[2] + o[2]) / h, 20.0);
    }
    rgb.insert(rgb.end(), 3, static_cast<float>(change(static_cast<std::size_t>(cell), value)));
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, range, dimensions.data(), std::move(rgb));
  return table;
}
}

TEST(TailRegularity, OfMaterials)
{
  const auto areWindowed = [](vtkBRDF* brdf, int lights = 8)
  { return vtkHybridRadianceIntegrator::AreWindowed(brdf, lights); };
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const auto brdf =
      vtk::TakeSmartPointer(vtkEmbeddedMaterials::NewBRDF(vtkEmbeddedMaterials::GetName(k)));
    EXPECT_EQ(areWindowed(brdf), brdf->IsIsotropic()) << brdf->GetName();
    EXPECT_FALSE(areWindowed(brdf, 1)) << brdf->GetName();
  }
  EXPECT_FALSE(areWindowed(nullptr));
}

TEST(TailRegularity, OfOddTables)
{
  const auto isWindowed = [](vtkBRDF* brdf)
  { return vtkHybridRadianceIntegrator::AreWindowed(brdf, 8); };
  const auto same = [](std::size_t, double value) { return value; };
  const auto oneSide = [](std::size_t cell, double value)
  { return value * (cell % 12 < 6 ? 1.6 : 0.4); };
  const auto noise = [](std::size_t cell, double value)
  { return value - (cell * 2654435761u % 1000 < 200 ? 0.3 : 0.0); };
  EXPECT_TRUE(isWindowed(NewTable(vtkTabulatedBRDF::HALF_TURN, same)));
  EXPECT_FALSE(isWindowed(NewTable(vtkTabulatedBRDF::FULL_TURN, oneSide)));
  EXPECT_FALSE(isWindowed(NewTable(vtkTabulatedBRDF::HALF_TURN, noise)));
}
