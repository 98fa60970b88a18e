// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The common rule for bad values, and setters that follow it. NaN, infinity and values outside an
 * enumeration are refused with one error event, and the old value stays. A finite number out of
 * range is clamped with a warning where the documentation says so, and refused otherwise. For use
 * in a class's .cxx.
 */

#ifndef Setters_h
#define Setters_h

#include "vtkSetGet.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace measuredbrdf
{
template <typename T>
bool IsFinite(T value)
{
  return std::isfinite(static_cast<double>(value));
}

template <typename T>
bool AreFinite(const T* values, int count)
{
  return std::all_of(values, values + count, [](T value) { return IsFinite(value); });
}
} // namespace measuredbrdf

// The rest of every message: "vtkFoo: SetBar: found nan, expected ...; 2 stays." The arguments may
// contain several values with << between them, so there are no parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define measuredbrdfRefuseMacro(name, found, expected)                                             \
  vtkErrorMacro("Set" #name ": found " << found << ", expected " << expected << "; " << this->name \
                                       << " stays.")
// NOLINTEND(bugprone-macro-parentheses)

#define measuredbrdfAssignMacro(name, value) \
  do                                         \
  {                                          \
    if (this->name != (value))               \
    {                                        \
      this->name = (value);                  \
      this->Modified();                      \
    }                                        \
  } while (false)

/// Finite numbers out of [low, high] are clamped.
#define measuredbrdfSetClampedMacro(className, name, type, low, high)                           \
  void className::Set##name(type value)                                                         \
  {                                                                                             \
    if (!measuredbrdf::IsFinite(value))                                                         \
    {                                                                                           \
      measuredbrdfRefuseMacro(name, value, "a number from " << (low) << " to " << (high));      \
      return;                                                                                   \
    }                                                                                           \
    const type clamped = std::clamp<type>(value, low, high);                                    \
    if (clamped != value)                                                                       \
    {                                                                                           \
      vtkWarningMacro("Set" #name ": " << value << " is not from " << (low) << " to " << (high) \
                                       << "; " << clamped << " is taken.");                     \
    }                                                                                           \
    measuredbrdfAssignMacro(name, clamped);                                                     \
  }

/// All values out of [low, high] are refused: for enumerators, and for numbers that must not be
/// replaced by a neighboring one.
#define measuredbrdfSetInRangeMacro(className, name, type, low, high)                     \
  void className::Set##name(type value)                                                   \
  {                                                                                       \
    if (!(value >= static_cast<type>(low) && value <= static_cast<type>(high)))           \
    {                                                                                     \
      measuredbrdfRefuseMacro(name, value,                                                \
        "a number from " << static_cast<type>(low) << " to " << static_cast<type>(high)); \
      return;                                                                             \
    }                                                                                     \
    measuredbrdfAssignMacro(name, value);                                                 \
  }

/// Three finite numbers.
#define measuredbrdfSetFinite3Macro(className, name)                                               \
  void className::Set##name(double x, double y, double z)                                          \
  {                                                                                                \
    const double values[3] = { x, y, z };                                                          \
    if (!measuredbrdf::AreFinite(values, 3))                                                       \
    {                                                                                              \
      vtkErrorMacro("Set" #name ": found " << x << ", " << y << ", " << z                          \
                                           << ", expected three finite numbers; " << this->name[0] \
                                           << ", " << this->name[1] << ", " << this->name[2]       \
                                           << " stay.");                                           \
      return;                                                                                      \
    }                                                                                              \
    if (!std::equal(values, values + 3, this->name))                                               \
    {                                                                                              \
      std::copy(values, values + 3, this->name);                                                   \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  void className::Set##name(const double values[3])                                                \
  {                                                                                                \
    this->Set##name(values[0], values[1], values[2]);                                              \
  }

/// Two numbers that a function checks; it returns a description of the error, or "".
#define measuredbrdfSetChecked2Macro(className, name, findProblem)                                \
  void className::Set##name(double x, double y)                                                   \
  {                                                                                               \
    const double values[2] = { x, y };                                                            \
    const std::string problem = findProblem(values);                                              \
    if (!problem.empty())                                                                         \
    {                                                                                             \
      vtkErrorMacro("Set" #name ": " << problem << "; " << this->name[0] << ", " << this->name[1] \
                                     << " stay.");                                                \
      return;                                                                                     \
    }                                                                                             \
    if (!std::equal(values, values + 2, this->name))                                              \
    {                                                                                             \
      std::copy(values, values + 2, this->name);                                                  \
      this->Modified();                                                                           \
    }                                                                                             \
  }                                                                                               \
  void className::Set##name(const double values[2]) { this->Set##name(values[0], values[1]); }

#endif
