// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Materials to archives and back: the one place that knows what each representation is made of.
 */

#ifndef MaterialExchange_h
#define MaterialExchange_h

#include "MaterialArchive.h"
#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace measuredbrdf
{
/**
 * To call before an array's values are read: throws std::runtime_error where they are more than a
 * representation takes.
 */
void CheckShape(const std::string& representation, const std::vector<int>& shape);

/// Throws std::runtime_error naming what can't be stored.
MaterialArchive ToArchive(vtkBRDF* brdf);

/// Throws std::runtime_error naming the field that is missing or out of range.
vtkSmartPointer<vtkBRDF> FromArchive(MaterialArchive archive);
} // namespace measuredbrdf

#endif
