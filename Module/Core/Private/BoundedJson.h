// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * JSON of unknown origin. nlohmann-json reads any depth, but copies, compares and writes what it
 * has read by functions that call themselves: a file of 200,000 brackets would end the program.
 */

#ifndef BoundedJson_h
#define BoundedJson_h

// Headers of VTK 9.4 and later may give nlohmann-json's namespace the name of VTK's own copy. Which
// copy is taken must not depend on what else is included.
#include "vtkAbstractArray.h"
#ifdef VTK_NLOHMANN_JSON
#include VTK_NLOHMANN_JSON(json.hpp)
#else
#include <nlohmann/json.hpp>
#endif

#include <stdexcept>
#include <string>
#include <utility>

namespace measuredbrdf
{
/// Text or a stream as JSON (nlohmann::json or ordered_json). Throws its exception where it is
/// none, std::runtime_error where it is nested too deeply.
template <typename Json, typename Input>
Json ParseJson(Input&& input)
{
  constexpr int deepest = 64;
  const auto check = [](int depth, typename Json::parse_event_t, Json&)
  {
    if (depth > deepest)
    {
      throw std::runtime_error(
        "it is nested deeper than the " + std::to_string(deepest) + " levels expected at most");
    }
    return true;
  };
  return Json::parse(std::forward<Input>(input), check);
}
} // namespace measuredbrdf

#endif
