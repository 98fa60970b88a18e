// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A list of the module's own objects of one kind, and of those that a program adds: formats,
 * models, methods. Any thread may use it.
 */

#ifndef Registry_h
#define Registry_h

#include "BackgroundThreads.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace measuredbrdf
{
template <typename T>
class Registry
{
public:
  using Items = std::vector<vtkSmartPointer<T>>;

  /// One for the process's life. At its end the objects go, and the registry stays, empty.
  static Registry& MakeShared(Items own)
  {
    auto* registry = new Registry(std::move(own));
    ReleaseAtExit([registry]() { registry->Clear(); });
    return *registry;
  }

  /// A new object of each type.
  template <class... Types>
  static Items Make()
  {
    return { vtkSmartPointer<Types>::New()... };
  }

  /// Whether it was added: none has its name, as getName tells it.
  template <typename GetName>
  bool Add(T* item, const GetName& getName)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const std::string name = getName(item);
    const auto isSame = [&](const auto& other)
    { return other == item || getName(other.Get()) == name; };
    if (std::any_of(this->Own.begin(), this->Own.end(), isSame) ||
        std::any_of(this->Added.begin(), this->Added.end(), isSame))
    {
      return false;
    }
    this->Added.emplace_back(item);
    return true;
  }

  /// Whether it was there. The module's own stay.
  bool Remove(T* item)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = std::find(this->Added.begin(), this->Added.end(), item);
    if (found == this->Added.end())
    {
      return false;
    }
    this->Added.erase(found);
    return true;
  }

  const Items& GetOwn() const { return this->Own; }

  /// In the order in which they were added.
  Items GetAdded()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Added;
  }

  /// The module's own, then those that were added.
  Items GetAll()
  {
    Items all = this->Own;
    const Items added = this->GetAdded();
    all.insert(all.end(), added.begin(), added.end());
    return all;
  }

private:
  explicit Registry(Items own)
    : Own(std::move(own))
  {
  }

  void Clear()
  {
    Items released[2]; // after the lock
    const std::lock_guard<std::mutex> lock(this->Mutex);
    released[0].swap(this->Own);
    released[1].swap(this->Added);
  }

  std::mutex Mutex;
  Items Own;
  Items Added;
};

/// "a, b or c", as getName tells them.
template <typename Items, typename GetName>
std::string JoinNames(const Items& items, const GetName& getName)
{
  std::string line;
  for (std::size_t k = 0; k < items.size(); ++k)
  {
    line += (k == 0 ? "" : k + 1 < items.size() ? ", " : " or ") + getName(items[k]);
  }
  return line;
}
} // namespace measuredbrdf

#endif
