// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The header, columns and rows of an ASTM E1392 text. Private to the IO room.
 */

#ifndef AstmParser_h
#define AstmParser_h

#include "FileBytes.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace measuredbrdf
{
struct AstmTexts
{
  std::vector<std::string> Header;  // lines before VARS
  std::vector<std::string> Columns; // that VARS names
  std::vector<double> Numbers;      // row by row
  std::vector<std::size_t> Lines;   // of the rows in the file, from 1

  std::size_t GetNumberOfRows() const { return this->Lines.size(); }
};

/// Whether a line of the text's beginning is VARS.
bool HasAstmColumns(std::string_view text);

/**
 * Throws FileError where VARS or NUM_POINTS is wrong or missing, or a row has another number of
 * numbers. format: what messages call it. onlyHeader: leave out the rows.
 */
AstmTexts ParseAstm(const FileBytes& file, const char* format, bool onlyHeader = false);
} // namespace measuredbrdf

#endif
