// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartResults.h"

#include "BoundedJson.h"
#include "ChartMethods.h"
#include "Files.h"
#include "Measuring.h"
#include "ParetoFront.h"
#include "Tool.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>

namespace
{
using JSON = tool::ChartJson;
using tool::GetFigure;

constexpr char ChartFormat[] = "measured-brdf chart";
constexpr int ChartVersion = 3; // of other fingerprints than before

//------------------------------------------------------------------------------
std::vector<tool::CostPoint> GetCosts(const JSON& pair)
{
  std::vector<tool::CostPoint> costs;
  for (const JSON& point : pair.at("points"))
  {
    costs.push_back({ GetFigure(point, "frame_ms"),
      tool::GetPointError(point, tool::GetMetrics().front().Name) });
  }
  return costs;
}

//------------------------------------------------------------------------------
// A cell after others.
std::string MakeCell(double value)
{
  return "," + (std::isfinite(value) ? tool::FormatNumber(value) : "");
}

//------------------------------------------------------------------------------
std::string MakeCSV(const JSON& results)
{
  std::string text =
    "material,environment,method,size,setup_ms,frame_ms,frame_ms_lower_quartile,"
    "frame_ms_upper_quartile,frames,texture_bytes,texture_fetches,on_front,left_out";
  for (const tool::Metric& metric : tool::GetMetrics())
  {
    text += "," + metric.Name;
  }
  text += ",unoccluded_error\n";
  for (const JSON& pair : results.at("pairs"))
  {
    for (std::size_t k = 0; k < pair.at("points").size(); ++k)
    {
      const JSON& point = pair["points"][k];
      text += tool::QuoteCell(pair.at("material")) + "," + tool::QuoteCell(pair.at("environment")) +
              "," + point.at("method").get<std::string>() + "," +
              tool::QuoteCell(point.at("size")) + MakeCell(GetFigure(point, "setup_ms")) +
              MakeCell(GetFigure(point, "frame_ms"));
      for (const JSON& quartile :
        point.value("frame_ms_quartiles", JSON::array({ nullptr, nullptr })))
      {
        text += quartile.is_null() ? "," : MakeCell(quartile);
      }
      for (const char* name : { "frames", "texture_bytes", "texture_fetches" })
      {
        text += MakeCell(GetFigure(point, name));
      }
      const JSON& front = pair.at("front");
      text += std::find(front.begin(), front.end(), k) != front.end() ? ",1," : ",0,";
      text += point.contains("left_out") ? tool::QuoteCell(point["left_out"]) : "";
      for (const tool::Metric& metric : tool::GetMetrics())
      {
        text += MakeCell(tool::GetPointError(point, metric.Name));
      }
      text += MakeCell(GetFigure(pair, "unoccluded_error")) + "\n";
    }
  }
  return text;
}
}

namespace tool
{
//------------------------------------------------------------------------------
const ChartJson* FindPair(
  const ChartJson& results, const std::string& material, const std::string& environment)
{
  for (const ChartJson& pair : results.at("pairs"))
  {
    if (pair.at("material") == material && pair.at("environment") == environment)
    {
      return &pair;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
double GetFigure(const ChartJson& point, const std::string& name)
{
  const auto found = point.find(name); // what is not a number is null in JSON
  return found == point.end() || found->is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                  : found->get<double>();
}

//------------------------------------------------------------------------------
double GetPointError(const ChartJson& point, const std::string& metric)
{
  return GetFigure(point.value("errors", ChartJson::object()), metric);
}

//------------------------------------------------------------------------------
void RatePair(ChartJson& pair)
{
  const std::vector<CostPoint> costs = GetCosts(pair);
  pair["front"] = FindFront(costs);
  pair["planner"] = ChartJson::array();
  for (std::size_t k = 0; k < costs.size(); ++k)
  {
    const ChartJson& point = pair["points"][k];
    if (point["method"] == PlannerMethod && !point.contains("left_out"))
    {
      const std::string size = point["size"];
      pair["planner"].push_back({ { "point", k }, { "tolerance", std::stod(size) },
        { "in_view", size.find(InView) != std::string::npos },
        { "interacting", size.find(Interacting) != std::string::npos },
        { "time_over_front", costs[k].Cost / GetFrontCost(costs, costs[k].Error) } });
    }
  }
}

//------------------------------------------------------------------------------
double GetShareWithin(const ChartJson& results)
{
  double within = 0.0;
  double all = 0.0;
  for (const ChartJson& pair : results.at("pairs"))
  {
    for (const ChartJson& figure : pair.at("planner"))
    {
      within += GetFigure(figure, "time_over_front") <= 1.0 + FrontMargin;
      ++all;
    }
  }
  return within / all;
}

//------------------------------------------------------------------------------
void SaveResults(const std::string& folder, ChartJson& results)
{
  char today[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(today, sizeof(today), "%Y-%m-%d", std::gmtime(&now));
  results["date"] = today;
  results["planner_within_20_percent_of_front"] = GetShareWithin(results);
  WriteWhole(folder + "/results.csv", MakeCSV(results));
  WriteWhole(folder + "/results.json",
    results.dump(1, ' ', false, ChartJson::error_handler_t::replace) + "\n");
}

//------------------------------------------------------------------------------
ChartJson LoadResults(
  const std::string& folder, const ChartJson& settings, const ChartJson& machine)
{
  const std::string path = folder + "/results.json";
  const ChartJson fresh = { { "format", ChartFormat }, { "version", ChartVersion }, { "date", "" },
    { "settings", settings }, { "machine", machine },
    { "planner_within_20_percent_of_front", nullptr }, { "pairs", ChartJson::array() } };
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    return fresh;
  }
  ChartJson results;
  std::string problem;
  try
  {
    std::ifstream file(path);
    results = measuredbrdf::ParseJson<ChartJson>(file);
    for (const char* part : { "version", "settings", "machine" })
    {
      const ChartJson changes =
        problem.empty() ? ChartJson::diff(results.at(part), fresh.at(part)) : ChartJson();
      if (!changes.empty())
      {
        problem = std::string(": differs in its ") + part + "; now " + changes.dump();
      }
    }
    if (problem.empty())
    {
      MakeCSV(results); // they need all of it
      GetShareWithin(results);
    }
  }
  catch (const std::exception& e) // of nlohmann: missing, or of another type
  {
    problem = std::string(": was not written by 'measured-brdf chart', or is damaged: ") + e.what();
  }
  if (!problem.empty())
  {
    throw Error(path + problem + ". It is left as it is; write to another folder, or do as then");
  }
  return results;
}
} // namespace tool
