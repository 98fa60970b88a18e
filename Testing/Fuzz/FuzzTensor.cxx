// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

MEASUREDBRDF_FUZZ_TARGET(Tensor)(const std::uint8_t* data, std::size_t size)
{
  return fuzz::ReadFormat(measuredbrdf::TensorFormat, data, size);
}
