// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchJob.h"
#include "FetchTable.h"
#include "Progress.h"
#include "Sha256.h"
#include "Tool.h"

#include "vtkBRDFReader.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <csignal>
#include <iostream>
#include <memory>
#include <set>
#include <vector>

namespace
{
struct FetchCommandOptions : tool::FetchOptions
{
  std::vector<std::string> Names;
  std::string Folder; // "": the cache
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
  if (!options.Sha256.empty() && !tool::IsSha256(options.Sha256))
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
  for (const std::string& other : tool::FindNearFetchNames(name, 5))
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
// Brings one file; its path.
std::string FetchOne(const tool::FetchEntry& entry, const FetchCommandOptions& options,
  const tool::FetchFolder& folder, std::set<std::string>& shown)
{
  std::unique_ptr<tool::FetchFolder> cache;
  if (!folder.IsCache() && !tool::FindFetchedFile(entry).empty())
  {
    cache = std::make_unique<tool::FetchFolder>(tool::FetchFolder::OpenCache());
  }
  tool::FetchJob job(entry, options, folder, cache.get());
  if (!job.IsDone())
  {
    job.CheckSumIsKnown();
    if (shown.insert(entry.Collection->Id).second)
    {
      ShowLicence(entry, options.AcceptLicence);
    }
    job.Run();
  }
  return folder.GetPath(entry.File);
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
  const tool::FetchFolder folder = options.Folder.empty()
                                     ? tool::FetchFolder::OpenCache()
                                     : tool::FetchFolder::OpenOther(options.Folder);
  std::set<std::string> shown;
  std::size_t failures = 0;
  for (const tool::FetchEntry* entry : entries)
  {
    try
    {
      tool::PrintOut(FetchOne(*entry, options, folder, shown) + "\n");
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
    tool::PrintFetchCatalog(options.Names, options.Json);
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
