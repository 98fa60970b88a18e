// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Numbers and tensor trees in texts of BSDF XML files. Private to the IO room.
 */

#ifndef BsdfXmlTree_h
#define BsdfXmlTree_h

#include "vtkTensorTreeBRDF.h"

#include <string>
#include <string_view>

namespace measuredbrdf
{
/// The next number or brace, off the front; empty at the end. White space and commas lie between.
std::string_view TakeBsdfWord(std::string_view& text);

/// A whole word as a finite number, whatever the locale; false for any other.
bool ToBsdfNumber(std::string_view word, double& number);

/// The first two whole numbers with nothing but a comma between; "" if there are none.
std::string FindDecimalComma(std::string_view text);

/// A tree from nested braces. Throws std::runtime_error that says what is wrong with it.
vtkTensorTreeBRDF::Tree ParseBsdfTree(std::string_view text, int dimensions);
} // namespace measuredbrdf

#endif
