// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Tables of radiance as bytes, for files that the same version of the code on the same machine
 * reads again. Private to the module.
 */

#ifndef TableBytes_h
#define TableBytes_h

#include <cstdint>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// What a table is made of.
struct TableParts
{
  std::vector<std::uint64_t> Numbers;
  std::vector<std::vector<float>> Arrays; // of finite values
  std::vector<std::vector<std::uint32_t>> Texels;
};

std::string WriteTableBytes(const std::vector<std::uint64_t>& numbers,
  const std::vector<const std::vector<float>*>& arrays,
  const std::vector<const std::vector<std::uint32_t>*>& texels = {});

/// False where the bytes are no such parts; nothing larger than they are is ever allocated.
bool ReadTableBytes(const std::string& bytes, TableParts& parts);
} // namespace measuredbrdf

#endif
