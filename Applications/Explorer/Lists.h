// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What can be chosen from: what is built in, and files that were opened. Without Qt.
 */

#ifndef Lists_h
#define Lists_h

#include <string>
#include <vector>

namespace explorer
{
/// A line of a list.
struct Item
{
  std::string File; // name or path, as State has it
  std::string Name;
  std::string Kind; // heading
  std::string Source;
};

///@{
/// Built-in ones under their headings, and the opened files under theirs.
std::vector<Item> ListMaterials(const std::vector<std::string>& opened);
std::vector<Item> ListEnvironments(const std::vector<std::string>& opened);
std::vector<Item> ListMeshes(const std::string& opened);
///@}

///@{
/// Whether it is a built-in name.
bool IsEmbeddedMaterial(const std::string& name);
bool IsEmbeddedEnvironment(const std::string& name);
///@}
} // namespace explorer

#endif
