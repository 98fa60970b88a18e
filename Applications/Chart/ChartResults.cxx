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
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>

namespace
{
using JSON = nlohmann::ordered_json;

// What the planner is asked for: on the front, or this much above its time.
constexpr double FrontMargin = 0.2;

//------------------------------------------------------------------------------
std::vector<tool::CostPoint> GetCosts(const tool::ChartPair& pair, const std::string& metric)
{
  std::vector<tool::CostPoint> costs;
  for (const tool::ChartPoint& point : pair.Points)
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto error = point.Errors.find(metric);
    costs.push_back({ point.IsMeasured() ? point.Frame : nan,
      error == point.Errors.end() ? nan : error->second });
  }
  return costs;
}

//------------------------------------------------------------------------------
JSON WritePoint(const tool::ChartPoint& point)
{
  JSON json = { { "method", point.Method }, { "size", point.Size } };
  if (!point.IsMeasured())
  {
    json["left_out"] = point.Left;
    return json;
  }
  for (const auto& [name, value] : point.Errors)
  {
    json["errors"][name] = value;
  }
  json["frame_ms"] = point.Frame;
  json["frame_ms_quartiles"] = { point.FrameLow, point.FrameHigh };
  json["frames"] = point.NumberOfFrames;
  json["setup_ms"] = point.SetUp;
  json["texture_bytes"] = point.Bytes;
  json["texture_fetches"] = point.Fetches;
  if (point.Method == tool::PlannerMethod)
  {
    json["predicted_error"] = point.PredictedError;
    json["predicted_picture_error"] = point.PredictedPictureError;
    json["meets_tolerance"] = point.MeetsTolerance;
    json["plan"] = point.Plan;
  }
  return json;
}

//------------------------------------------------------------------------------
// What is not a number is null in JSON.
double GetNumber(const JSON& json)
{
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

//------------------------------------------------------------------------------
tool::ChartPoint ReadPoint(const JSON& json)
{
  tool::ChartPoint point;
  point.Method = json.at("method").get<std::string>();
  point.Size = json.at("size").get<std::string>();
  if (json.contains("left_out"))
  {
    point.Left = json.at("left_out").get<std::string>();
    return point;
  }
  for (const auto& item : json.at("errors").items())
  {
    point.Errors[item.key()] = GetNumber(item.value());
  }
  point.Frame = json.at("frame_ms").get<double>();
  point.FrameLow = json.at("frame_ms_quartiles").at(0).get<double>();
  point.FrameHigh = json.at("frame_ms_quartiles").at(1).get<double>();
  point.NumberOfFrames = json.at("frames").get<int>();
  point.SetUp = json.at("setup_ms").get<double>();
  point.Bytes = GetNumber(json.at("texture_bytes"));
  point.Fetches = json.value("texture_fetches", 0);
  if (point.Method == tool::PlannerMethod)
  {
    point.PredictedError = json.at("predicted_error").get<double>();
    point.PredictedPictureError = json.value("predicted_picture_error", point.PredictedError);
    point.MeetsTolerance = json.at("meets_tolerance").get<bool>();
    point.Plan = json.at("plan").get<std::string>();
  }
  return point;
}

//------------------------------------------------------------------------------
JSON WritePair(const tool::ChartPair& pair)
{
  const std::string metric = tool::GetMetrics().front().Name;
  JSON json = { { "material", pair.Material }, { "environment", pair.Environment },
    { "fingerprint", pair.Fingerprint }, { "pixels", pair.NumberOfPixels }, { "load", pair.Load },
    { "unoccluded_error", pair.UnoccludedError },
    { "unoccluded_uncertainty", pair.UnoccludedUncertainty }, { "points", JSON::array() },
    { "front", JSON::array() }, { "planner", JSON::array() } };
  for (const tool::ChartPoint& point : pair.Points)
  {
    json["points"].push_back(WritePoint(point));
  }
  for (const std::size_t k : tool::FindFront(pair, metric))
  {
    json["front"].push_back(k);
  }
  for (const tool::PlannerFigure& figure : tool::RatePlanner(pair, metric))
  {
    json["planner"].push_back(
      { { "point", figure.Point }, { "tolerance", std::stod(pair.Points[figure.Point].Size) },
        { "in_view", tool::IsInView(pair.Points[figure.Point].Size) },
        { "interacting", tool::IsInteracting(pair.Points[figure.Point].Size) },
        { "time_over_front", figure.OverFront } });
  }
  return json;
}

//------------------------------------------------------------------------------
tool::ChartPair ReadPair(const JSON& json)
{
  tool::ChartPair pair;
  pair.Material = json.at("material").get<std::string>();
  pair.Environment = json.at("environment").get<std::string>();
  pair.Fingerprint = json.at("fingerprint").get<std::string>();
  pair.NumberOfPixels = json.at("pixels").get<std::size_t>();
  pair.Load = json.at("load").get<double>();
  if (json.contains("unoccluded_error")) // earlier versions did not have it
  {
    pair.UnoccludedError = GetNumber(json.at("unoccluded_error"));
    pair.UnoccludedUncertainty = GetNumber(json.at("unoccluded_uncertainty"));
  }
  for (const JSON& point : json.at("points"))
  {
    pair.Points.push_back(ReadPoint(point));
  }
  return pair;
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
std::string FormatFinite(double value)
{
  return std::isfinite(value) ? tool::FormatNumber(value) : "";
}

//------------------------------------------------------------------------------
std::string MakeCSV(const tool::ChartResults& results)
{
  std::string text =
    "material,environment,method,size,setup_ms,frame_ms,frame_ms_lower_quartile,"
    "frame_ms_upper_quartile,frames,texture_bytes,texture_fetches,on_front,left_out";
  for (const tool::Metric& metric : tool::GetMetrics())
  {
    text += "," + metric.Name;
  }
  text += ",unoccluded_error\n";
  for (const tool::ChartPair& pair : results.Pairs)
  {
    const std::vector<std::size_t> front = tool::FindFront(pair, tool::GetMetrics().front().Name);
    for (std::size_t k = 0; k < pair.Points.size(); ++k)
    {
      const tool::ChartPoint& point = pair.Points[k];
      text += Quote(pair.Material) + "," + Quote(pair.Environment) + "," + point.Method + "," +
              Quote(point.Size);
      const double figures[] = { point.SetUp, point.Frame, point.FrameLow, point.FrameHigh,
        static_cast<double>(point.NumberOfFrames), point.Bytes,
        static_cast<double>(point.Fetches) };
      for (const double figure : figures)
      {
        text += "," + (point.IsMeasured() ? FormatFinite(figure) : "");
      }
      text += std::find(front.begin(), front.end(), k) != front.end() ? ",1" : ",0";
      text += "," + (point.IsMeasured() ? "" : Quote(point.Left));
      for (const tool::Metric& metric : tool::GetMetrics())
      {
        const auto error = point.Errors.find(metric.Name);
        text += "," + (error == point.Errors.end() ? "" : FormatFinite(error->second));
      }
      text += "," + FormatFinite(pair.UnoccludedError) + "\n";
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
const ChartPair* ChartResults::Find(
  const std::string& material, const std::string& environment) const
{
  const auto found = std::find_if(this->Pairs.begin(), this->Pairs.end(),
    [&](const ChartPair& pair)
    { return pair.Material == material && pair.Environment == environment; });
  return found == this->Pairs.end() ? nullptr : &*found;
}

//------------------------------------------------------------------------------
double GetLoad()
{
  double load = 0.0;
  return getloadavg(&load, 1) == 1 ? load : -1.0;
}

//------------------------------------------------------------------------------
std::vector<std::size_t> FindFront(const ChartPair& pair, const std::string& metric)
{
  return FindFront(GetCosts(pair, metric));
}

//------------------------------------------------------------------------------
std::vector<PlannerFigure> RatePlanner(const ChartPair& pair, const std::string& metric)
{
  const std::vector<CostPoint> costs = GetCosts(pair, metric);
  std::vector<PlannerFigure> figures;
  for (std::size_t k = 0; k < pair.Points.size(); ++k)
  {
    if (pair.Points[k].Method == PlannerMethod && pair.Points[k].IsMeasured())
    {
      figures.push_back({ k, costs[k].Cost / GetFrontCost(costs, costs[k].Error) });
    }
  }
  return figures;
}

//------------------------------------------------------------------------------
double GetShareWithin(const ChartResults& results, const std::string& metric, double margin)
{
  int all = 0;
  int within = 0;
  for (const ChartPair& pair : results.Pairs)
  {
    for (const PlannerFigure& figure : RatePlanner(pair, metric))
    {
      ++all;
      within += figure.OverFront <= 1.0 + margin;
    }
  }
  return all > 0 ? static_cast<double>(within) / all : std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
void SaveResults(const std::string& folder, const ChartResults& results)
{
  JSON json = { { "format", ChartResults::Format }, { "version", ChartResults::Version },
    { "date", GetToday() }, { "settings", results.Settings }, { "machine", results.Machine },
    { "planner_within_20_percent_of_front",
      GetShareWithin(results, GetMetrics().front().Name, FrontMargin) },
    { "pairs", JSON::array() } };
  for (const ChartPair& pair : results.Pairs)
  {
    json["pairs"].push_back(WritePair(pair));
  }
  WriteWhole(folder + "/results.csv", MakeCSV(results));
  WriteWhole(
    folder + "/results.json", json.dump(1, ' ', false, JSON::error_handler_t::replace) + "\n");
}

//------------------------------------------------------------------------------
ChartResults LoadResults(const std::string& folder, const JSON& settings, const JSON& machine)
{
  ChartResults results;
  results.Settings = settings;
  results.Machine = machine;
  const std::string path = folder + "/results.json";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    return results;
  }
  errno = 0;
  std::ifstream file(path);
  if (!file.is_open())
  {
    throw Error(path + ": can't be opened: " + std::strerror(errno));
  }
  JSON json;
  try
  {
    json = measuredbrdf::ParseJson<JSON>(file);
  }
  catch (const std::exception&)
  {
    // It has no format then; below.
  }
  const auto get = [&json](const char* name)
  { return json.is_object() && json.contains(name) ? json.at(name) : JSON(); };
  if (get("format") != ChartResults::Format)
  {
    throw Error(path + ": was not written by 'measured-brdf chart', and is left as it is. Write to "
                       "another folder");
  }
  if (get("version") != ChartResults::Version)
  {
    throw Error(path + ": is of version " + get("version").dump() +
                " of its format, this program "
                "goes on with version " +
                std::to_string(ChartResults::Version) + ". Write to another folder");
  }
  CheckSame(path, "setting", get("settings"), settings);
  CheckSame(path, "machine", get("machine"), machine);
  try
  {
    for (const JSON& pair : json.at("pairs"))
    {
      results.Pairs.push_back(ReadPair(pair));
    }
  }
  catch (const std::exception& e) // of nlohmann: missing, or of another type
  {
    throw Error(path + ": is damaged: " + e.what() + ". Remove it or write to another folder");
  }
  return results;
}
} // namespace tool
