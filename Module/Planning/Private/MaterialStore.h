// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What plans of one material have in common, from one plan to the next. Private to the module.
 */

#ifndef MaterialStore_h
#define MaterialStore_h

#include "MaterialPrecomputation.h"
#include "vtkRadianceIntegrator.h"

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>

namespace measuredbrdf
{
/// Materials by their content (vtkBRDF::GetContentKey), those planned for last. What is taken is
/// nobody else's until it is put back: another thread makes its own meanwhile. Safe to use from
/// several threads.
class MaterialStore
{
public:
  using Parts = std::shared_ptr<vtkRadianceIntegrator::Precomputation>;

  /// The program's. It keeps at most so many bytes.
  static constexpr std::size_t MostBytes = 16000000;
  static MaterialStore& Get();

  explicit MaterialStore(std::size_t mostBytes)
    : Most(mostBytes)
  {
  }

  /// What is known of it, or nothing yet; never null.
  Parts Take(const std::string& key);

  /// Only whole: nothing that was aborted. Trimmed to what most plans need.
  void PutBack(const std::string& key, Parts parts);

  std::size_t GetBytes();

  void Clear();

private:
  struct Entry
  {
    std::string Key;
    Parts Material;
    std::size_t Bytes;
  };
  void TrimOldOnes();

  std::mutex Mutex;
  std::list<Entry> Entries; // the last one first
  std::size_t Most;
};
} // namespace measuredbrdf

#endif
