// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * For commands that take materials and environments: names of the catalog stand for the files that
 * were fetched.
 */

#ifndef FetchAdvice_h
#define FetchAdvice_h

#include <string>

namespace tool
{
/// The file to read for an argument: the fetched one where the argument is a name of the catalog,
/// of that kind ("material", "environment"), and no file of that name is there; else the argument.
std::string ResolveFetched(const std::string& argument, const std::string& kind);

/// Where an argument names no file: how to get the published one of that name, as a sentence that
/// begins with a blank; "" where there is none.
std::string GetFetchAdvice(const std::string& argument, const std::string& kind);
} // namespace tool

#endif
