// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchCatalog.h"
#include "MeasuredBRDFToolVersion.h"
#include "Tool.h"

#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace
{
//------------------------------------------------------------------------------
// What was downloaded, and that there is more.
std::string ListFetched()
{
  std::string text;
  for (const tool::FetchEntry& entry : tool::GetFetchCatalog())
  {
    if (!tool::FindFetchedFile(entry).empty())
    {
      text += entry.Name + "  " + entry.Collection->Kind + "  " + entry.Collection->Title + "\n";
    }
  }
  return (text.empty() ? "" : "\nFetched:\n" + text) +
         (MEASUREDBRDF_WITH_CURL
             ? "\nMore can be downloaded: 'measured-brdf fetch --list' shows what.\n"
             : "");
}

//------------------------------------------------------------------------------
void Run(bool json)
{
  const int n = vtkEmbeddedMaterials::GetNumberOfMaterials();
  if (json)
  {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (int k = 0; k < n; ++k)
    {
      list.push_back({ { "name", vtkEmbeddedMaterials::GetName(k) },
        { "kind", vtkEmbeddedMaterials::GetKind(k) },
        { "source", vtkEmbeddedMaterials::GetSource(k) } });
    }
    tool::PrintOut(list.dump(2) + "\n");
    return;
  }

  std::size_t nameWidth = 4;
  std::size_t kindWidth = 4;
  for (int k = 0; k < n; ++k)
  {
    nameWidth = std::max(nameWidth, vtkEmbeddedMaterials::GetName(k).size());
    kindWidth = std::max(kindWidth, vtkEmbeddedMaterials::GetKind(k).size());
  }
  std::string text;
  const auto row = [&](std::string name, std::string kind, const std::string& source)
  {
    name.resize(nameWidth, ' ');
    kind.resize(kindWidth, ' ');
    text += name + "  " + kind + "  " + source + "\n";
  };
  row("NAME", "KIND", "SOURCE");
  for (int k = 0; k < n; ++k)
  {
    row(vtkEmbeddedMaterials::GetName(k), vtkEmbeddedMaterials::GetKind(k),
      vtkEmbeddedMaterials::GetSource(k));
  }
  text += "\nEnvironments, for --environment:\n";
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    row(vtkEmbeddedEnvironments::GetName(k), "", vtkEmbeddedEnvironments::GetSource(k));
  }
  text += ListFetched();
  tool::PrintOut(text);
}
}

namespace tool
{
//------------------------------------------------------------------------------
void AddListCommand(CLI::App& app)
{
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
    "list", "Name the embedded materials and environments (no download needed) and their sources");
  command->add_flag("--json", *json, "Write JSON instead of a table");
  command->callback([json]() { Run(*json); });
}
} // namespace tool
