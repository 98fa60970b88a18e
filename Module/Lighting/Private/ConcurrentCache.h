// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Values that threads share, those asked for last. The first thread that asks for a value makes it.
 */

#ifndef ConcurrentCache_h
#define ConcurrentCache_h

#include "RecentlyUsed.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>

namespace measuredbrdf
{
/// Do not use this inside a parallel loop (vtkSMPTools): a thread that makes a value may execute
/// another part of that loop while it waits for its own parallel loop.
template <typename Key, typename Value>
class ConcurrentCache
{
public:
  using Pointer = std::shared_ptr<const Value>;

  /// More values are not kept; whoever has one keeps it.
  static constexpr std::size_t Most = 32;

  /// The value, made by make() if there is none. Other threads that ask for the same value wait.
  /// They call goOn() regularly and get null once it returns false. If make returns null or throws,
  /// the next thread makes the value.
  template <typename GoOn, typename Make>
  Pointer Get(const Key& key, const GoOn& goOn, const Make& make)
  {
    const std::shared_ptr<Entry> entry = this->Find(key);
    std::unique_lock<std::timed_mutex> lock(entry->Making, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(10)))
    {
      if (!goOn())
      {
        return nullptr;
      }
    }
    if (!entry->Made)
    {
      entry->Made = make();
    }
    return entry->Made;
  }

private:
  struct Entry
  {
    std::timed_mutex Making;
    Pointer Made;
  };

  std::shared_ptr<Entry> Find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    std::shared_ptr<Entry>& entry = this->Entries[key];
    if (!entry)
    {
      entry = std::make_shared<Entry>();
    }
    return entry;
  }

  std::mutex Access;
  RecentlyUsed<Key, std::shared_ptr<Entry>> Entries{ Most };
};
} // namespace measuredbrdf

#endif
