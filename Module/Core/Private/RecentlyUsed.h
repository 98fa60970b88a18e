// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A bounded cache: values by their keys, those that were used last.
 */

#ifndef RecentlyUsed_h
#define RecentlyUsed_h

#include <cstddef>
#include <iterator>
#include <list>
#include <map>
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
    const auto found = this->Places.find(key);
    if (found == this->Places.end())
    {
      return nullptr;
    }
    this->Entries.splice(this->Entries.begin(), this->Entries, found->second);
    return &found->second->second;
  }

  /// The value of a key, a new one where there is none. The one used longest ago goes for it.
  Value& operator[](const Key& key)
  {
    if (Value* known = this->Find(key))
    {
      return *known;
    }
    this->Entries.emplace_front(key, Value());
    try
    {
      this->Places.emplace(key, this->Entries.begin());
    }
    catch (...) // no memory
    {
      this->Entries.pop_front();
      throw;
    }
    while (this->Entries.size() > this->Most)
    {
      this->Places.erase(this->Entries.back().first);
      this->Entries.pop_back();
    }
    return this->Entries.front().second;
  }

  /// Remove all whose key and value the condition holds for.
  template <typename Condition>
  void RemoveIf(const Condition& condition)
  {
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      const auto next = std::next(entry);
      if (condition(entry->first, entry->second))
      {
        this->Places.erase(entry->first);
        this->Entries.erase(entry);
      }
      entry = next;
    }
  }

  void Clear()
  {
    this->Places.clear();
    this->Entries.clear();
  }

  /// How many are kept from now on, at least one.
  void SetMost(std::size_t most) { this->Most = most; }

  std::size_t GetSize() const { return this->Entries.size(); }

  ///@{
  /// Pairs of keys and values, the one used last first.
  auto begin() const { return this->Entries.begin(); }
  auto end() const { return this->Entries.end(); }
  ///@}

private:
  using Entry = std::pair<Key, Value>;
  std::list<Entry> Entries;
  std::map<Key, typename std::list<Entry>::iterator> Places;
  std::size_t Most;
};
} // namespace measuredbrdf

#endif
