// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a BSDF XML file holds, as texts: its bases and blocks of values. Private to the IO room.
 */

#ifndef BsdfXmlParser_h
#define BsdfXmlParser_h

#include "FileBytes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace measuredbrdf
{
constexpr const char* BsdfXmlFormatName = "BSDF XML";

struct BsdfXmlRing
{
  std::string Lower; // degrees
  std::string Upper;
  std::string Patches;
};

struct BsdfXmlBasis
{
  std::string Name;
  std::vector<BsdfXmlRing> Rings;
};

/// A WavelengthDataBlock, with the wavelength around it.
struct BsdfXmlBlock
{
  std::string Wavelength;
  std::string Direction; // "Reflection Back"
  std::string ColumnBasis;
  std::string RowBasis;
  std::string Values;
  std::uint64_t Offset = 0; // of the values in the file
};

struct BsdfXmlTexts
{
  std::string Name;
  std::string Manufacturer;
  std::string Structure; // "Columns", "Rows", "TensorTree3", "TensorTree4"
  int Layers = 0;        // what is above is of the first
  std::vector<BsdfXmlBasis> Bases;
  std::vector<BsdfXmlBlock> Blocks; // of visible light
  int NumberOfBlocks = 0;           // of all
  std::string Note;                 // of what was left out before the XML
};

/// Whether two words are the same but for upper and lower case, as Radiance compares them.
bool IsSameWord(const std::string& a, const std::string& b);

/// "line 3, column 14", counted from 1 in bytes.
std::string DescribeLine(std::string_view text, std::uint64_t offset);

/// Throws FileError where it is no well-formed XML, has a document type of its own, or is not a
/// WindowElement.
BsdfXmlTexts ParseBsdfXml(const FileBytes& file);
} // namespace measuredbrdf

#endif
