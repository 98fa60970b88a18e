// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DartMeasurements.h"

#include "Files.h"
#include "Tool.h"

#include <cstdlib>
#include <filesystem>

namespace
{
//------------------------------------------------------------------------------
std::string Escape(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}
}

namespace tool
{
//------------------------------------------------------------------------------
bool IsRunByCTest()
{
  // CTest sets the first for every test, to 0 or 1; older ones set the second.
  return std::getenv("CTEST_INTERACTIVE_DEBUG_MODE") || std::getenv("DASHBOARD_TEST_FROM_CTEST");
}

//------------------------------------------------------------------------------
std::string FormatMeasurement(const std::string& name, double value)
{
  return "<DartMeasurement name=\"" + name + "\" type=\"numeric/double\">" + FormatNumber(value) +
         "</DartMeasurement>\n";
}

//------------------------------------------------------------------------------
std::string FormatMeasurement(const std::string& name, const std::string& text)
{
  return "<DartMeasurement name=\"" + name + "\" type=\"text/string\">" + Escape(text) +
         "</DartMeasurement>\n";
}

//------------------------------------------------------------------------------
std::string FormatMeasurementFile(const std::string& name, const std::string& path)
{
  const std::string extension = Extension(path);
  const std::string type = extension == ".png"                           ? "image/png"
                           : extension == ".jpg" || extension == ".jpeg" ? "image/jpeg"
                                                                         : "file";
  // CTest looks for the file from where it runs itself.
  std::error_code ignored;
  return "<DartMeasurementFile name=\"" + name + "\" type=\"" + type + "\">" +
         std::filesystem::absolute(path, ignored).string() + "</DartMeasurementFile>\n";
}
} // namespace tool
