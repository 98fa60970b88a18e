// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * OpenEXR allocates what a file's header claims before it reads; this looks at the claims first.
 */

#ifndef ExrHeader_h
#define ExrHeader_h

#include <string>

namespace measuredbrdf
{
class FileBytes;

constexpr const char ExrMagic[] = "\x76\x2f\x31\x01";

/**
 * The file begins with ExrMagic. Throws FileError, with the attribute and the byte, where an
 * attribute of an OpenEXR file's header claims more than the file holds. format: what the message
 * calls the file's format.
 */
void CheckExrHeader(const FileBytes& file, const std::string& format);
} // namespace measuredbrdf

#endif
