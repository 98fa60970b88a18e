// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzTarget.h"

#include "PhotographList.h"

#include <cmath>
#include <cstdlib>

int FuzzPhotographList(const std::uint8_t* data, std::size_t size)
{
  const fuzz::Silence silence;
  const auto check = [](const measuredbrdf::ListedPhotograph& photograph)
  {
    if (!(photograph.Light[2] > 0.0) || !(photograph.View[2] > 0.0) ||
        !(photograph.Exposure > 0.0) || photograph.File.empty())
    {
      std::abort();
    }
  };
  try
  {
    const auto file = measuredbrdf::FileBytes::View("file", fuzz::ToView(data, size));
    for (const auto& photograph : measuredbrdf::ParsePhotographList(file).Photographs)
    {
      check(photograph);
    }
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  try
  {
    measuredbrdf::ListedPhotograph photograph;
    if (measuredbrdf::ParsePhotographName(std::string(fuzz::ToView(data, size)), photograph))
    {
      check(photograph);
    }
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  return 0;
}
