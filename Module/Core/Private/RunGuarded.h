// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * For methods that VTK calls, which catches nothing. Private to the module.
 */

#ifndef RunGuarded_h
#define RunGuarded_h

#include "vtkObject.h"

#include <exception>
#include <string>

namespace measuredbrdf
{
/// Whether work was done. What it throws, for lack of memory say, is an error of the object.
template <typename Work>
bool RunGuarded(vtkObject* object, const char* method, const Work& work)
{
  std::string problem = "an unknown exception";
  try
  {
    work();
    return true;
  }
  catch (const std::exception& e)
  {
    problem = e.what();
  }
  catch (...)
  {
  }
  vtkErrorWithObjectMacro(object, << method << ": " << problem << ".");
  return false;
}
} // namespace measuredbrdf

#endif
