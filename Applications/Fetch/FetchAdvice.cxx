// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FetchAdvice.h"

#include "FetchCatalog.h"
#include "FetchFolder.h"
#include "MeasuredBRDFToolVersion.h"

#include <filesystem>

namespace fs = std::filesystem;

namespace tool
{
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
