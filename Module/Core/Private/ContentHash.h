// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A 128-bit hash of data. Equal data has equal hashes; other data has the same hash with a
 * probability of 2^-128 (it is not a cryptographic hash, so collisions can be constructed). It
 * works at memory speed: four lanes of xxHash64's round (Collet, "XXH64 algorithm description",
 * github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md), folded into two words in two ways.
 */

#ifndef ContentHash_h
#define ContentHash_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace measuredbrdf
{
class ContentHash
{
public:
  /// The boundary between two pieces of data is part of the hash.
  void Add(const void* data, std::size_t bytes)
  {
    const char* at = static_cast<const char*>(data);
    std::uint64_t lanes[4] = { Prime1, Prime2, Prime3, ~Prime1 };
    std::size_t left = bytes;
    for (; left >= 32; left -= 32, at += 32)
    {
      std::uint64_t words[4];
      std::memcpy(words, at, 32);
      for (int k = 0; k < 4; ++k)
      {
        lanes[k] = Round(lanes[k], words[k]);
      }
    }
    for (int k = 0; left > 0; ++k)
    {
      const std::size_t count = std::min<std::size_t>(8, left);
      std::uint64_t word = 0;
      std::memcpy(&word, at, count);
      lanes[k] = Round(lanes[k], word);
      left -= count;
      at += count;
    }
    this->State[0] = Mix(this->State[0] ^ bytes);
    this->State[1] = Mix(this->State[1] + bytes);
    for (int k = 0; k < 4; ++k)
    {
      this->State[0] = Mix(this->State[0] ^ lanes[k]);
      this->State[1] = Round(this->State[1], lanes[3 - k]);
    }
  }

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
  std::string GetText() const
  {
    char text[40];
    std::snprintf(text, sizeof(text), "%016llx%016llx",
      static_cast<unsigned long long>(Mix(this->State[0] ^ this->State[1])),
      static_cast<unsigned long long>(Mix(this->State[1])));
    return text;
  }

private:
  static constexpr std::uint64_t Prime1 = 0x9e3779b185ebca87u;
  static constexpr std::uint64_t Prime2 = 0xc2b2ae3d27d4eb4fu;
  static constexpr std::uint64_t Prime3 = 0x165667b19e3779f9u;

  // A bijection of each argument while the other is held: one changed word changes its lane.
  static std::uint64_t Round(std::uint64_t lane, std::uint64_t word)
  {
    lane += word * Prime2;
    return ((lane << 31) | (lane >> 33)) * Prime1;
  }

  // XXH64's last step: high bits down, bijective.
  static std::uint64_t Mix(std::uint64_t x)
  {
    x = (x ^ (x >> 33)) * Prime2;
    x = (x ^ (x >> 29)) * Prime3;
    return x ^ (x >> 32);
  }

  std::uint64_t State[2] = { Prime3, Prime2 };
};
} // namespace measuredbrdf

#endif
