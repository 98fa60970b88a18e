// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What every parser of the IO room returns, and the parsers, one file each. All throw FileError.
 */

#ifndef MaterialFile_h
#define MaterialFile_h

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>

namespace measuredbrdf
{
class FileBytes;

struct MaterialFile
{
  vtkSmartPointer<vtkBRDF> BRDF;
  std::string Notes;
  vtkIdType NumberOfNegativeValues = 0;
  vtkIdType NumberOfInvalidValues = 0; // NaN or infinite

  void AddNote(const std::string& note) { this->Notes += (this->Notes.empty() ? "" : "\n") + note; }
};
} // namespace measuredbrdf

#endif
