// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * This project's material format: an OpenEXR file whose first part's string attribute
 * "measuredBRDF" holds JSON (names, representation, numbers; MaterialArchive), and whose parts hold
 * the tables as 32-bit or 16-bit floats, ZIP-compressed (lossless). Part "volume" or, in term 1 of
 * a sum, "1.volume": width = fastest axis, height = product of the others, channels R, G, B or Y. A
 * material without tables has one part "header" of one texel.
 */

#ifndef ExrMaterialFile_h
#define ExrMaterialFile_h

#include "MaterialFile.h"

namespace measuredbrdf
{
constexpr const char* ExrFormat = "OpenEXR material";

MaterialFile ReadExrMaterial(const FileBytes& file);

/// halfFloats: tables as 16-bit floats, a rounding of 2^-11; else 32-bit ones, bit by bit.
void WriteExrMaterial(vtkBRDF* brdf, const std::string& path, bool halfFloats);
} // namespace measuredbrdf

#endif
