// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * NVIDIA's `.mbsdf` (MDL specification, appendix B): a magic line, lines of key="value", then a
 * block of values over (theta_in, theta_out, phi), phi fastest. Only reflection is read.
 */

#ifndef MbsdfFile_h
#define MbsdfFile_h

#include "MaterialFile.h"

namespace measuredbrdf
{
constexpr const char* MbsdfFormat = "NVIDIA MBSDF";
constexpr const char MbsdfMagic[] = "NVIDIA ARC MBSDF V1"; // a line

MaterialFile ReadMbsdf(const FileBytes& file);
} // namespace measuredbrdf

#endif
