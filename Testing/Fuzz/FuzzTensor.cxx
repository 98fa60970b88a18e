// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "TensorFile.h"

MEASUREDBRDF_FUZZ_TARGET(Tensor)(const std::uint8_t* data, std::size_t size)
{
  fuzz::ReadMaterial(data, size, measuredbrdf::ReadTensor);
  return 0;
}
