// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Numbered things with errors, those of the largest first, but not sorted more finely than by a
 * fourth of an octave: adding and taking one costs a few instructions.
 */

#ifndef ErrorQueue_h
#define ErrorQueue_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace measuredbrdf
{
class ErrorQueue
{
public:
  ErrorQueue() { this->Clear(); }

  void Clear()
  {
    this->Latest.fill(None);
    this->Top = 0;
    this->Count = 0;
  }
  bool IsEmpty() const { return this->Count == 0; }

  /// error >= 0; each number is in the queue once at most.
  void Add(float error, std::uint32_t number)
  {
    if (number >= this->Before.size())
    {
      this->Before.resize(2 * static_cast<std::size_t>(number) + 1024);
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, &error, sizeof(bits));
    const std::uint32_t bucket = bits >> 21; // the exponent and two digits
    this->Before[number] = this->Latest[bucket];
    this->Latest[bucket] = number;
    this->Top = bucket > this->Top ? bucket : this->Top;
    ++this->Count;
  }

  /// Of a queue that is not empty.
  std::uint32_t Take()
  {
    while (this->Latest[this->Top] == None)
    {
      --this->Top;
    }
    const std::uint32_t number = this->Latest[this->Top];
    this->Latest[this->Top] = this->Before[number];
    --this->Count;
    return number;
  }

private:
  static constexpr std::uint32_t None = 0xffffffff;
  std::array<std::uint32_t, 1024> Latest; // of each bucket
  std::vector<std::uint32_t> Before;      // that in the same bucket, by number
  std::uint32_t Top = 0;
  std::size_t Count = 0;
};
} // namespace measuredbrdf

#endif
