// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Download.h"
#include "FetchFile.h"
#include "JsonReport.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDFReader.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <memory>
#include <set>
#include <vector>

namespace
{
using Json = nlohmann::ordered_json;
using Entries = std::vector<const tool::FetchEntry*>;

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
struct FetchCommandOptions : tool::FetchOptions
{
  std::vector<std::string> Names;
  bool List = false;
  bool Json = false;
};

//------------------------------------------------------------------------------
void Check(const FetchCommandOptions& options)
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
const tool::FetchEntry& Find(const std::string& name)
{
  if (const tool::FetchEntry* entry = tool::FindFetchEntry(name))
  {
    return *entry;
  }
  throw tool::Error(
    "fetch: nothing is known of '" + name + "'; 'measured-brdf fetch --list' shows all names");
}

//------------------------------------------------------------------------------
void ShowLicence(const tool::FetchEntry& entry)
{
  const tool::FetchCollection& from = *entry.Collection;
  tool::PrintNote(entry.Name + ": " + from.Title + ", " + entry.Page +
                  "\n  Licence: " + from.Licence + ", " + from.LicenceUrl + "\n  " + from.Terms);
}

//------------------------------------------------------------------------------
void FetchAll(const FetchCommandOptions& options)
{
  std::vector<const tool::FetchEntry*> entries;
  for (const std::string& name : options.Names)
  {
    entries.push_back(&Find(name));
  }
  // A closed connection is an error with a message, no end.
  std::signal(SIGPIPE, SIG_IGN);
  const tool::Interruptible interruptible;
  std::set<std::string> shown;
  std::size_t failures = 0;
  for (const tool::FetchEntry* entry : entries)
  {
    try
    {
      const auto show = [&]()
      {
        if (shown.insert(entry->Collection->Id).second)
        {
          ShowLicence(*entry);
        }
      };
      tool::PrintOut(tool::FetchFile(*entry, options, show) + "\n");
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
void Run(const FetchCommandOptions& options)
{
  if (options.List || options.Json)
  {
    const Entries entries = SelectEntries(options.Names);
    if (entries.empty())
    {
      throw tool::Error("fetch: nothing in the list has such a name");
    }
    PrintCatalog(entries, options.Json);
    return;
  }
  Check(options);
  FetchAll(options);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddFetchCommand(CLI::App& app)
{
  auto options = std::make_shared<FetchCommandOptions>();
  CLI::App* command = app.add_subcommand("fetch",
    "Download published materials (RGL) and environments (Poly Haven), checked by SHA-256");
  command->add_option("NAME", options->Names,
    "What to download; other commands then take these names as materials and environments. Prints "
    "the paths of the files");
  command->add_flag("--list", options->List,
    "List what there is, its size, licence and sum; with NAME, what has NAME in its name");
  command->add_flag("--json", options->Json, "The list as JSON");
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
