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

template <typename T>
void Append(const std::vector<const std::vector<T>*>& arrays, std::string& bytes)
{
  for (const std::vector<T>* array : arrays)
  {
    bytes.append(reinterpret_cast<const char*>(array->data()), array->size() * sizeof(T));
  }
}
}

// How many numbers, arrays and lists of texels there are, the numbers, the lengths of the others,
// the others.
std::string WriteTableBytes(const std::vector<std::uint64_t>& numbers,
  const std::vector<const std::vector<float>*>& arrays,
  const std::vector<const std::vector<std::uint32_t>*>& texels)
{
  std::vector<std::uint64_t> header = { numbers.size(), arrays.size(), texels.size() };
  header.insert(header.end(), numbers.begin(), numbers.end());
  for (const std::vector<float>* array : arrays)
  {
    header.push_back(array->size());
  }
  for (const std::vector<std::uint32_t>* list : texels)
  {
    header.push_back(list->size());
  }
  std::string bytes(
    reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint64_t));
  Append(arrays, bytes);
  Append(texels, bytes);
  return bytes;
}

bool ReadTableBytes(const std::string& bytes, TableParts& parts)
{
  Reader reader(bytes);
  std::vector<std::uint64_t> counts, lengths, lists;
  if (!reader.Read(3, counts) || !reader.Read(counts[0], parts.Numbers) ||
      !reader.Read(counts[1], lengths) || !reader.Read(counts[2], lists))
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
  parts.Texels.clear();
  for (const std::uint64_t length : lists)
  {
    parts.Texels.emplace_back();
    if (!reader.Read(length, parts.Texels.back()))
    {
      return false;
    }
  }
  return reader.IsAtEnd();
}
} // namespace measuredbrdf
