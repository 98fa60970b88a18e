// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Tables of many rows: a coarse map everywhere, and tiles of a fine one where radiance bends most.

#include "FieldSynthesis.h"
#include "HalfVector.h" // for Pi
#include "RadianceTable.h"
#include "SpherePairs.h"
#include "vtkAdaptiveRadianceIntegrator.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkEnvironment.h"
#include "vtkNew.h"
#include "vtkTableRadianceIntegrator.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

using measuredbrdf::Pi;
using measuredbrdf::TableTiles;

namespace
{
// Two bright panels in a dim room, one of them across the seam of the azimuth and near a pole.
vtkNew<vtkEnvironment> NewPanels()
{
  constexpr int width = 256;
  constexpr int height = 128;
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const bool panel =
        (y >= 50 && y < 66 && x >= 60 && x < 70) || (y >= 6 && y < 20 && (x < 16 || x >= 240));
      for (int c = 0; c < 3; ++c)
      {
        pixels.push_back(panel ? 40.0f - 5.0f * static_cast<float>(c) : 0.1f);
      }
    }
  }
  vtkNew<vtkEnvironment> room;
  room->SetPixels(width, height, pixels);
  return room;
}

vtkNew<vtkAshikhminShirleyBRDF> NewPaint()
{
  vtkNew<vtkAshikhminShirleyBRDF> paint;
  paint->SetDiffuse(0.05, 0.1, 0.2);
  paint->SetSpecularScale(0.3, 0.3, 0.3);
  paint->SetExponents(10000.0, 10000.0);
  return paint;
}

vtkNew<vtkTableRadianceIntegrator> NewTable(vtkBRDF* brdf, vtkEnvironment* room, int rows)
{
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetSizes({ rows, 6, 8 });
  table->SetBRDF(brdf);
  table->SetEnvironment(room);
  return table;
}

glm::dvec3 GetDirection(double row, double column, const TableTiles& tiles)
{
  const double polar = Pi * row / (tiles.FineRows - 1);
  const double azimuth = 2.0 * Pi * column / tiles.GetFineColumns();
  return { std::sin(polar) * std::sin(azimuth), std::cos(polar),
    std::sin(polar) * std::cos(azimuth) };
}
}

//------------------------------------------------------------------------------
// A lobe that needs tiles is integrated at twice as many nodes; at the usual 64 it is 0.2 % off.
TEST(TableTiles, KernelsHaveNodesEnough)
{
  const auto room = NewPanels();
  const auto paint = NewPaint();
  SpherePairs pairs;
  pairs.AddRandom(300);
  const auto coarse = NewTable(paint, room, 161);
  const auto fine = NewTable(paint, room, 161);
  fine->SetNumberOfNodes(128);
  const double error = GetRelativeError(pairs.Integrate(coarse), pairs.Integrate(fine));
  std::printf("nodes: %.5f\n", error);
  EXPECT_LT(error, 0.001);
}

//------------------------------------------------------------------------------
// What they are for: the edges of panels in gloss, of which the coarse map shows little.
TEST(TableTiles, ShowHardEdgesInFewMegabytes)
{
  const auto room = NewPanels();
  const auto paint = NewPaint();
  SpherePairs drawn, pairs; // seen along the normals: the view angles' spacing does not count
  drawn.AddRandom(600);
  for (vtkIdType k = 0; k < drawn.Normals->GetNumberOfTuples(); ++k)
  {
    glm::dvec3 n;
    drawn.Normals->GetTuple(k, &n.x);
    pairs.Add(n, n);
  }
  vtkNew<vtkAdaptiveRadianceIntegrator> reference;
  reference->SetBRDF(paint);
  reference->SetEnvironment(room);
  const auto expected = pairs.Integrate(reference);
  double errors[2];
  for (int k = 0; k < 2; ++k)
  {
    const auto table = NewTable(paint, room, k == 0 ? 41 : 161);
    errors[k] = GetRelativeError(pairs.Integrate(table), expected);
    vtkBRDFShaderInputs inputs;
    ASSERT_TRUE(table->GetShaderInputs(inputs));
    const double bytes = static_cast<double>(inputs.GetTextureBytes());
    std::printf(
      "%d rows: %.2f MB, error %.4f\n", table->GetNumberOfRows(), 1e-6 * bytes, errors[k]);
    EXPECT_LE(bytes, static_cast<double>(table->EstimateTextureBytes()));
    EXPECT_LT(bytes, 6e6);
  }
  EXPECT_LT(errors[1], 0.25 * errors[0]);
  EXPECT_LT(errors[1], 0.02);
}

//------------------------------------------------------------------------------
// Steps of 1e-5 across all borders of tiles, whether the neighbor has a tile or none.
TEST(TableTiles, NoSeams)
{
  const auto room = NewPanels();
  const auto paint = NewPaint();
  const TableTiles tiles(161, 54);
  SpherePairs across;
  constexpr int side = TableTiles::Intervals;
  const double e = 1e-4; // of a fine interval
  for (int down = 1; down < tiles.CountRows(); ++down)
  {
    for (int right = 0; right < tiles.CountColumns(); ++right)
    {
      const double row = side * down;
      const double column = side * right;
      const glm::dvec2 steps[] = { { row, column + 3.3 }, { row - 5.1, column } };
      for (int k = 0; k < 2; ++k)
      {
        const glm::dvec2 step = k == 0 ? glm::dvec2(e, 0.0) : glm::dvec2(0.0, e);
        for (const double sign : { -1.0, 1.0 })
        {
          const glm::dvec2 at = steps[k] + sign * step;
          const glm::dvec3 d = GetDirection(at.x, at.y, tiles);
          across.Add(d, d); // seen along the normal, which is the axis then
        }
      }
    }
  }
  const auto radiance = across.Integrate(NewTable(paint, room, 161));
  double largest = 0.0;
  double step = 0.0;
  for (std::size_t k = 0; k < radiance.size(); k += 2)
  {
    largest = std::max(largest, radiance[k].x);
    step = std::max(step, std::abs(radiance[k].x - radiance[k + 1].x));
  }
  std::printf("steps up to %.1e of the largest\n", step / largest);
  EXPECT_LT(step / largest, 4e-3); // the format has 9 bits
}

//------------------------------------------------------------------------------
// Tiles at a pole, across the seam and elsewhere: of the fine map they need the nodes about them
// alone, and show it with its dark rings lifted.
TEST(TableTiles, NeedTheNodesAboutThem)
{
  constexpr int rows = 121;
  TableTiles tiles(rows, 1);
  const int coarseRows = TableTiles::GetRows(rows);
  const int coarseColumns = 2 * (coarseRows - 1);
  const int columns = tiles.GetFineColumns();
  tiles.Down = 1;
  for (const int tile :
    { 0, 3 * tiles.CountColumns(), 7 * tiles.CountColumns() + 5, 8 * tiles.CountColumns() + 5 })
  {
    tiles.Places[static_cast<std::size_t>(tile)] =
      1.0f + static_cast<float>(std::count_if(
               tiles.Places.begin(), tiles.Places.end(), [](float place) { return place > 0.0f; }));
  }
  std::vector<float> fine, coarse(3 * static_cast<std::size_t>(coarseRows * coarseColumns), 1.0f);
  for (int k = 0; k < 3 * rows * columns; ++k) // dark dots
  {
    fine.push_back(k % 7 == 0 ? 0.1f : 2.0f + std::sin(0.3f * static_cast<float>(k)));
  }
  const measuredbrdf::MapPart nodes = tiles.GetFineNodes();
  EXPECT_LT(nodes.GetNumberOfNodes(), fine.size() / 3 / 10);
  std::vector<float> some;
  for (const measuredbrdf::MapPart::Row& row : nodes.GetRows())
  {
    for (const int column : row.Columns)
    {
      const auto at = fine.begin() + 3 * (row.Place * columns + column);
      some.insert(some.end(), at, at + 3);
    }
  }
  const std::vector<float> joined = tiles.Join(coarse, nodes, some);
  EXPECT_EQ(joined, tiles.Join(coarse, measuredbrdf::MapPart(rows, columns), fine));
  std::vector<float> lifted = fine;
  measuredbrdf::LiftDarkRings(lifted, rows, static_cast<std::size_t>(columns));
  // The tile in the eighth row of tiles, but for its edges, and the coarse map in its middle.
  const int place =
    static_cast<int>(tiles.Places[static_cast<std::size_t>(7 * tiles.CountColumns() + 5)]) - 1;
  int changed = 0;
  for (int k = 0; k < 3 * TableTiles::Texels * TableTiles::Texels; ++k)
  {
    const int down = k / 3 / TableTiles::Texels;
    const int across = k / 3 % TableTiles::Texels;
    const int row = 7 * TableTiles::Intervals + down;
    const int column = 5 * TableTiles::Intervals + across;
    const std::size_t at = static_cast<std::size_t>(3 * (row * columns + column) + k % 3);
    if (down % TableTiles::Intervals != 0 && across % TableTiles::Intervals != 0)
    {
      const int texel =
        (coarseRows + down) * coarseColumns + place % tiles.Across * TableTiles::Texels + across;
      ASSERT_NEAR(joined[static_cast<std::size_t>(3 * texel + k % 3)], lifted[at], 1e-6f) << k;
      changed += lifted[at] > fine[at] ? 1 : 0;
    }
    if (down % TableTiles::Ratio == 0 && across % TableTiles::Ratio == 0)
    {
      const int texel = row / TableTiles::Ratio * coarseColumns + column / TableTiles::Ratio;
      ASSERT_NEAR(joined[static_cast<std::size_t>(3 * texel + k % 3)], lifted[at], 1e-6f) << k;
    }
  }
  EXPECT_GT(changed, 5);
}

//------------------------------------------------------------------------------
// Tiles fill textures up to a multiple of 4 MB. What a plan says of memory holds.
TEST(TableTiles, FillWhatIsAllowed)
{
  const struct
  {
    int Rows, Angles, Azimuths;
    double Most;
  } tables[] = { { 129, 12, 16, 4e6 }, { 257, 8, 8, 4e6 }, { 129, 20, 16, 8e6 },
    { 201, 20, 16, 12e6 }, { 257, 12, 16, 12e6 } };
  for (const auto& table : tables)
  {
    vtkNew<vtkTableRadianceIntegrator> integrator;
    integrator->SetSizes({ table.Rows, table.Angles, table.Azimuths });
    const auto bytes = static_cast<double>(integrator->EstimateTextureBytes());
    EXPECT_LE(bytes, table.Most) << table.Rows;
    EXPECT_GT(bytes, 0.92 * table.Most) << table.Rows; // rows of tiles are whole
  }
}
