// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What every parser of the IO room returns, and the parsers, one file each. All throw FileError.
 */

#ifndef MaterialFile_h
#define MaterialFile_h

#include "Printable.h"
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

  /// A line, which may quote the file; what a file has to say ends somewhere.
  void AddNote(const std::string& note)
  {
    if (this->Notes.size() < MostNotes)
    {
      this->Notes += (this->Notes.empty() ? "" : "\n") + ToPrintable(note, LongestNote);
    }
  }

private:
  static constexpr std::size_t LongestNote = 1000;
  static constexpr std::size_t MostNotes = 20000;
};
} // namespace measuredbrdf

#endif
