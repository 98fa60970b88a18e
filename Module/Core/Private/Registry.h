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
    if (std::any_of(this->All.begin(), this->All.end(), isSame))
    {
      return false;
    }
    this->All.emplace_back(item);
    return true;
  }

  /// Whether it was there. The module's own stay.
  bool Remove(T* item)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto found = std::find(this->All.begin() + this->Own, this->All.end(), item);
    const bool isThere = found != this->All.end();
    this->All.erase(found, isThere ? found + 1 : found);
    return isThere;
  }

  Items GetOwn()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return { this->All.begin(), this->All.begin() + this->Own };
  }

  /// In the order in which they were added.
  Items GetAdded()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return { this->All.begin() + this->Own, this->All.end() };
  }

  /// The module's own, then those that were added.
  Items GetAll()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->All;
  }

private:
  explicit Registry(Items own)
    : All(std::move(own))
    , Own(static_cast<std::ptrdiff_t>(this->All.size()))
  {
  }

  void Clear()
  {
    Items released; // after the lock
    const std::lock_guard<std::mutex> lock(this->Mutex);
    released.swap(this->All);
    this->Own = 0;
  }

  std::mutex Mutex;
  Items All; // the module's own first
  std::ptrdiff_t Own;
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
