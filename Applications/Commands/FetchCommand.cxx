// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Download.h"
#include "FetchFile.h"
#include "Progress.h"
#include "Tool.h"

#include "vtkBRDFReader.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <memory>
#include <set>
#include <vector>

namespace
{
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
std::string FormatCatalogJson(const Entries& entries)
{
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const auto orNull = [](const std::string& text)
  { return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text); };
  for (const tool::FetchEntry* entry : entries)
  {
    nlohmann::ordered_json item = { { "name", entry->Name }, { "kind", entry->Collection->Kind },
      { "source", entry->Collection->Title }, { "page", entry->Page }, { "file", entry->File },
      { "url", entry->Url }, { "member", orNull(entry->Member) },
      { "size", entry->Size == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(entry->Size) },
      { "limit", entry->Limit }, { "sha256", orNull(entry->Sha256) },
      { "sum", orNull(entry->SumKind) }, { "licence", entry->Collection->Licence },
      { "needs_agreement", entry->Collection->NeedsAgreement },
      { "fetched", orNull(tool::FindFetchedFile(*entry)) } };
    list.push_back(std::move(item));
  }
  return list.dump(2) + "\n";
}

//------------------------------------------------------------------------------
std::string FormatCatalogTable(const Entries& entries)
{
  std::string text =
    "NAME                             BYTES        LICENCE                SHA-256    HERE\n";
  const tool::FetchCollection* collection = nullptr;
  for (const tool::FetchEntry* entry : entries)
  {
    if (entry->Collection != collection)
    {
      collection = entry->Collection;
      text += "\n" + collection->Title + ":\n";
    }
    const std::string size =
      entry->Size > 0 ? std::to_string(entry->Size) : "<= " + std::to_string(entry->Limit);
    const std::string licence =
      collection->Licence + (collection->NeedsAgreement ? " (agree)" : "");
    char line[200];
    std::snprintf(line, sizeof(line), "%-32s %-12s %-22s %-10s %s", entry->Name.c_str(),
      size.c_str(), licence.c_str(), entry->Sha256.empty() ? "not known" : entry->SumKind.c_str(),
      tool::FindFetchedFile(*entry).empty() ? "" : "yes");
    text += std::string(line) + "\n";
  }
  return text +
         "\nSHA-256: published = by people who downloaded the file there; copy = of a copy "
         "that came from\nelsewhere; not known = give it by --sha256, or say --trust-first.\n";
}

//------------------------------------------------------------------------------
struct FetchCommandOptions : tool::FetchOptions
{
  std::vector<std::string> Names;
  bool List = false;
  bool Json = false;
  bool AcceptLicence = false;
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
  std::string near;
  for (const std::string& other : tool::FindNearFetchNames(name))
  {
    near += (near.empty() ? ". Did you mean " : ", ") + other;
  }
  throw tool::Error("fetch: nothing is known of '" + name + "'" + (near.empty() ? "" : near + "?") +
                    (near.empty() ? "; " : " ") + "'measured-brdf fetch --list' shows all names");
}

//------------------------------------------------------------------------------
bool Ask(const std::string& question)
{
  std::cerr << question << " [y/N] " << std::flush;
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

//------------------------------------------------------------------------------
// Throws Error where the licence sets conditions and nobody agrees to them.
void ShowLicence(const tool::FetchEntry& entry, bool accepted)
{
  const tool::FetchCollection& from = *entry.Collection;
  tool::PrintNote(entry.Name + ": " + from.Title + ", " + entry.Page +
                  "\n  Licence: " + from.Licence + ", " + from.LicenceUrl + "\n  " + from.Terms);
  if (!from.NeedsAgreement || accepted)
  {
    return;
  }
  const bool canAsk = isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
  if (!canAsk || !Ask("Do you agree to this licence?"))
  {
    throw tool::Error(entry.Name + ": not downloaded: its licence (" + from.Licence +
                      ") sets conditions. Say that you agree by --accept-license");
  }
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
      const auto agree = [&]()
      {
        if (shown.insert(entry->Collection->Id).second)
        {
          ShowLicence(*entry, options.AcceptLicence);
        }
      };
      tool::PrintOut(tool::FetchFile(*entry, options, agree) + "\n");
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
    tool::PrintOut(options.Json ? FormatCatalogJson(entries) : FormatCatalogTable(entries));
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
    "Download published materials (RGL, MERL) and environments (Poly Haven), checked by SHA-256");
  command->add_option("NAME", options->Names,
    "What to download; other commands then take these names as materials and environments. Prints "
    "the paths of the files");
  command->add_flag("--list", options->List,
    "List what there is, its size, licence and sum; with NAME, what has NAME in its name");
  command->add_flag("--json", options->Json, "The list as JSON");
  command->add_option("--to", options->Folder,
    "Folder for the files (default: vtkMeasuredBRDF/vtkMeasuredBRDF-files in $XDG_CACHE_HOME or "
    "~/.cache, where they are found by name)");
  command->add_flag("--accept-license", options->AcceptLicence,
    "Agree to the licence of the files, where it sets conditions; without this option the program "
    "asks, or stops where it can't");
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
    "\nAn interrupted download goes on where it stopped when the command is given "
    "again.\nProxies are taken from the environment (https_proxy), as curl does.");
  command->callback([options]() { Run(*options); });
}
} // namespace tool
