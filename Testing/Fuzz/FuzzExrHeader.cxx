// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "FileBytes.h"

// Behind the magic, which the caller has seen.
int FuzzExrHeader(const std::uint8_t* data, std::size_t size)
{
  const std::string bytes = measuredbrdf::ExrMagic + std::string(fuzz::ToView(data, size));
  try
  {
    measuredbrdf::CheckExrHeader(measuredbrdf::FileBytes::View("file", bytes), "OpenEXR image");
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  return 0;
}
