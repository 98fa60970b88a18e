// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Objects made once and shared by all mappers that hold them.
 */

#ifndef SharedObjects_h
#define SharedObjects_h

#include "BackgroundThreads.h"
#include "vtkSmartPointer.h"

#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace measuredbrdf
{
/**
 * Objects by what they were made from, for as long as somebody else holds them. Keys hold
 * modification times, which are never used twice: a recycled address does no harm.
 *
 * Windows may be drawn by different threads, so look-ups are locked. The map owns its objects:
 * VTK's weak pointers can't be read while another thread deletes the object. What only the map
 * still holds goes when the next one is made, or at the next Sweep.
 *
 * They are released when the process ends, once no thread uses them any more; the map stays, for
 * statics of the program that go later.
 */
template <typename Key, typename T>
class SharedObjects
{
public:
  /// The object, made now if there is none; make may return null. The lock is not held meanwhile:
  /// of two threads that make the same, both get the first.
  template <typename Make>
  vtkSmartPointer<T> Find(const Key& key, const Make& make)
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      const auto it = this->Objects.find(key);
      if (it != this->Objects.end())
      {
        return it->second;
      }
    }
    this->Sweep(); // before there is more, but not for each of many actors
    vtkSmartPointer<T> made = make();
    if (made)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      made = this->Objects.emplace(key, made).first->second;
    }
    return made;
  }

  /// Release what nobody else holds.
  void Sweep()
  {
    std::vector<vtkSmartPointer<T>> released; // after the lock
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (auto it = this->Objects.begin(); it != this->Objects.end();)
    {
      if (it->second->GetReferenceCount() == 1)
      {
        released.push_back(it->second);
        it = this->Objects.erase(it);
      }
      else
      {
        ++it;
      }
    }
  }

  /// Release all of them: for the end of the process.
  void Clear()
  {
    std::map<Key, vtkSmartPointer<T>> released; // after the lock
    const std::lock_guard<std::mutex> lock(this->Mutex);
    released.swap(this->Objects);
  }

  /// The only one of this type, which is released when the process ends.
  static SharedObjects& Get()
  {
    static SharedObjects& objects = []() -> SharedObjects&
    {
      auto* made = new SharedObjects;
      ReleaseAtExit([made]() { made->Clear(); });
      return *made;
    }();
    return objects;
  }

private:
  std::mutex Mutex;
  std::map<Key, vtkSmartPointer<T>> Objects;
};

/// The same for objects that std::shared_ptr counts: by their keys, for as long as somebody holds
/// them. Windows may be drawn by different threads.
template <typename Key, typename T>
class HeldObjects
{
public:
  std::shared_ptr<T> Find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const auto known = this->Objects.find(key);
    return known == this->Objects.end() ? nullptr : known->second.lock();
  }

  /// The object, made now if nobody holds one: whoever asks for a key has the same.
  template <typename Make>
  std::shared_ptr<T> FindOrMake(const Key& key, const Make& make)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::shared_ptr<T> found = this->Objects[key].lock();
    if (!found)
    {
      this->Forget();
      found = make();
      this->Objects[key] = found;
    }
    return found;
  }

  /// Those that nobody holds any more are forgotten. Null: nothing is added.
  void Add(const Key& key, const std::shared_ptr<T>& object)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Forget();
    if (object)
    {
      this->Objects[key] = object;
    }
  }

private:
  void Forget()
  {
    for (auto it = this->Objects.begin(); it != this->Objects.end();)
    {
      it = it->second.expired() ? this->Objects.erase(it) : std::next(it);
    }
  }

  std::mutex Mutex;
  std::map<Key, std::weak_ptr<T>> Objects;
};
} // namespace measuredbrdf

#endif
