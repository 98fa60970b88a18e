// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialStore.h"

#include "BackgroundThreads.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace measuredbrdf
{
namespace
{
constexpr int MostAngles = 12; // of views that kernels are kept for
constexpr int MostNodes = 64;  // but those of large tables
}

MaterialStore& MaterialStore::Get()
{
  static MaterialStore& store = []() -> MaterialStore&
  {
    auto* kept = new MaterialStore(MostBytes); // threads may still plan when statics go
    ReleaseAtExit([kept]() { kept->Clear(); });
    return *kept;
  }();
  return store;
}

MaterialStore::Parts MaterialStore::Take(const std::string& key)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto known = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&key](const Entry& entry) { return entry.Key == key; });
  if (key.empty() || known == this->Entries.end())
  {
    return std::make_shared<vtkRadianceIntegrator::Precomputation>();
  }
  Parts parts = std::move(known->Material);
  this->Entries.erase(known);
  return parts;
}

void MaterialStore::PutBack(const std::string& key, Parts parts)
{
  if (key.empty() || !parts)
  {
    return;
  }
  parts->Trim(MostAngles, MostNodes);
  const std::size_t bytes = parts->GetBytes();
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Entries.remove_if([&key](const Entry& entry) { return entry.Key == key; });
  this->Entries.push_front({ key, std::move(parts), bytes });
  this->TrimOldOnes();
  std::size_t sum = 0;
  for (auto it = this->Entries.begin(); it != this->Entries.end();)
  {
    sum += it->Bytes;
    it = sum > this->Most ? this->Entries.erase(it) : std::next(it);
  }
}

void MaterialStore::Clear()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Entries.clear();
}

// Before any material is forgotten: only the last ones, as many as fit into half of the bytes, keep
// what few plans need.
void MaterialStore::TrimOldOnes()
{
  const auto add = [](std::size_t bytes, const Entry& entry) { return bytes + entry.Bytes; };
  if (std::accumulate(this->Entries.begin(), this->Entries.end(), std::size_t(0), add) <=
      this->Most)
  {
    return;
  }
  std::size_t sum = 0;
  for (Entry& entry : this->Entries)
  {
    sum += entry.Bytes;
    if (sum > this->Most / 2)
    {
      entry.Material->Trim(MostAngles, MostNodes, false);
      entry.Bytes = entry.Material->GetBytes();
    }
  }
}

std::size_t MaterialStore::GetBytes()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  std::size_t sum = 0;
  for (const Entry& entry : this->Entries)
  {
    sum += entry.Bytes;
  }
  return sum;
}
} // namespace measuredbrdf
