// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Objects made once and shared by all mappers that hold them. Private to the rendering room.
 */

#ifndef SharedObjects_h
#define SharedObjects_h

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <iterator>
#include <map>

namespace measuredbrdf
{
// Objects by what they were made from, for as long as somebody holds them. Keys hold modification
// times, which are never used twice: a recycled address does no harm.
template <typename Key, typename T>
class SharedObjects
{
public:
  template <typename Make>
  vtkSmartPointer<T> Find(const Key& key, const Make& make)
  {
    if (this->Objects.size() >= this->SweepAt) // not for each of many actors
    {
      for (auto it = this->Objects.begin(); it != this->Objects.end();)
      {
        it = it->second ? std::next(it) : this->Objects.erase(it);
      }
      this->SweepAt = 2 * this->Objects.size() + 16;
    }
    auto it = this->Objects.find(key);
    if (it != this->Objects.end() && it->second)
    {
      return it->second.Get();
    }
    vtkSmartPointer<T> made = make();
    if (made)
    {
      this->Objects[key] = made;
    }
    return made;
  }

private:
  std::map<Key, vtkWeakPointer<T>> Objects;
  std::size_t SweepAt = 16;
};
} // namespace measuredbrdf

#endif
