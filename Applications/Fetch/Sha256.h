// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * SHA-256 of bytes and files, as FIPS 180-4 (2015) defines it. None of the libraries that the tool
 * is made with offers it.
 */

#ifndef Sha256_h
#define Sha256_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tool
{
/// Takes any number of bytes in any number of pieces.
class Sha256
{
public:
  void Add(const void* bytes, std::size_t count);

  /// The sum of what was added, as 64 hexadecimal digits in lower case; nothing can be added then.
  std::string GetText();

private:
  void AddBlock(const unsigned char* block);

  static constexpr std::size_t BlockSize = 64; // bytes
  std::array<std::uint32_t, 8> Hash = { 0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f,
    0x9b05688c, 0x1f83d9ab, 0x5be0cd19 }; // section 5.3.3
  std::array<unsigned char, BlockSize> Waiting{};
  std::uint64_t Count = 0; // bytes so far
};

/// Whether the text is 64 hexadecimal digits.
bool IsSha256(const std::string& text);
} // namespace tool

#endif
