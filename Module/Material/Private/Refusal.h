// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How materials check their data: the first problem is thrown, and the setter returns its text.
 */

#ifndef Refusal_h
#define Refusal_h

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace measuredbrdf
{
inline void Require(bool condition, const std::string& problem)
{
  if (!condition)
  {
    throw std::runtime_error(problem);
  }
}

/// name: of the values, for the message.
inline void RequireFinite(const std::vector<float>& values, const std::string& name)
{
  const auto bad =
    std::find_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); });
  Require(bad == values.end(),
    name + ": number " + std::to_string(bad - values.begin()) + " is not finite");
}

/// The problem that work() throws, or "".
template <typename Work>
std::string FindProblemOf(const Work& work)
{
  try
  {
    work();
    return "";
  }
  catch (const std::runtime_error& e)
  {
    return e.what();
  }
}
} // namespace measuredbrdf

#endif
