// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"

#include "NumberText.h"
#include "Tool.h"
#include "WholeFile.h"

#include "vtkBRDFWriter.h"
#include "vtkNew.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;

namespace
{
//------------------------------------------------------------------------------
// Cells without surrounding blanks and quotes. Commas inside quotes belong to the cell (RFC 4180).
std::vector<std::string> Split(const std::string& line)
{
  constexpr const char* blanks = " \t\r\n\v\f";
  std::vector<std::string> cells(1);
  bool isQuoted = false;
  for (const char c : line)
  {
    isQuoted = isQuoted != (c == '"');
    if (c == ',' && !isQuoted)
    {
      cells.emplace_back();
    }
    else if (c != '"')
    {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells)
  {
    cell.erase(0, std::min(cell.find_first_not_of(blanks), cell.size()));
    cell.erase(cell.find_last_not_of(blanks) + 1);
  }
  return cells;
}

//------------------------------------------------------------------------------
// Where each column stands in the header line.
std::array<std::size_t, 6> FindColumns(
  const std::string& line, const tool::PairColumns& columns, const std::string& where)
{
  const std::vector<std::string> names = Split(line);
  std::array<std::size_t, 6> places{};
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    const auto found = std::find(names.begin(), names.end(), columns[c]);
    if (found == names.end())
    {
      throw tool::Error(
        where + ": no column '" + columns[c] + "' in the header '" + line.substr(0, 80) + "'");
    }
    if (std::find(found + 1, names.end(), columns[c]) != names.end())
    {
      throw tool::Error(where + ": column '" + columns[c] + "' appears twice");
    }
    places[c] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

//------------------------------------------------------------------------------
tool::Pair ParsePair(const std::string& line, const tool::PairColumns& columns,
  const std::array<std::size_t, 6>& places, std::size_t width, const std::string& where)
{
  const std::vector<std::string> cells = Split(line);
  if (cells.size() != width)
  {
    throw tool::Error(where + ": found " + std::to_string(cells.size()) +
                      " cells, expected as many as the header's " + std::to_string(width));
  }
  tool::Pair pair{};
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    if (cells[places[c]].empty())
    {
      throw tool::Error(where + ": no value for column '" + columns[c] + "'");
    }
    const std::string& cell = cells[places[c]];
    if (!measuredbrdf::ParseNumber(cell, pair[c]))
    {
      throw tool::Error(where + ": column '" + columns[c] + "': '" + cell.substr(0, 40) +
                        "' is not a finite number");
    }
  }
  for (std::size_t first = 0; first < 6; first += 3)
  {
    const double length = std::hypot(pair[first], pair[first + 1], pair[first + 2]);
    if (!(length > 0.0) || !std::isfinite(length))
    {
      throw tool::Error(where + ": the direction (" + columns[first] + "," + columns[first + 1] +
                        "," + columns[first + 2] + ") has no usable length");
    }
  }
  return pair;
}

//------------------------------------------------------------------------------
std::string Reason() { return errno ? std::strerror(errno) : "unknown reason"; }
}

namespace tool
{
//------------------------------------------------------------------------------
std::vector<Pair> ReadPairs(const std::string& path, const PairColumns& columns)
{
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
  {
    throw Error(path + ": is a directory, not a CSV file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    throw Error(path + ": can't be opened: " + Reason());
  }

  std::vector<Pair> pairs;
  std::array<std::size_t, 6> places{};
  std::size_t width = 0;
  bool haveHeader = false;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);)
  {
    if (++number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0)
    {
      line.erase(0, 3); // byte order mark
    }
    line = line.substr(0, line.find_last_not_of(" \t\r\n\v\f") + 1);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#')
    {
      continue;
    }
    const std::string where = path + ", line " + std::to_string(number);
    if (!haveHeader)
    {
      places = FindColumns(line, columns, where);
      width = Split(line).size();
      haveHeader = true;
      continue;
    }
    pairs.push_back(ParsePair(line, columns, places, width, where));
  }
  if (file.bad())
  {
    throw Error(path + ": can't be read: " + Reason());
  }
  if (!haveHeader)
  {
    std::string names = columns[0];
    for (std::size_t c = 1; c < columns.size(); ++c)
    {
      names += "," + columns[c];
    }
    throw Error(path + ": is empty; a header line with the columns " + names + " was expected");
  }
  return pairs;
}

//------------------------------------------------------------------------------
std::string QuoteCell(const std::string& text)
{
  std::string cell = "\"";
  for (const char c : text)
  {
    cell += c == '"' ? "\"\"" : std::string(1, c);
  }
  return cell + "\"";
}

//------------------------------------------------------------------------------
void WriteResults(const std::string& path, const PairColumns& columns,
  const std::vector<Pair>& pairs, const std::vector<double>& rgb)
{
  std::string text;
  for (const std::string& column : columns)
  {
    text += column + ",";
  }
  text += "r,g,b\n";
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    for (const double value : pairs[k])
    {
      text += FormatNumber(value) + ",";
    }
    text += FormatNumber(rgb[3 * k]) + "," + FormatNumber(rgb[3 * k + 1]) + "," +
            FormatNumber(rgb[3 * k + 2]) + "\n";
  }
  if (path.empty())
  {
    PrintOut(text);
  }
  else
  {
    WriteWhole(path, text);
  }
}

//------------------------------------------------------------------------------
void WriteWhole(const std::string& path, std::string_view bytes)
{
  try
  {
    measuredbrdf::WriteWholeFile(path, bytes);
  }
  catch (const std::runtime_error& e)
  {
    throw Error(e.what());
  }
}

//------------------------------------------------------------------------------
void CheckWritable(const std::string& path)
{
  if (path.empty())
  {
    return;
  }
  try
  {
    measuredbrdf::CheckWritePlace(path);
  }
  catch (const std::runtime_error& e)
  {
    throw Error(e.what());
  }
}

//------------------------------------------------------------------------------
void MakeFolder(const std::string& path)
{
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path))
  {
    throw Error(path + ": the folder can't be made" + (error ? ": " + error.message() : ""));
  }
}

//------------------------------------------------------------------------------
void WriteMaterial(vtkBRDF* brdf, const std::string& path, bool halfFloats)
{
  vtkNew<vtkBRDFWriter> writer;
  writer->SetFileName(path);
  writer->SetBRDF(brdf);
  writer->SetHalfFloats(halfFloats);
  if (!writer->Write())
  {
    const std::string logged = TakeErrorText();
    const std::string said = writer->GetErrorMessage();
    throw Error(!said.empty() ? said : path + ": " + logged);
  }
}

//------------------------------------------------------------------------------
std::string Extension(const std::string& path)
{
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}
} // namespace tool
