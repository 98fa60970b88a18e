// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The one way in which the module and its tool write files: whole or not at all.
 */

#ifndef WholeFile_h
#define WholeFile_h

#include <string>
#include <string_view>

namespace measuredbrdf
{
/**
 * Where nothing can be written, std::runtime_error: "PATH: cannot be written: REASON".
 */
void CheckWritePlace(const std::string& path);

/**
 * Path holds the bytes afterwards, or what it held before and std::runtime_error says why.
 *
 * The bytes go to a new file of a random name in the same folder, onto the disk (fsync), and take
 * path's place (rename) after all of that has succeeded, closing the file, too: file systems on a
 * network and quotas may tell then only. A symbolic link stays, and the file that it names is
 * written, whether it is there yet or not. A pipe or a device is written to. A file that is there
 * keeps its permissions, and has to be writable.
 */
void WriteWholeFile(const std::string& path, std::string_view bytes);
} // namespace measuredbrdf

#endif
