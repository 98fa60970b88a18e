// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialStore.h"

#include "BackgroundThreads.h"
#include "MaterialPrecomputation.h"

#include <algorithm>
#include <iterator>

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
    auto* kept = new MaterialStore(16000000); // threads may still plan when statics go
    ReleaseAtExit([kept]() { kept->Entries.clear(); });
    return *kept;
  }();
  return store;
}

MaterialStore::Parts MaterialStore::Take(const std::string& key)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto known = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&key](const auto& entry) { return entry.first == key; });
  if (known == this->Entries.end())
  {
    return std::make_shared<vtkRadianceIntegrator::Precomputation>();
  }
  Parts parts = std::move(known->second);
  this->Entries.erase(known);
  return parts;
}

void MaterialStore::PutBack(const std::string& key, Parts parts)
{
  if (key.empty()) // it does not say what it is
  {
    return;
  }
  parts->Trim(MostAngles, MostNodes);
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Entries.remove_if([&key](const auto& entry) { return entry.first == key; });
  this->Entries.emplace_front(key, std::move(parts));
  std::size_t sum = 0;
  for (auto it = this->Entries.begin(); it != this->Entries.end();)
  {
    sum += it->second->GetBytes();
    it = sum > this->MostBytes ? this->Entries.erase(it) : std::next(it);
  }
}
} // namespace measuredbrdf
