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
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>

namespace
{
using JSON = tool::ChartJson;

constexpr char ChartFormat[] = "measured-brdf chart";
constexpr int ChartVersion = 2; // of other fingerprints than 1

// What the planner is asked for: on the front, or this much above its time.
constexpr double FrontMargin = 0.2;

//------------------------------------------------------------------------------
// What is not a number is null in JSON.
double GetNumber(const JSON& object, const std::string& name)
{
  const auto found = object.find(name);
  return found == object.end() || found->is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                   : found->get<double>();
}

//------------------------------------------------------------------------------
std::vector<tool::CostPoint> GetCosts(const JSON& pair, const std::string& metric)
{
  std::vector<tool::CostPoint> costs;
  for (const JSON& point : pair.at("points"))
  {
    costs.push_back({ tool::GetFigure(point, "frame_ms"), tool::GetPointError(point, metric) });
  }
  return costs;
}

//------------------------------------------------------------------------------
// Of quotes and commas, RFC 4180.
std::string Quote(const std::string& text)
{
  std::string quoted;
  for (const char c : text)
  {
    quoted += c == '"' ? std::string(2, c) : std::string(1, c);
  }
  return "\"" + quoted + "\"";
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
      const JSON quartiles = point.value("frame_ms_quartiles", JSON::array({ nullptr, nullptr }));
      text += Quote(pair.at("material")) + "," + Quote(pair.at("environment")) + "," +
              point.at("method").get<std::string>() + "," + Quote(point.at("size")) +
              MakeCell(tool::GetFigure(point, "setup_ms")) +
              MakeCell(tool::GetFigure(point, "frame_ms"));
      for (const JSON& quartile : quartiles)
      {
        text += quartile.is_null() ? "," : MakeCell(quartile);
      }
      for (const char* name : { "frames", "texture_bytes", "texture_fetches" })
      {
        text += MakeCell(tool::GetFigure(point, name));
      }
      const JSON& front = pair.at("front");
      text += std::find(front.begin(), front.end(), k) != front.end() ? ",1," : ",0,";
      text += point.contains("left_out") ? Quote(point["left_out"]) : "";
      for (const tool::Metric& metric : tool::GetMetrics())
      {
        text += MakeCell(tool::GetPointError(point, metric.Name));
      }
      text += MakeCell(GetNumber(pair, "unoccluded_error")) + "\n";
    }
  }
  return text;
}

//------------------------------------------------------------------------------
std::string GetToday()
{
  char text[32] = "";
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::strftime(text, sizeof(text), "%Y-%m-%d", &parts);
  return text;
}

//------------------------------------------------------------------------------
// Throws Error naming the first thing that two objects differ in.
void CheckSame(const std::string& path, const char* what, const JSON& there, const JSON& here)
{
  for (const auto& item : here.items())
  {
    const JSON found = there.contains(item.key()) ? there.at(item.key()) : JSON();
    if (found != item.value())
    {
      throw tool::Error(path + ": was measured with another " + what + ": " + item.key() + " was " +
                        found.dump() + ", now " + item.value().dump() +
                        ". Write to another folder, or do as then");
    }
  }
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
double GetFigure(const ChartJson& point, const std::string& name) { return GetNumber(point, name); }

//------------------------------------------------------------------------------
double GetPointError(const ChartJson& point, const std::string& metric)
{
  return GetNumber(point.value("errors", ChartJson::object()), metric);
}

//------------------------------------------------------------------------------
void RatePair(ChartJson& pair)
{
  const std::string metric = GetMetrics().front().Name;
  const std::vector<double> over = RatePlanner(pair, metric);
  pair["front"] = FindFront(GetCosts(pair, metric));
  pair["planner"] = ChartJson::array();
  for (std::size_t k = 0; k < pair["points"].size(); ++k)
  {
    const ChartJson& point = pair["points"][k];
    if (point["method"] == PlannerMethod && !point.contains("left_out"))
    {
      const std::string size = point["size"];
      pair["planner"].push_back({ { "point", k }, { "tolerance", std::stod(size) },
        { "in_view", IsInView(size) }, { "interacting", IsInteracting(size) },
        { "time_over_front", over[pair["planner"].size()] } });
    }
  }
}

//------------------------------------------------------------------------------
std::vector<double> RatePlanner(const ChartJson& pair, const std::string& metric)
{
  const std::vector<CostPoint> costs = GetCosts(pair, metric);
  std::vector<double> over;
  for (std::size_t k = 0; k < costs.size(); ++k)
  {
    const ChartJson& point = pair.at("points")[k];
    if (point.at("method") == PlannerMethod && !point.contains("left_out"))
    {
      over.push_back(costs[k].Cost / GetFrontCost(costs, costs[k].Error));
    }
  }
  return over;
}

//------------------------------------------------------------------------------
double GetShareWithin(const ChartJson& results, const std::string& metric, double margin)
{
  std::vector<double> all;
  for (const ChartJson& pair : results.at("pairs"))
  {
    const std::vector<double> over = RatePlanner(pair, metric);
    all.insert(all.end(), over.begin(), over.end());
  }
  const auto within =
    std::count_if(all.begin(), all.end(), [margin](double over) { return over <= 1.0 + margin; });
  return all.empty() ? std::numeric_limits<double>::quiet_NaN()
                     : static_cast<double>(within) / static_cast<double>(all.size());
}

//------------------------------------------------------------------------------
void SaveResults(const std::string& folder, ChartJson& results)
{
  results["date"] = GetToday();
  results["planner_within_20_percent_of_front"] =
    GetShareWithin(results, GetMetrics().front().Name, FrontMargin);
  WriteWhole(folder + "/results.csv", MakeCSV(results));
  WriteWhole(folder + "/results.json",
    results.dump(1, ' ', false, ChartJson::error_handler_t::replace) + "\n");
}

//------------------------------------------------------------------------------
ChartJson LoadResults(
  const std::string& folder, const ChartJson& settings, const ChartJson& machine)
{
  const std::string path = folder + "/results.json";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    return { { "format", ChartFormat }, { "version", ChartVersion }, { "date", "" },
      { "settings", settings }, { "machine", machine },
      { "planner_within_20_percent_of_front", nullptr }, { "pairs", ChartJson::array() } };
  }
  errno = 0;
  std::ifstream file(path);
  if (!file.is_open())
  {
    throw Error(path + ": can't be opened: " + std::strerror(errno));
  }
  ChartJson results;
  try
  {
    results = measuredbrdf::ParseJson<ChartJson>(file);
  }
  catch (const std::exception&)
  {
    // It has no format then; below.
  }
  const auto get = [&results](const char* name)
  { return results.is_object() && results.contains(name) ? results.at(name) : ChartJson(); };
  if (get("format") != ChartFormat)
  {
    throw Error(path + ": was not written by 'measured-brdf chart', and is left as it is. Write to "
                       "another folder");
  }
  if (get("version") != ChartVersion)
  {
    throw Error(path + ": is of version " + get("version").dump() +
                " of its format, this program goes on with version " +
                std::to_string(ChartVersion) + ". Write to another folder");
  }
  CheckSame(path, "setting", get("settings"), settings);
  CheckSame(path, "machine", get("machine"), machine);
  try
  {
    FindPair(results, "", "");
    MakeCSV(results); // which needs all of it
  }
  catch (const std::exception& e) // of nlohmann: missing, or of another type
  {
    throw Error(path + ": is damaged: " + e.what() + ". Remove it or write to another folder");
  }
  return results;
}
} // namespace tool
