// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

MEASUREDBRDF_FUZZ_TARGET(Utia)(const std::uint8_t* data, std::size_t size)
{
  // The first byte says how; a file is large, and one in eight is made of the others again and
  // again.
  if (size < 2)
  {
    return 0;
  }
  // These take long, and are alike.
  const bool whole = std::accumulate(data, data + size, 0u) % 8 == 0;
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  while (whole && bytes.size() < measuredbrdf::UtiaBytes)
  {
    bytes += bytes.substr(0, measuredbrdf::UtiaBytes - bytes.size());
  }
  const std::string name = data[0] % 3 == 0 ? "display" : "";
  return fuzz::ReadFormat(measuredbrdf::UtiaFormat,
    reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), name);
}
