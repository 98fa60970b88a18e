// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "MerlFile.h"

MEASUREDBRDF_FUZZ_TARGET(Merl)(const std::uint8_t* data, std::size_t size)
{
  fuzz::ReadMaterial(data, size, measuredbrdf::ReadMerl);
  return 0;
}
