// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ContentHash.h"

#define XXH_INLINE_ALL // the library itself is not needed
#include <xxhash.h>

#include <cstdio>

namespace measuredbrdf
{
void ContentHash::Add(const void* data, std::size_t bytes)
{
  const XXH128_hash_t piece = XXH3_128bits(data, bytes);
  const std::uint64_t chain[5] = { this->State[0], this->State[1], piece.low64, piece.high64,
    bytes };
  const XXH128_hash_t sum = XXH3_128bits(chain, sizeof(chain));
  this->State[0] = sum.low64;
  this->State[1] = sum.high64;
}

std::string ContentHash::GetText() const
{
  char text[40];
  std::snprintf(text, sizeof(text), "%016llx%016llx",
    static_cast<unsigned long long>(this->State[1]),
    static_cast<unsigned long long>(this->State[0]));
  return text;
}
} // namespace measuredbrdf
