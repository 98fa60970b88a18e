// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How messages begin where this build lacks an optional library.
 */

#ifndef AbsentLibraries_h
#define AbsentLibraries_h

namespace measuredbrdf
{
constexpr const char NoOpenEXR[] = "this build has no OpenEXR (MEASUREDBRDF_WITH_OPENEXR): ";
constexpr const char NoOpenImageIO[] =
  "this build has no OpenImageIO (MEASUREDBRDF_WITH_OPENIMAGEIO): ";
} // namespace measuredbrdf

#endif
