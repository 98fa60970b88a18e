// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Candidates.h"

#include "EnvironmentPrecomputation.h"
#include "LobePlacement.h" // for ProfileTexels
#include "RadianceTable.h"
#include "vtkEnvironment.h"
#include "vtkMath.h"

namespace measuredbrdf
{
namespace
{
constexpr vtkIdType MapBytes =
  4 * RadianceTable::IrradianceSide * RadianceTable::IrradianceSide + 2 * 16 * ProfileTexels;
}

int CountPlannedLights(
  vtkEnvironment* environment, double degrees, const std::function<bool()>& goOn)
{
  const auto lamps = environment && !environment->GetPixels().empty()
                       ? environment->GetParts().GetLamps(
                           environment, vtkMath::RadiansFromDegrees(degrees), PlannedLights, goOn)
                       : nullptr;
  return lamps ? static_cast<int>(lamps->Lights.size()) : 0;
}

// Chosen on nine materials under four maps, and reported on others (docs/methods/planner.md). None
// is above 12 MB. More than 113 rows have tiles (RadianceTable.h).
std::vector<std::vector<int>> GetTableCandidates(bool lamps)
{
  std::vector<std::vector<int>> sizes = { { 17, 8, 8 }, { 33, 12, 16 } };
  if (!lamps)
  {
    sizes.insert(sizes.end(), { { 49, 12, 16 }, { 201, 20, 16 } });
  }
  return sizes;
}

std::vector<std::vector<int>> GetHybridCandidates()
{
  return { { 33, 12, 16, 0 }, { 65, 20, 12, 0 }, { 81, 20, 8, 0 }, { 320, 12, 8, 8 } };
}

std::vector<std::vector<int>> GetAnisotropicCandidates()
{
  return { { 17, 8, 16, 8 }, { 25, 8, 20, 8 }, { 33, 6, 24, 8 } };
}

vtkIdType GetTableBytes(int rows, int viewAngles, int azimuths)
{
  const RadianceTable table(rows, viewAngles, azimuths);
  return MapBytes +
         4 * static_cast<vtkIdType>(table.GetMap(viewAngles, 0) + table.Tiles.Places.size());
}
} // namespace measuredbrdf
