// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchCatalog.h"

#include "FetchCatalogData.h" // made of FetchCatalog.json
#include "MeasuredBRDFToolVersion.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numeric>
#include <utility>

namespace fs = std::filesystem;

namespace
{
using Json = nlohmann::json;

// The largest number of edits at which a name is still near another one.
constexpr std::size_t NearEdits = 3;

//------------------------------------------------------------------------------
std::string Fill(std::string text, const std::string& name)
{
  const std::string mark = "{name}";
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += name.size())
  {
    text.replace(at, mark.size(), name);
  }
  return text;
}

//------------------------------------------------------------------------------
struct Catalog
{
  std::vector<std::unique_ptr<tool::FetchCollection>> Collections;
  std::vector<tool::FetchEntry> Entries;

  Catalog();
  void Add(const Json& data);
};

//------------------------------------------------------------------------------
Catalog::Catalog()
{
  const Json all = Json::parse(FetchCatalogData);
  for (const Json& data : all.at("collections"))
  {
    this->Add(data);
  }
}

//------------------------------------------------------------------------------
void Catalog::Add(const Json& data)
{
  auto collection = std::make_unique<tool::FetchCollection>();
  collection->Id = data.at("id");
  collection->Title = data.at("title");
  collection->Kind = data.at("kind");
  collection->Licence = data.at("licence");
  collection->LicenceUrl = data.at("licence_url");
  collection->Terms = data.at("terms");
  collection->NeedsAgreement = data.at("agreement");
  collection->BeginsWith = data.value("begins_with", "");
  for (const Json& file : data.at("files"))
  {
    const std::string name = file.is_string() ? file : file.at("name");
    tool::FetchEntry entry;
    entry.Name = Fill(data.at("entry"), name);
    entry.File = Fill(data.at("file"), name);
    entry.Url = Fill(data.at("url"), name);
    entry.Page = Fill(data.at("page"), name);
    entry.Member = Fill(data.value("member", ""), name);
    entry.ArchiveSize = data.value("archive_size", std::uint64_t(0));
    entry.Limit = data.at("limit");
    entry.Size = data.value("size", std::uint64_t(0));
    if (file.is_object())
    {
      entry.Size = file.value("size", entry.Size);
      entry.Sha256 = file.value("sha256", "");
      entry.SumKind = file.value("sum", "");
    }
    entry.Collection = collection.get();
    this->Entries.push_back(std::move(entry));
  }
  this->Collections.push_back(std::move(collection));
}

//------------------------------------------------------------------------------
const Catalog& GetCatalog()
{
  static const Catalog catalog;
  return catalog;
}

//------------------------------------------------------------------------------
// Insertions, deletions and replacements that turn one into the other (Levenshtein 1966).
std::size_t CountEdits(const std::string& from, const std::string& to)
{
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 1; i <= from.size(); ++i)
  {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= to.size(); ++j)
    {
      const std::size_t replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ replaced, row[j] + 1, row[j - 1] + 1 });
    }
  }
  return row.back();
}
}

namespace tool
{
//------------------------------------------------------------------------------
const std::vector<FetchEntry>& GetFetchCatalog() { return GetCatalog().Entries; }

//------------------------------------------------------------------------------
const FetchEntry* FindFetchEntry(const std::string& name)
{
  const std::vector<FetchEntry>& entries = GetFetchCatalog();
  const auto found = std::find_if(entries.begin(), entries.end(),
    [&name](const FetchEntry& entry) { return entry.Name == name || entry.File == name; });
  return found == entries.end() ? nullptr : &*found;
}

//------------------------------------------------------------------------------
std::vector<std::string> FindNearFetchNames(const std::string& name, std::size_t count)
{
  constexpr std::size_t longest = 100; // no name is; the work grows with the length
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const FetchEntry& entry : GetFetchCatalog())
  {
    const bool part = name.size() > NearEdits && entry.Name.find(name) != std::string::npos;
    const std::size_t edits = name.size() > longest ? longest : CountEdits(name, entry.Name);
    if (part || edits <= NearEdits)
    {
      near.emplace_back(part ? 0 : edits, entry.Name);
    }
  }
  std::stable_sort(
    near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(count, near.size()); ++k)
  {
    names.push_back(near[k].second);
  }
  return names;
}

//------------------------------------------------------------------------------
std::string GetFetchCache()
{
  const std::string subfolder = "/vtkMeasuredBRDF/vtkMeasuredBRDF-files";
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache == '/') // its specification demands an absolute path
  {
    return cache + subfolder;
  }
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.cache" + subfolder : "";
}

//------------------------------------------------------------------------------
std::string FindFetchedFile(const FetchEntry& entry)
{
  const std::string folder = GetFetchCache();
  const std::string path = folder + "/" + entry.File;
  std::error_code ignored;
  const bool there = !folder.empty() && fs::is_regular_file(fs::symlink_status(path, ignored));
  return there ? path : "";
}

//------------------------------------------------------------------------------
std::string ResolveFetched(const std::string& argument, const std::string& kind)
{
  std::error_code ignored;
  const FetchEntry* entry = FindFetchEntry(argument);
  if (!entry || entry->Name != argument || entry->Collection->Kind != kind ||
      fs::exists(argument, ignored))
  {
    return argument;
  }
  const std::string path = FindFetchedFile(*entry);
  return path.empty() ? argument : path;
}

//------------------------------------------------------------------------------
std::string GetFetchAdvice(const std::string& argument, const std::string& kind)
{
  std::error_code ignored;
  const FetchEntry* entry = FindFetchEntry(fs::path(argument).filename().string());
  if (!entry || entry->Collection->Kind != kind || fs::exists(argument, ignored))
  {
    return "";
  }
  if (!FindFetchedFile(*entry).empty())
  {
    return " It was fetched: say " + entry->Name;
  }
  return MEASUREDBRDF_WITH_CURL
           ? " 'measured-brdf fetch " + entry->Name + "' downloads it (" +
               entry->Collection->Licence + ")"
           : " It can be downloaded: " + entry->Page + " (" + entry->Collection->Licence + ")";
}
} // namespace tool
