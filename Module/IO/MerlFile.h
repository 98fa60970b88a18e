// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * MERL `.binary` (Matusik et al. 2003; layout: the database's BRDFRead.cpp): int32 n_theta_h,
 * n_theta_d, n_phi_d, then float64, three planes R, G, B with phi_d fastest and theta_h slowest.
 * Values are scaled by (1, 1.15, 1.66)/1500; a cell with a negative channel was not measured.
 */

#ifndef MerlFile_h
#define MerlFile_h

#include "MaterialFile.h"

class vtkTabulatedBRDF;

namespace measuredbrdf
{
constexpr const char* MerlFormat = "MERL binary";

/// Whether the first twelve bytes could be the three sizes (they need not match the file's).
bool LooksLikeMerl(const FileBytes& file);

MaterialFile ReadMerl(const FileBytes& file);

/// Throws where the table can't be held by the format.
void WriteMerl(vtkTabulatedBRDF* table, const std::string& path);
} // namespace measuredbrdf

#endif
