// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the process keeps for whoever asks next.
 */

#ifndef SharedCache_h
#define SharedCache_h

#include "BackgroundThreads.h"
#include "RecentlyUsed.h"

#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

namespace measuredbrdf
{
/// A RecentlyUsed that any thread may call.
template <typename Key, typename Value>
class SharedCache
{
public:
  explicit SharedCache(std::size_t most)
    : Values(most)
  {
  }

  /// One for the process. Threads of a program may ask it after the statics are gone, so it stays;
  /// its values go when the process ends (ReleaseAtExit).
  static SharedCache& MakeForProcess(std::size_t most)
  {
    auto* made = new SharedCache(most);
    ReleaseAtExit([made]() { made->Clear(); });
    return *made;
  }

  /// A copy of what is known.
  std::optional<Value> Find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const Value* known = this->Values.Find(key);
    return known ? std::optional<Value>(*known) : std::nullopt;
  }

  void Put(const Key& key, Value value)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Values[key] = std::move(value);
  }

  /// What is known is the caller's own from now on: others find nothing until it is put back.
  std::optional<Value> Take(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    Value* known = this->Values.Find(key);
    std::optional<Value> taken = known ? std::optional<Value>(std::move(*known)) : std::nullopt;
    this->Values.RemoveIf([&key](const Key& other, const Value&) { return other == key; });
    return taken;
  }

  void Clear()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Values.Clear();
  }

private:
  std::mutex Mutex;
  RecentlyUsed<Key, Value> Values;
};
} // namespace measuredbrdf

#endif
