// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchTable.h"

#include "FetchCatalog.h"
#include "FetchFolder.h"
#include "Tool.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace
{
using Entries = std::vector<const tool::FetchEntry*>;
using Row = std::array<std::string, 5>;

//------------------------------------------------------------------------------
Entries Select(const std::vector<std::string>& parts)
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
std::string FormatJson(const Entries& entries)
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
Row MakeRow(const tool::FetchEntry& entry)
{
  return { entry.Name,
    entry.Size > 0 ? std::to_string(entry.Size) : "<= " + std::to_string(entry.Limit),
    entry.Collection->Licence + (entry.Collection->NeedsAgreement ? " (agree)" : ""),
    entry.Sha256.empty() ? "not known" : entry.SumKind,
    tool::FindFetchedFile(entry).empty() ? "" : "yes" };
}

//------------------------------------------------------------------------------
std::string FormatTable(const Entries& entries)
{
  std::vector<Row> rows = { { "NAME", "BYTES", "LICENCE", "SHA-256", "HERE" } };
  for (const tool::FetchEntry* entry : entries)
  {
    rows.push_back(MakeRow(*entry));
  }
  std::array<std::size_t, std::tuple_size<Row>::value> widths{};
  for (const Row& row : rows)
  {
    for (std::size_t k = 0; k < row.size(); ++k)
    {
      widths[k] = std::max(widths[k], row[k].size());
    }
  }
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r)
  {
    if (r > 0 && (r == 1 || entries[r - 1]->Collection != entries[r - 2]->Collection))
    {
      text += "\n" + entries[r - 1]->Collection->Title + ":\n";
    }
    std::string line;
    for (std::size_t k = 0; k < rows[r].size(); ++k)
    {
      std::string cell = rows[r][k];
      cell.resize(widths[k], ' ');
      line += cell + "  ";
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text +
         "\nSHA-256: published = by people who downloaded the file there; copy = of a copy "
         "that came from\nelsewhere; not known = give it by --sha256, or say --trust-first.\n";
}
}

namespace tool
{
//------------------------------------------------------------------------------
void PrintFetchCatalog(const std::vector<std::string>& parts, bool json)
{
  const Entries entries = Select(parts);
  if (entries.empty())
  {
    throw Error("fetch: nothing in the list has such a name");
  }
  PrintOut(json ? FormatJson(entries) : FormatTable(entries));
}
} // namespace tool
