// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a file that is dropped into the explorer may be, by its name.
 */

#ifndef FileKinds_h
#define FileKinds_h

#include <string>
#include <vector>

namespace explorer
{
enum class FileKind
{
  Material,
  Environment,
  MaterialOrEnvironment,
  Mesh,
  State
};

/// Names without '/', '.' and '#' are materials. An ending that nobody knows is taken for a
/// material's: its reader says what it reads.
FileKind FindFileKind(const std::string& file);

///@{
/// Endings with their dots.
std::vector<std::string> GetMaterialExtensions();
const std::vector<std::string>& GetEnvironmentExtensions();
///@}
} // namespace explorer

#endif
