// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchCatalog.h"
#include "JsonReport.h"
#include "MeasuredBRDFToolVersion.h"
#include "Tool.h"

#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"

#include <CLI/CLI.hpp>

#include <memory>

using nlohmann::ordered_json;

namespace
{
//------------------------------------------------------------------------------
void Run(bool json)
{
  ordered_json materials = ordered_json::array();
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    materials.push_back(
      { { "name", vtkEmbeddedMaterials::GetName(k) }, { "kind", vtkEmbeddedMaterials::GetKind(k) },
        { "source", vtkEmbeddedMaterials::GetSource(k) } });
  }
  if (json)
  {
    tool::PrintReport(materials, true);
    return;
  }
  ordered_json environments = ordered_json::array();
  for (int k = 0; k < vtkEmbeddedEnvironments::GetNumberOfEnvironments(); ++k)
  {
    environments.push_back({ { "name", vtkEmbeddedEnvironments::GetName(k) },
      { "source", vtkEmbeddedEnvironments::GetSource(k) } });
  }
  ordered_json report = { { "materials", materials }, { "environments", environments } };
  for (const tool::FetchEntry& entry : tool::GetFetchCatalog())
  {
    if (!tool::FindFetchedFile(entry).empty())
    {
      report["fetched"].push_back({ { "name", entry.Name }, { "kind", entry.Collection->Kind },
        { "source", entry.Collection->Title } });
    }
  }
  tool::PrintReport(report, false);
  if (MEASUREDBRDF_WITH_CURL)
  {
    tool::PrintOut("More can be downloaded: 'measured-brdf fetch --list' shows what.\n");
  }
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
