// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Bounded caches: values by their keys, those that were used last.
 */

#ifndef RecentlyUsed_h
#define RecentlyUsed_h

#include "BackgroundThreads.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <list>
#include <mutex>
#include <optional>
#include <utility>

namespace measuredbrdf
{
template <typename Key, typename Value>
class RecentlyUsed
{
public:
  explicit RecentlyUsed(std::size_t most)
    : Most(most)
  {
  }
  RecentlyUsed(const RecentlyUsed&) = delete;
  void operator=(const RecentlyUsed&) = delete;

  /// Null where it is not known. Stays valid while no other key is added.
  Value* Find(const Key& key)
  {
    const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&key](const Entry& entry) { return entry.first == key; });
    if (found == this->Entries.end())
    {
      return nullptr;
    }
    this->Entries.splice(this->Entries.begin(), this->Entries, found);
    return &found->second;
  }

  /// The value of a key, a new one where there is none. What was used longest ago and is too many
  /// goes to `surplus`, for the caller to destroy.
  Value& Get(const Key& key, std::list<std::pair<Key, Value>>& surplus)
  {
    if (!this->Find(key))
    {
      this->Entries.emplace_front(key, Value());
    }
    while (this->Entries.size() > this->Most)
    {
      surplus.splice(surplus.end(), this->Entries, std::prev(this->Entries.end()));
    }
    return this->Entries.front().second;
  }

  Value& operator[](const Key& key)
  {
    std::list<Entry> surplus;
    return this->Get(key, surplus);
  }

  void Remove(const Key& key)
  {
    if (this->Find(key))
    {
      this->Entries.pop_front();
    }
  }

  void Clear() { this->TakeAll(); }

  /// All, for the caller to destroy.
  std::list<std::pair<Key, Value>> TakeAll() { return std::exchange(this->Entries, {}); }

  std::size_t GetSize() const { return this->Entries.size(); }

  ///@{
  /// Pairs of keys and values, the one used last first.
  auto begin() const { return this->Entries.begin(); }
  auto end() const { return this->Entries.end(); }
  ///@}

private:
  using Entry = std::pair<Key, Value>;
  std::list<Entry> Entries; // few: they are searched one by one
  std::size_t Most;
};

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
    std::list<std::pair<Key, Value>> surplus; // destroyed, as what is replaced, after the lock
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::swap(this->Values.Get(key, surplus), value);
  }

  /// What is known is the caller's own from now on: others find nothing until it is put back.
  std::optional<Value> Take(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    Value* known = this->Values.Find(key);
    std::optional<Value> taken = known ? std::optional<Value>(std::move(*known)) : std::nullopt;
    this->Values.Remove(key);
    return taken;
  }

  void Clear()
  {
    std::list<std::pair<Key, Value>> all; // likewise
    const std::lock_guard<std::mutex> lock(this->Mutex);
    all = this->Values.TakeAll();
  }

private:
  std::mutex Mutex;
  RecentlyUsed<Key, Value> Values;
};
} // namespace measuredbrdf

#endif
