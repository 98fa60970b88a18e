// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Brings files of the catalog into a folder. A file is written, whole or not at all, once its
// SHA-256 is right. A sum that was taken from a first download stands in FILE.sha256, as the
// program sha256sum writes it.
#include "Download.h"
#include "FetchCatalog.h"
#include "Files.h"
#include "JsonReport.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDFReader.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <set>
#include <vector>

namespace fs = std::filesystem;

namespace
{
using Json = nlohmann::ordered_json;
using Entries = std::vector<const tool::FetchEntry*>;

struct FetchOptions
{
  std::vector<std::string> Names;
  bool IsList = false;
  bool AsJson = false;
  std::string Folder;  // of the user's, which must be there; "": the one in the user's cache
  std::string BaseUrl; // of a mirror; "": where the catalog says
  std::string Sha256;  // the user's own sum; "": the catalog's, or the recorded one
  bool TrustFirst = false;
  int Timeout = 60; // seconds
  int Retries = 2;
};

//------------------------------------------------------------------------------
// Whether a file is there. Throws Error where something else has its name.
bool HasFile(const std::string& path)
{
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    throw tool::Error(path + " is in the way: it is no regular file. It was left alone");
  }
  return fs::exists(status);
}

//------------------------------------------------------------------------------
std::string ReadFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  if (!file)
  {
    throw tool::Error(path + ": can't be read: " + std::strerror(errno));
  }
  return bytes;
}

//------------------------------------------------------------------------------
// The catalog's files are small: 35 MB at most.
std::string GetSha256(const std::string& bytes)
{
  unsigned char sum[32];
  if (EVP_Digest(bytes.data(), bytes.size(), sum, nullptr, EVP_sha256(), nullptr) != 1)
  {
    throw tool::Error("libcrypto gives no SHA-256");
  }
  std::string text;
  for (const unsigned char byte : sum)
  {
    char digits[3];
    std::snprintf(digits, sizeof(digits), "%02x", byte);
    text += digits;
  }
  return text;
}

//------------------------------------------------------------------------------
// The user's cache folder, made where it is missing.
std::string OpenCache()
{
  std::string path = tool::GetFetchCache();
  if (path.empty())
  {
    throw tool::Error("there is no folder for downloads (neither XDG_CACHE_HOME nor HOME is set); "
                      "name one with --to");
  }
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = path.find('/', end + 1);
    mkdir(path.substr(0, end).c_str(), 0700); // as XDG's specification says
  }
  struct stat status;
  if (lstat(path.c_str(), &status) != 0)
  {
    throw tool::Error(path + ": can't be used as a folder for downloads: " + std::strerror(errno));
  }
  if (!S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
      (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
  {
    throw tool::Error(path + ": not used for downloads: expected a folder of this user's to which "
                             "nobody else may write. Change that, or name a folder with --to");
  }
  return path;
}

/// A sum and who says so; "": not known.
struct KnownSum
{
  std::string Sum;
  std::string Source;
};

//------------------------------------------------------------------------------
KnownSum FindSum(
  const FetchOptions& options, const tool::FetchEntry& entry, const std::string& record)
{
  std::string given = options.Sha256;
  std::transform(given.begin(), given.end(), given.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!given.empty() && !entry.Sha256.empty() && entry.Sha256 != given)
  {
    tool::PrintNote(
      entry.Name + ": --sha256 is used; this program knows another sum, " + entry.Sha256);
  }
  if (!given.empty())
  {
    return { given, "--sha256" };
  }
  if (!entry.Sha256.empty() || !HasFile(record))
  {
    return { entry.Sha256, entry.SumKind == "copy"
                             ? "this program, of a copy that came from elsewhere"
                             : "this program, as others published it" };
  }
  const std::string recorded = ReadFile(record).substr(0, 64);
  if (recorded.size() != 64)
  {
    throw tool::Error(
      record + ": expected one line, the SHA-256 of the file beside it as sha256sum writes it");
  }
  return { recorded, "recorded at the first download: " + record };
}

//------------------------------------------------------------------------------
// Whether the right file is there already. Throws Error where another one is in the way; one in the
// cache is replaced.
bool IsDone(const std::string& path, const KnownSum& known, bool isCache)
{
  if (!HasFile(path) || (known.Sum.empty() && isCache))
  {
    return false;
  }
  if (known.Sum.empty())
  {
    throw tool::Error(path +
                      " is there already, and no SHA-256 is known that would tell whether "
                      "it is right. It was left alone; move it, or give its sum by --sha256");
  }
  const std::string sum = GetSha256(ReadFile(path));
  const std::string text = path + " is there already with the SHA-256 " + sum + ", expected " +
                           known.Sum + " (" + known.Source + ")";
  if (sum != known.Sum && !isCache)
  {
    throw tool::Error(text + ". It was left alone; move it, or name another folder");
  }
  if (sum != known.Sum)
  {
    tool::PrintNote(text + ". It is downloaded anew");
  }
  return sum == known.Sum;
}

//------------------------------------------------------------------------------
// The right bytes.
std::string Bring(const FetchOptions& options, const tool::FetchEntry& entry, const KnownSum& known)
{
  std::string url = entry.Url;
  if (const std::string& base = options.BaseUrl; !base.empty())
  {
    url = base + (base.back() == '/' ? "" : "/") + url.substr(std::strlen("https://"));
  }
  const std::string bytes = tool::Download({ entry.Name, url,
    entry.Size > 0 ? entry.Size : entry.Limit, entry.Size, options.Timeout, options.Retries });
  const std::string& begin = entry.Collection->BeginsWith;
  const std::string size = url + ": the " + std::to_string(bytes.size()) + " bytes that came";
  if (known.Sum.empty() && bytes.compare(0, begin.size(), begin) != 0)
  {
    throw tool::Error(size + " begin with '" + bytes.substr(0, begin.size()) + "', expected '" +
                      begin + "'. Nothing was kept");
  }
  const std::string sum = GetSha256(bytes);
  if (!known.Sum.empty() && sum != known.Sum)
  {
    throw tool::Error(size + " have the SHA-256 " + sum + ", expected " + known.Sum + " (" +
                      known.Source + "). Nothing was kept");
  }
  return bytes;
}

//------------------------------------------------------------------------------
// Brings the file and returns its path. Files that are not this program's stay as they are. shown:
// the collections whose licence was shown already.
std::string Fetch(
  const FetchOptions& options, const tool::FetchEntry& entry, std::set<std::string>& shown)
{
  const bool isCache = options.Folder.empty();
  const std::string path = (fs::path(isCache ? OpenCache() : options.Folder) / entry.File).string();
  const KnownSum known = FindSum(options, entry, path + ".sha256");
  if (IsDone(path, known, isCache))
  {
    return path;
  }
  if (known.Sum.empty() && !options.TrustFirst)
  {
    throw tool::Error(
      entry.Name + ": this program does not know the SHA-256 of " + entry.Url +
      ", so it could not tell a wrong file from the right one. Give the sum by --sha256, "
      "or say --trust-first: what comes first is taken, and checked against from then on");
  }
  const tool::FetchCollection& from = *entry.Collection;
  if (shown.insert(from.Id).second)
  {
    tool::PrintNote(entry.Name + ": " + from.Title + ", " + entry.Page +
                    "\n  Licence: " + from.Licence + ", " + from.LicenceUrl + "\n  " + from.Terms);
  }
  tool::CheckWritable(path);
  const std::string bytes = Bring(options, entry, known);
  if (!isCache && HasFile(path))
  {
    throw tool::Error(path + " appeared meanwhile. It was left alone");
  }
  if (known.Sum.empty())
  {
    const std::string sum = GetSha256(bytes);
    tool::WriteWhole(path + ".sha256", sum + "  " + entry.File + "\n");
    tool::PrintNote(entry.Name + ": trusted at first sight. Its SHA-256 is " + sum +
                    ", recorded in " + path + ".sha256");
  }
  tool::WriteWhole(path, bytes);
  return path;
}

//------------------------------------------------------------------------------
Entries SelectEntries(const std::vector<std::string>& parts)
{
  Entries selected;
  for (const tool::FetchEntry& entry : tool::GetFetchCatalog())
  {
    const auto isPart = [&entry](const std::string& part)
    { return entry.Name.find(part) != std::string::npos; };
    if (parts.empty() || std::any_of(parts.begin(), parts.end(), isPart))
    {
      selected.push_back(&entry);
    }
  }
  return selected;
}

//------------------------------------------------------------------------------
void PrintCatalog(const Entries& entries, bool asJson)
{
  const auto orNull = [](const auto& value)
  { return value == std::decay_t<decltype(value)>{} ? Json() : Json(value); };
  Json list = Json::array();
  Json rows = Json::array();
  for (const tool::FetchEntry* entry : entries)
  {
    const tool::FetchCollection& from = *entry->Collection;
    const std::string here = tool::FindFetchedFile(*entry);
    list.push_back({ { "name", entry->Name }, { "kind", from.Kind }, { "source", from.Title },
      { "page", entry->Page }, { "file", entry->File }, { "url", entry->Url },
      { "size", orNull(entry->Size) }, { "limit", entry->Limit },
      { "sha256", orNull(entry->Sha256) }, { "sum", orNull(entry->SumKind) },
      { "licence", from.Licence }, { "fetched", orNull(here) } });
    rows.push_back({ { "name", entry->Name },
      { "bytes",
        entry->Size > 0 ? std::to_string(entry->Size) : "<= " + std::to_string(entry->Limit) },
      { "licence", from.Licence },
      { "sha256", entry->Sha256.empty() ? "not known" : entry->SumKind },
      { "here", here.empty() ? "" : "yes" }, { "source", from.Title } });
  }
  tool::PrintReport(asJson ? list : Json{ { "files", rows } }, asJson);
  if (!asJson)
  {
    tool::PrintOut("SHA-256: published = by people who downloaded the file there; copy = of a copy "
                   "that came from\nelsewhere; not known = give it by --sha256, or say "
                   "--trust-first.\n");
  }
}

//------------------------------------------------------------------------------
void Check(const FetchOptions& options)
{
  if (options.Names.empty())
  {
    throw tool::UsageError("fetch: no NAME; 'measured-brdf fetch --list' shows what there is");
  }
  if (!options.Sha256.empty() && options.Names.size() > 1)
  {
    throw tool::UsageError("--sha256 is the sum of one file; name one");
  }
  if (!options.Sha256.empty() &&
      (options.Sha256.size() != 64 ||
        options.Sha256.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos))
  {
    throw tool::UsageError("--sha256 " + options.Sha256 + ": expected 64 hexadecimal digits");
  }
  if (!options.BaseUrl.empty() && !tool::IsAllowedUrl(options.BaseUrl))
  {
    throw tool::UsageError("--base-url " + options.BaseUrl +
                           ": expected an https address, or an http address of this machine");
  }
}

//------------------------------------------------------------------------------
void FetchAll(const FetchOptions& options)
{
  Entries entries;
  for (const std::string& name : options.Names)
  {
    entries.push_back(tool::FindFetchEntry(name));
    if (!entries.back())
    {
      throw tool::Error(
        "fetch: nothing is known of '" + name + "'; 'measured-brdf fetch --list' shows all names");
    }
  }
  std::signal(SIGPIPE, SIG_IGN); // a closed connection is an error with a message, no end
  const tool::Interruptible interruptible;
  std::set<std::string> shown;
  std::size_t failures = 0;
  for (const tool::FetchEntry* entry : entries)
  {
    try
    {
      tool::PrintOut(Fetch(options, *entry, shown) + "\n");
    }
    catch (const tool::Error& e)
    {
      if (entries.size() == 1 || tool::Interruptible::IsInterrupted())
      {
        throw;
      }
      ++failures;
      std::cerr << "measured-brdf: error: " << vtkBRDFReader::GetPrintable(e.what()) << std::endl;
    }
  }
  if (failures > 0)
  {
    throw tool::Error("fetch: " + std::to_string(failures) + " of " +
                      tool::FormatCount(entries.size(), "file") + " could not be fetched");
  }
}

//------------------------------------------------------------------------------
void Run(const FetchOptions& options)
{
  if (!options.IsList && !options.AsJson)
  {
    Check(options);
    FetchAll(options);
    return;
  }
  const Entries entries = SelectEntries(options.Names);
  if (entries.empty())
  {
    throw tool::Error("fetch: nothing in the list has such a name");
  }
  PrintCatalog(entries, options.AsJson);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddFetchCommand(CLI::App& app)
{
  auto options = std::make_shared<FetchOptions>();
  CLI::App* command = app.add_subcommand("fetch",
    "Download published materials (RGL) and environments (Poly Haven), checked by SHA-256");
  command->add_option("NAME", options->Names,
    "What to download; other commands then take these names as materials and environments. Prints "
    "the paths of the files");
  command->add_flag("--list", options->IsList,
    "List what there is, its size, licence and sum; with NAME, what has NAME in its name");
  command->add_flag("--json", options->AsJson, "The list as JSON");
  command->add_option("--to", options->Folder,
    "Folder for the files (default: vtkMeasuredBRDF/vtkMeasuredBRDF-files in $XDG_CACHE_HOME or "
    "~/.cache, where they are found by name)");
  command->add_option("--sha256", options->Sha256,
    "The SHA-256 that the file must have, where you know it and the program doesn't");
  command->add_flag("--trust-first", options->TrustFirst,
    "Take a file whose SHA-256 nobody knows, and record it: later downloads must be the same");
  command->add_option("--base-url", options->BaseUrl,
    "Download from a mirror: URL/HOST/PATH instead of https://HOST/PATH");
  command
    ->add_option("--timeout", options->Timeout,
      "Seconds without an answer, or with less than 1 KiB/s, after which an attempt ends (default "
      "60)")
    ->check(CLI::Range(1, 3600));
  command
    ->add_option("--retries", options->Retries,
      "Further attempts after a cut connection or a busy server (default 2)")
    ->check(CLI::Range(0, 10));
  command->footer(
    "Example:\n"
    "  measured-brdf fetch satin_purple studio_small_03_1k\n"
    "  measured-brdf render satin_purple --environment studio_small_03_1k -o out.png\n"
    "\nMERL's 100 materials come in one archive of 1.25 GB, https://zenodo.org/records/8101681: "
    "download and\nunpack it; all commands take its .binary files."
    "\nProxies are taken from the environment (https_proxy), as curl does.");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
