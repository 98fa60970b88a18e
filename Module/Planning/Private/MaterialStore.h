// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What plans of one material have in common, from one plan to the next. Private to the module.
 */

#ifndef MaterialStore_h
#define MaterialStore_h

#include "vtkRadianceIntegrator.h"

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace measuredbrdf
{
/// Materials by their content (vtkBRDF::GetContentKey), those planned for last. What is taken is
/// nobody else's until it is put back: another thread makes its own meanwhile. Safe to use from
/// several threads.
class MaterialStore
{
public:
  using Parts = std::shared_ptr<vtkRadianceIntegrator::Precomputation>;

  /// The program's, released when the process ends. It keeps at most 16 MB.
  static MaterialStore& Get();

  explicit MaterialStore(std::size_t mostBytes)
    : MostBytes(mostBytes)
  {
  }

  /// What is known of it, or nothing yet; never null.
  Parts Take(const std::string& key);

  /// Only whole: nothing that was aborted. Trimmed to what most plans need. What was put back
  /// longest ago goes where there is too much.
  void PutBack(const std::string& key, Parts parts);

private:
  const std::size_t MostBytes;
  std::mutex Mutex;
  std::list<std::pair<std::string, Parts>> Entries; // the last one first
};
} // namespace measuredbrdf

#endif
