// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TableBytes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace measuredbrdf
{
namespace
{
class Reader
{
public:
  explicit Reader(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  bool IsAtEnd() const { return this->At == this->Bytes.size(); }

  template <typename T>
  bool Read(std::uint64_t count, std::vector<T>& values)
  {
    if (count > (this->Bytes.size() - this->At) / sizeof(T))
    {
      return false;
    }
    values.resize(static_cast<std::size_t>(count));
    if (count > 0)
    {
      std::memcpy(values.data(), this->Bytes.data() + this->At, values.size() * sizeof(T));
    }
    this->At += values.size() * sizeof(T);
    return true;
  }

private:
  const std::string& Bytes;
  std::size_t At = 0;
};
}

// How many numbers and arrays there are, the numbers, the arrays' lengths, the arrays.
std::string WriteTableBytes(
  const std::vector<std::uint64_t>& numbers, const std::vector<const std::vector<float>*>& arrays)
{
  std::vector<std::uint64_t> header = { numbers.size(), arrays.size() };
  header.insert(header.end(), numbers.begin(), numbers.end());
  for (const std::vector<float>* array : arrays)
  {
    header.push_back(array->size());
  }
  std::string bytes(
    reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint64_t));
  for (const std::vector<float>* array : arrays)
  {
    bytes.append(reinterpret_cast<const char*>(array->data()), array->size() * sizeof(float));
  }
  return bytes;
}

bool ReadTableBytes(const std::string& bytes, TableParts& parts)
{
  Reader reader(bytes);
  std::vector<std::uint64_t> counts, lengths;
  if (!reader.Read(2, counts) || !reader.Read(counts[0], parts.Numbers) ||
      !reader.Read(counts[1], lengths))
  {
    return false;
  }
  parts.Arrays.clear();
  for (const std::uint64_t length : lengths)
  {
    parts.Arrays.emplace_back();
    std::vector<float>& array = parts.Arrays.back();
    if (!reader.Read(length, array) ||
        !std::all_of(array.begin(), array.end(), [](float value) { return std::isfinite(value); }))
    {
      return false;
    }
  }
  return reader.IsAtEnd();
}
} // namespace measuredbrdf
