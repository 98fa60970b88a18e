// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

MEASUREDBRDF_FUZZ_TARGET(Astm)(const std::uint8_t* data, std::size_t size)
{
  // One file in sixteen is asked for a wavelength.
  const std::string name = size > 0 && data[size - 1] % 16 == 0 ? "550nm" : "";
  return fuzz::ReadFormat(measuredbrdf::AstmFormat, data, size, name);
}
