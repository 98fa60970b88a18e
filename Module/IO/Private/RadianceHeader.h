// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The header of a picture of Radiance's (.hdr, .pic), which OpenImageIO drops or reads otherwise on
 * every version: all of exposure, color correction, primaries, XYZ, and the order of the scanlines.
 */

#ifndef RadianceHeader_h
#define RadianceHeader_h

#include "Chromaticities.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace measuredbrdf
{
class FileBytes;

struct RadianceHeader
{
  // Scanlines as they are stored.
  int ScanlineLength = 0;
  int NumberOfScanlines = 0;
  int Orientation = 1; // as EXIF numbers it
  // What to divide the values by: the products of all EXPOSURE and COLORCORR lines.
  std::array<double, 3> Exposure = { 1.0, 1.0, 1.0 };
  std::optional<Chromaticities> Primaries; // where the header says them
  std::size_t Size = 0;                    // bytes before the pixels
};

/// The header of a file that begins with "#?". Throws FileError.
RadianceHeader ParseRadianceHeader(const FileBytes& file);

/// A header that says nothing but the size, for OpenImageIO.
std::string MakePlainHeader(const RadianceHeader& header);
} // namespace measuredbrdf

#endif
