// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * For methods that VTK calls, which catches nothing.
 */

#ifndef RunGuarded_h
#define RunGuarded_h

#include "vtkObject.h"

#include <exception>
#include <optional>
#include <string>

namespace measuredbrdf
{
/// What work throws, for lack of memory say.
template <typename Work>
std::optional<std::string> FindThrown(const Work& work)
{
  try
  {
    work();
    return std::nullopt;
  }
  catch (const std::exception& e)
  {
    return e.what();
  }
  catch (...) // of a program's own material
  {
    return "an unknown exception";
  }
}

/// Whether work was done. What it throws is an error of the object.
template <typename Work>
bool RunGuarded(vtkObject* object, const char* method, const Work& work)
{
  const std::optional<std::string> problem = FindThrown(work);
  if (problem)
  {
    vtkErrorWithObjectMacro(object, << method << ": " << *problem << ".");
  }
  return !problem;
}
} // namespace measuredbrdf

#endif
