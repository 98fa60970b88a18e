// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "vtkLambertBRDF.h"

MEASUREDBRDF_FUZZ_TARGET(BsdfXml)(const std::uint8_t* data, std::size_t size)
{
  fuzz::ReadMaterial(data, size,
    [](const measuredbrdf::FileBytes& file)
    {
      measuredbrdf::MaterialFile read = measuredbrdf::BsdfXmlFormat.Read(file, "");
      fuzz::Require(read.BRDF || read.Transmission);
      if (read.Transmission)
      {
        fuzz::Use(read.Transmission);
      }
      if (!read.BRDF) // of transmission only
      {
        read.BRDF = vtkSmartPointer<vtkLambertBRDF>::New();
      }
      return read;
    });
  return 0;
}
