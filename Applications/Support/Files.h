// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files in and out: tables of directions as CSV, and outputs that are whole or not there.
 */

#ifndef Files_h
#define Files_h

#include <array>
#include <string>
#include <string_view>
#include <vector>

class vtkBRDF;

namespace tool
{
/// Names of the six columns of a table of direction pairs.
using PairColumns = std::array<std::string, 6>;
/// One row: two directions.
using Pair = std::array<double, 6>;

/**
 * Read the six named columns of a CSV file: the first line that is neither empty nor starts with #
 * names the columns; other columns are ignored. Throws Error naming file, line and column for
 * anything missing, not a number, or a direction that is zero or not finite.
 */
std::vector<Pair> ReadPairs(const std::string& path, const PairColumns& columns);

/// A cell of text in a CSV file: quoted, quotes in it doubled (RFC 4180).
std::string QuoteCell(const std::string& text);

/// The pairs with r,g,b (3 per pair), to a file, or to stdout where path is empty. Throws Error.
void WriteResults(const std::string& path, const PairColumns& columns,
  const std::vector<Pair>& pairs, const std::vector<double>& rgb);

/// A file, whole or not at all: as WriteWholeFile (WholeFile.h). Throws Error.
void WriteWhole(const std::string& path, std::string_view bytes);

/// Throws Error where a file could not be written there: to be asked before long work. Not of "".
void CheckWritable(const std::string& path);

/// Make a folder where there is none. Throws Error.
void MakeFolder(const std::string& path);

/// A material in the format that the path's ending names, whole or not at all; halfFloats: tables
/// of .exr as 16-bit floats. Throws Error.
void WriteMaterial(vtkBRDF* brdf, const std::string& path, bool halfFloats = false);

/// The ending in lower case, with its dot ("" if none).
std::string Extension(const std::string& path);
} // namespace tool

#endif
