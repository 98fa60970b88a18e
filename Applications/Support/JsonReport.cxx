// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "JsonReport.h"

#include "Files.h"
#include "Tool.h"

#include <algorithm>
#include <cstdio>
#include <vector>

using nlohmann::ordered_json;

namespace
{
//------------------------------------------------------------------------------
// "indexOfRefraction" and "gains_energy" as words.
std::string ToWords(const std::string& key)
{
  std::string words;
  for (const char c : key)
  {
    words += c >= 'A' && c <= 'Z' ? std::string(" ") + static_cast<char>(c - 'A' + 'a')
                                  : std::string(1, c == '_' ? ' ' : c);
  }
  return words;
}

//------------------------------------------------------------------------------
std::string FormatJsonValue(const ordered_json& value, const char* format = "%.4g")
{
  if (value.is_number_float())
  {
    char text[40];
    std::snprintf(text, sizeof(text), format, value.get<double>());
    return text;
  }
  if (value.is_array())
  {
    std::string list;
    for (const ordered_json& one : value)
    {
      list += (list.empty() ? "" : ", ") + FormatJsonValue(one);
    }
    return list;
  }
  return value.is_boolean()  ? (value.get<bool>() ? "yes" : "no")
         : value.is_string() ? value.get<std::string>()
                             : value.dump();
}

//------------------------------------------------------------------------------
// Rows with the same keys, under these. An array takes a column for each of its values.
std::string FormatTable(const ordered_json& rows, const std::string& indent)
{
  std::vector<std::vector<std::string>> lines(1);
  std::vector<bool> isText; // of each column: it begins at the left
  for (const ordered_json& row : rows)
  {
    lines.emplace_back();
    for (const auto& [key, value] : row.items())
    {
      const ordered_json cells = value.is_array() ? value : ordered_json::array({ value });
      for (const ordered_json& cell : cells)
      {
        lines.back().push_back(FormatJsonValue(cell, value.is_array() ? "%.4f" : "%.4g"));
        if (lines.size() == 2)
        {
          lines.front().push_back(&cell == &cells.back() ? ToWords(key) : "");
          isText.push_back(cell.is_string());
        }
      }
    }
  }
  std::vector<std::size_t> widths(lines.front().size(), 10);
  std::string text;
  for (const auto& line : lines)
  {
    for (std::size_t k = 0; k < std::min(line.size(), widths.size()); ++k)
    {
      widths[k] = std::max(widths[k], line[k].size() + 2);
    }
  }
  for (const auto& line : lines)
  {
    text += indent;
    for (std::size_t k = 0; k < std::min(line.size(), widths.size()); ++k)
    {
      const std::string blanks(widths[k] - line[k].size(), ' ');
      text += isText[k] ? "  " + line[k] + blanks.substr(2) : blanks + line[k];
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

//------------------------------------------------------------------------------
// A line for each key, and what it holds below it.
std::string FormatObject(const ordered_json& object, const std::string& indent)
{
  std::string text;
  for (const auto& [key, value] : object.items())
  {
    std::string label = indent + ToWords(key);
    const bool hasObjects = value.is_array() && !value.empty() && value.front().is_object();
    if (value.is_object() && value.contains("shape"))
    {
      label.resize(std::max<std::size_t>(26, label.size() + 1), ' ');
      for (const ordered_json& size : value["shape"])
      {
        label += (&size == &value["shape"].front() ? "" : " x ") + size.dump();
      }
      text += label + (value["channels"] == 3 ? " RGB triples\n" : " numbers\n");
    }
    else if (value.is_object())
    {
      text += label + "\n" + FormatObject(value, indent + "  ");
    }
    else if (hasObjects && value.front().contains("model"))
    {
      for (const ordered_json& part : value)
      {
        text += label + "\n" + FormatObject(part, indent + "  ");
      }
    }
    else if (hasObjects)
    {
      text += label + "\n" + FormatTable(value, indent);
    }
    else if (const std::string said = FormatJsonValue(value); !said.empty())
    {
      label.resize(std::max<std::size_t>(26, label.size() + 1), ' ');
      text += label + said + "\n";
    }
  }
  return text;
}

//------------------------------------------------------------------------------
std::string Dump(const ordered_json& report)
{
  return report.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}
}

namespace tool
{
//------------------------------------------------------------------------------
std::string FormatReport(const ordered_json& report) { return FormatObject(report, ""); }

//------------------------------------------------------------------------------
void PrintReport(const ordered_json& report, bool asJson)
{
  PrintOut(asJson ? Dump(report) : FormatReport(report));
}

//------------------------------------------------------------------------------
void WriteReport(const std::string& path, const ordered_json& report)
{
  if (!path.empty())
  {
    WriteWhole(path, Dump(report));
  }
}
} // namespace tool
