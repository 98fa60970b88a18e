// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "BsdfXmlFile.h"

MEASUREDBRDF_FUZZ_TARGET(BsdfXml)(const std::uint8_t* data, std::size_t size)
{
  fuzz::ReadMaterial(data, size,
    [](const measuredbrdf::FileBytes& file) { return measuredbrdf::ReadBsdfXml(file, ""); });
  return 0;
}
