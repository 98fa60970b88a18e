// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionMethodRows.h"

#include "ChartPage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

void OcclusionMethodRow::PrintHeading()
{
  std::printf("mesh,material,map,method,error %%,frame over off\n");
}

void OcclusionMethodRow::Print() const
{
  std::printf("%s,%s,%s,%s,%.3f,%.3f\n", this->Mesh.c_str(), this->Material.c_str(),
    this->Map.c_str(), this->Method.c_str(), 100.0 * this->Error, this->Frame);
  std::fflush(stdout);
}

std::vector<OcclusionMethodRow> ReadOcclusionMethodRows(const std::string& file)
{
  std::vector<OcclusionMethodRow> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
  {
    std::istringstream fields(line);
    OcclusionMethodRow row;
    char comma = ' ';
    if (std::getline(fields, row.Mesh, ',') && std::getline(fields, row.Material, ',') &&
        std::getline(fields, row.Map, ',') && std::getline(fields, row.Method, ',') &&
        fields >> row.Error >> comma >> row.Frame && !row.Material.empty())
    {
      row.Error /= 100.0;
      rows.push_back(row);
    }
  }
  return rows;
}

namespace
{
// Without SSAO's radius.
std::string GetName(const std::string& method)
{
  return method.rfind("ssao", 0) == 0 ? method.substr(0, method.rfind(' ')) : method;
}

OcclusionMethodMean GetMean(const std::vector<OcclusionMethodRow>& rows)
{
  OcclusionMethodMean mean = { rows.front().Method, rows.front().Mesh, 0.0, 0.0, 0.0,
    static_cast<int>(rows.size()) };
  for (const OcclusionMethodRow& row : rows)
  {
    mean.Error += row.Error / mean.Count;
    mean.Worst = std::max(mean.Worst, row.Error);
    mean.Frame += std::log(row.Frame) / mean.Count;
  }
  mean.Frame = std::exp(mean.Frame);
  return mean;
}
}

std::vector<OcclusionMethodMean> GetOcclusionMethodMeans(
  const std::vector<OcclusionMethodRow>& rows)
{
  std::map<std::pair<std::string, std::string>, std::vector<OcclusionMethodRow>> groups;
  for (const OcclusionMethodRow& row : rows)
  {
    groups[{ row.Method, row.Mesh }].push_back(row);
  }
  std::map<std::pair<std::string, std::string>, std::vector<OcclusionMethodRow>> kept;
  for (auto& [key, group] : groups)
  {
    auto& place = kept[{ GetName(key.first), key.second }];
    if (place.empty() || GetMean(group).Error < GetMean(place).Error)
    {
      place = group;
    }
  }
  std::vector<OcclusionMethodMean> means;
  std::map<std::string, std::vector<OcclusionMethodRow>> all;
  for (const auto& [key, group] : kept)
  {
    means.push_back(GetMean(group));
    auto& place = all[key.first];
    place.insert(place.end(), group.begin(), group.end());
  }
  for (const auto& [method, group] : all)
  {
    means.push_back(GetMean(group));
    means.back().Method = method;
    means.back().Mesh.clear();
  }
  return means;
}

void PrintOcclusionMethodMeans(const std::vector<OcclusionMethodMean>& means)
{
  std::printf("\nmethod,mesh,pictures,mean error %%,worst %%,frame over off\n");
  for (const OcclusionMethodMean& mean : means)
  {
    std::printf("%s,%s,%d,%.2f,%.2f,%.3f\n", mean.Method.c_str(),
      mean.Mesh.empty() ? "all" : mean.Mesh.c_str(), mean.Count, 100.0 * mean.Error,
      100.0 * mean.Worst, mean.Frame);
  }
}

void DrawOcclusionMethods(const std::vector<OcclusionMethodMean>& means, const std::string& stem)
{
  const std::vector<std::pair<std::string, tool::PageCurve>> methods = {
    { "off", { "off", { 0.45, 0.45, 0.45 }, {}, {} } },
    { "ambient", { "AO factor", { 0.75, 0.45, 0.05 }, {}, {} } },
    { "ssao", { "SSAO", { 0.65, 0.15, 0.55 }, {}, {} } },
    { "shadows 1", { "1 shadow map", { 0.15, 0.55, 0.65 }, {}, {} } },
    { "shadows 4", { "4 shadow maps", { 0.1, 0.45, 0.75 }, {}, {} } },
    { "shadows 16", { "16 shadow maps", { 0.05, 0.25, 0.8 }, {}, {} } },
    { "on", { "this module", { 0.1, 0.55, 0.15 }, {}, {} } },
  };
  tool::Page page;
  page.Title = "What surfaces hide from themselves";
  int count = 0;
  for (const auto& [name, style] : methods)
  {
    tool::PageCurve curve = style;
    for (const OcclusionMethodMean& mean : means)
    {
      const bool isMean = mean.Mesh.empty();
      if ((isMean ? mean.Method : GetName(mean.Method)) == name)
      {
        const tool::PagePoint point = { mean.Frame, mean.Error };
        isMean ? page.Marks.push_back({ point, curve.Label, name == "on" })
               : curve.Points.push_back(point);
        count = isMean ? mean.Count : count;
      }
    }
    page.Curves.push_back(curve);
  }
  // What is better than all that is cheaper.
  std::vector<tool::PagePoint> cheaper;
  for (const tool::PageMark& mark : page.Marks)
  {
    cheaper.push_back(mark.Point);
  }
  std::sort(cheaper.begin(), cheaper.end(),
    [](const tool::PagePoint& a, const tool::PagePoint& b) { return a.X < b.X; });
  for (const tool::PagePoint& point : cheaper)
  {
    if (page.Front.empty() || point.Y < page.Front.back().Y)
    {
      page.Front.push_back(point);
    }
  }
  page.Subtitle = std::to_string(count) +
                  " pictures: a dot for each mesh, a mark for the mean of all; llvmpipe, 500x500";
  page.XLabel = "processor time of a frame, over one without occlusion";
  page.XUnit = tool::Unit::Number;
  page.YLabel = "relative L1 error, of occlusion alone";
  tool::DrawPage(page, stem);
}
