// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "FitFile.h"

MEASUREDBRDF_FUZZ_TARGET(Fit)(const std::uint8_t* data, std::size_t size)
{
  const fuzz::Silence silence;
  try
  {
    const measuredbrdf::FitFile file("file", fuzz::ToView(data, size));
    for (const std::string& name : file.GetNames())
    {
      try
      {
        fuzz::Use(file.GetMaterial(name).BRDF, fuzz::IsRare(data, size));
      }
      catch (const measuredbrdf::FileError&)
      {
      }
    }
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  return 0;
}
