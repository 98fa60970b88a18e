// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

MEASUREDBRDF_FUZZ_TARGET(Fit)(const std::uint8_t* data, std::size_t size)
{
  const auto file = measuredbrdf::FileBytes::View("file", fuzz::ToView(data, size));
  try
  {
    for (const std::string& name : measuredbrdf::FitFormat.ListMaterials(file))
    {
      fuzz::ReadFormat(measuredbrdf::FitFormat, data, size, name);
    }
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  return 0;
}
