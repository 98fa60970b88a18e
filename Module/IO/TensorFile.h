// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The RGL-EPFL database's "tensor_file" (Dupuy and Jakob 2018; layout after the authors' loader
 * github.com/rgl-epfl/brdf-loader): 12 bytes of magic, version 1.0, then named fields with type,
 * shape and the offset of their data. Only its RGB form is read.
 */

#ifndef TensorFile_h
#define TensorFile_h

#include "MaterialFile.h"

namespace measuredbrdf
{
constexpr const char* TensorFormat = "RGL tensor file";
constexpr const char TensorMagic[] = "tensor_file"; // with its terminating zero

MaterialFile ReadTensor(const FileBytes& file);
} // namespace measuredbrdf

#endif
