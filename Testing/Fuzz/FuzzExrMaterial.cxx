// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "ExrMaterialFile.h"

MEASUREDBRDF_FUZZ_TARGET(ExrMaterial)(const std::uint8_t* data, std::size_t size)
{
  fuzz::ReadMaterial(data, size, measuredbrdf::ReadExrMaterial);
  return 0;
}
