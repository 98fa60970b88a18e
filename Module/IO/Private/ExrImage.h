// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pixels of an OpenEXR image of this library's own. vtkEnvironmentReader reads those of others.
 */

#ifndef ExrImage_h
#define ExrImage_h

#include <vector>

namespace measuredbrdf
{
class FileBytes;

struct ExrImage
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Pixels; // RGB, row 0 at the bottom
};

/// The file's first part: channels R, G and B in scanlines. Throws std::exception.
ExrImage ReadExrImage(const FileBytes& file);
} // namespace measuredbrdf

#endif
