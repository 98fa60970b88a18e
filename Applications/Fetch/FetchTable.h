// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The catalog as a table for people, or as JSON.
 */

#ifndef FetchTable_h
#define FetchTable_h

#include <string>
#include <vector>

namespace tool
{
/// Print the entries whose names hold one of the parts; all where there are none. Throws Error
/// where nothing is left.
void PrintFetchCatalog(const std::vector<std::string>& parts, bool json);
} // namespace tool

#endif
