// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchCatalog.h"

#include "FetchCatalogData.h" // made of FetchCatalog.json
#include "MeasuredBRDFToolVersion.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <list>

namespace fs = std::filesystem;

namespace
{
using Json = nlohmann::json;

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
// What a file does not say itself, its collection says for all.
tool::FetchEntry ReadEntry(
  const Json& all, const Json& file, const tool::FetchCollection* collection)
{
  const std::string name = file.is_string() ? file : file.at("name");
  const Json own = file.is_string() ? Json::object() : file;
  return { Fill(all.at("entry"), name), Fill(all.at("file"), name), Fill(all.at("url"), name),
    Fill(all.at("page"), name), own.value("size", all.value("size", std::uint64_t(0))),
    all.at("limit"), own.value("sha256", ""), own.value("sum", ""), collection };
}
}

namespace tool
{
//------------------------------------------------------------------------------
const std::vector<FetchEntry>& GetFetchCatalog()
{
  static std::list<FetchCollection> collections;
  static const std::vector<FetchEntry> entries = []()
  {
    std::vector<FetchEntry> read;
    const Json all = Json::parse(FetchCatalogData);
    for (const Json& data : all.at("collections"))
    {
      collections.push_back({ data.at("id"), data.at("title"), data.at("kind"), data.at("licence"),
        data.at("licence_url"), data.at("terms"), data.value("begins_with", "") });
      for (const Json& file : data.at("files"))
      {
        read.push_back(ReadEntry(data, file, &collections.back()));
      }
    }
    return read;
  }();
  return entries;
}

//------------------------------------------------------------------------------
const FetchEntry* FindFetchEntry(const std::string& name)
{
  const std::vector<FetchEntry>& entries = GetFetchCatalog();
  const auto found = std::find_if(entries.begin(), entries.end(),
    [&name](const FetchEntry& entry) { return entry.Name == name || entry.File == name; });
  return found == entries.end() ? nullptr : &*found;
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
