// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The tool's tables of directions.
#include "FuzzTarget.h"

#include "Files.h"
#include "Tool.h"

int FuzzDirectionsCsv(const std::uint8_t* data, std::size_t size)
{
  static const fuzz::ScratchFolder folder;
  const std::string path = folder.Write("pairs.csv", fuzz::ToView(data, size));
  try
  {
    for (const tool::Pair& pair : tool::ReadPairs(path, { "ix", "iy", "iz", "ox", "oy", "oz" }))
    {
      for (const double value : pair)
      {
        fuzz::Require(std::isfinite(value));
      }
    }
  }
  catch (const tool::Error&)
  {
  }
  return 0;
}
