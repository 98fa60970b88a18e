// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A 128-bit hash of data, by XXH3 (Collet, github.com/Cyan4973/xxHash). Equal data has equal
 * hashes; other data has the same hash with a probability of 2^-128 (it is not a cryptographic
 * hash, so collisions can be constructed). It works at memory speed.
 */

#ifndef ContentHash_h
#define ContentHash_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace measuredbrdf
{
class ContentHash
{
public:
  /// The boundary between two pieces of data is part of the hash.
  void Add(const void* data, std::size_t bytes);

  /// A number, an enumerator or a bool: nothing with padding.
  template <typename T>
  void AddValue(T value)
  {
    this->Add(&value, sizeof(value));
  }

  template <typename T>
  void AddValues(const std::vector<T>& values)
  {
    this->Add(values.data(), values.size() * sizeof(T));
  }

  void AddText(const std::string& text) { this->Add(text.data(), text.size()); }

  /// 32 hexadecimal digits.
  std::string GetText() const;

private:
  std::uint64_t State[2] = { 0, 0 };
};
} // namespace measuredbrdf

#endif
