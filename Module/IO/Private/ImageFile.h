// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The one way to read an image file: environments, pictures, photographs and weights. Its pixels
 * are as its header says that they are to be seen: turned, cut to the display window, divided by
 * the exposure, in Rec. 709.
 */

#ifndef ImageFile_h
#define ImageFile_h

#include "ImageDecoder.h"

#include <string>

namespace measuredbrdf
{
/**
 * Read an image of the file. Memory follows what the file holds, not what its header promises.
 * layer: the layer or part of an OpenEXR file; empty: the one named Combined, else the channels R,
 * G and B without a name, else the first layer. Throws FileError.
 */
ImageFile ReadImageFile(
  const std::string& path, ImageValues values = ImageValues::Color, const std::string& layer = "");
} // namespace measuredbrdf

#endif
