// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sha256.h"

#include <algorithm>
#include <cstring>

namespace
{
// FIPS 180-4, section 4.2.2.
constexpr std::uint32_t K[64] = { 0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b,
  0x59f111f1, 0x923f82a4, 0xab1c5ed5, 0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74,
  0x80deb1fe, 0x9bdc06a7, 0xc19bf174, 0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f,
  0x4a7484aa, 0x5cb0a9dc, 0x76f988da, 0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3,
  0xd5a79147, 0x06ca6351, 0x14292967, 0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354,
  0x766a0abb, 0x81c2c92e, 0x92722c85, 0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819,
  0xd6990624, 0xf40e3585, 0x106aa070, 0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3,
  0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3, 0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa,
  0xa4506ceb, 0xbef9a3f7, 0xc67178f2 };

//------------------------------------------------------------------------------
std::uint32_t Rotate(std::uint32_t x, int n) { return (x >> n) | (x << (32 - n)); }
}

namespace tool
{
//------------------------------------------------------------------------------
void Sha256::AddBlock(const unsigned char* block) // section 6.2.2
{
  std::uint32_t w[64];
  for (int t = 0; t < 16; ++t)
  {
    w[t] = std::uint32_t(block[4 * t]) << 24 | std::uint32_t(block[4 * t + 1]) << 16 |
           std::uint32_t(block[4 * t + 2]) << 8 | std::uint32_t(block[4 * t + 3]);
  }
  for (int t = 16; t < 64; ++t)
  {
    const std::uint32_t s0 = Rotate(w[t - 15], 7) ^ Rotate(w[t - 15], 18) ^ (w[t - 15] >> 3);
    const std::uint32_t s1 = Rotate(w[t - 2], 17) ^ Rotate(w[t - 2], 19) ^ (w[t - 2] >> 10);
    w[t] = s1 + w[t - 7] + s0 + w[t - 16];
  }
  auto [a, b, c, d, e, f, g, h] = this->Hash;
  for (int t = 0; t < 64; ++t)
  {
    const std::uint32_t s1 = Rotate(e, 6) ^ Rotate(e, 11) ^ Rotate(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + K[t] + w[t];
    const std::uint32_t s0 = Rotate(a, 2) ^ Rotate(a, 13) ^ Rotate(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + t2;
  }
  const std::uint32_t sums[8] = { a, b, c, d, e, f, g, h };
  for (int k = 0; k < 8; ++k)
  {
    this->Hash[k] += sums[k];
  }
}

//------------------------------------------------------------------------------
void Sha256::Add(const void* bytes, std::size_t count)
{
  const auto* next = static_cast<const unsigned char*>(bytes);
  while (count > 0)
  {
    const std::size_t waiting = this->Count % BlockSize;
    const std::size_t taken = std::min(count, BlockSize - waiting);
    if (taken == BlockSize)
    {
      this->AddBlock(next);
    }
    else
    {
      std::memcpy(this->Waiting.data() + waiting, next, taken);
      if (waiting + taken == BlockSize)
      {
        this->AddBlock(this->Waiting.data());
      }
    }
    this->Count += taken;
    next += taken;
    count -= taken;
  }
}

//------------------------------------------------------------------------------
std::string Sha256::GetText() // padding: section 5.1.1
{
  const std::uint64_t bits = 8 * this->Count;
  const unsigned char one = 0x80;
  const unsigned char zero = 0;
  this->Add(&one, 1);
  while (this->Count % BlockSize != BlockSize - 8)
  {
    this->Add(&zero, 1);
  }
  unsigned char length[8];
  for (int k = 0; k < 8; ++k)
  {
    length[k] = static_cast<unsigned char>(bits >> (56 - 8 * k));
  }
  this->Add(length, 8);

  std::string text;
  for (const std::uint32_t word : this->Hash)
  {
    for (int shift = 28; shift >= 0; shift -= 4)
    {
      text += "0123456789abcdef"[(word >> shift) & 15];
    }
  }
  return text;
}

//------------------------------------------------------------------------------
bool IsSha256(const std::string& text)
{
  return text.size() == 64 && text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
}
} // namespace tool
