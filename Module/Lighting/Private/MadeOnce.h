// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Values that threads share, each made once by whoever asks first. Private to the module.
 */

#ifndef MadeOnce_h
#define MadeOnce_h

#include <chrono>
#include <map>
#include <memory>
#include <mutex>

namespace measuredbrdf
{
/// Not to be asked from within a parallel loop (vtkSMPTools): a thread that makes a value may take
/// over another part of such a loop while it waits for its own.
template <typename Key, typename Value>
class MadeOnce
{
public:
  using Pointer = std::shared_ptr<const Value>;

  /// The value, from make() where there is none. Other threads that ask for the same wait until
  /// goOn(), which they call every now and then, says false: null. Where make gives null, or
  /// throws, the next one makes it.
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
  std::map<Key, std::shared_ptr<Entry>> Entries;
};
} // namespace measuredbrdf

#endif
