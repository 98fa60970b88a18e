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
#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace measuredbrdf
{
/**
 * Read an image of the file. Memory follows what the file holds, not what its header promises.
 * layer: the layer or part of an OpenEXR file; empty: the one named Combined, else the channels R,
 * G and B without a name, else the first layer. Throws FileError.
 */
ImageFile ReadImageFile(
  const std::string& path, ImageValues values = ImageValues::Color, const std::string& layer = "");

/// The image as VTK has images, row 0 at the bottom: RGB, with alpha where the file has it.
/// isInteger: as unsigned char or unsigned short, else as floats. keepsGray: gray stays one
/// component.
vtkSmartPointer<vtkImageData> MakeImageData(
  const ImageFile& file, bool isInteger, bool keepsGray = false);
} // namespace measuredbrdf

#endif
