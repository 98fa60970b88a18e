// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include "vtkBRDFReader.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkVersion.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <regex>
#include <sstream>

namespace
{
//------------------------------------------------------------------------------
// "ERROR: In FILE, line N\nvtkFoo (0x...): text\n\n" -> "text"; so too where text is such a message
// itself, of an object that vtkFoo forwards.
std::string StripOrigin(const char* message)
{
  std::istringstream lines(message ? message : "");
  std::string text;
  for (std::string line; std::getline(lines, line);)
  {
    static const std::regex where("^(ERROR|Warning|WARNING|Generic Warning): In .*, line [0-9]+$");
    static const std::regex who("^vtk[A-Za-z0-9]+ \\((0x)?[0-9A-Fa-f]+\\): ");
    line = std::regex_replace(line, who, "");
    if (line.empty() || std::regex_search(line, where))
    {
      continue;
    }
    text += (text.empty() ? "" : " ") + line;
  }
  return text;
}

//------------------------------------------------------------------------------
class MessageWindow : public vtkOutputWindow
{
public:
  static MessageWindow* New();
  vtkTypeMacro(MessageWindow, vtkOutputWindow);

  void DisplayErrorText(const char* message) override
  {
    const std::string text = StripOrigin(message);
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
    // VTK aborts the process after this message; later versions turn to EGL or OSMesa.
    if (text.find("bad X server connection") != std::string::npos)
    {
      std::cerr << "measured-brdf: error: rendering needs an X server with this VTK ("
                << vtkVersion::GetVTKVersion()
                << "), and there is none at $DISPLAY. Without a screen, put xvfb-run before the "
                   "command: xvfb-run -a measured-brdf ..."
                << std::endl;
      std::_Exit(1);
    }
#endif
    this->Errors += (this->Errors.empty() ? "" : "; ") + text;
  }

  void DisplayWarningText(const char* message) override
  {
    std::cerr << "measured-brdf: warning: " << vtkBRDFReader::GetPrintable(StripOrigin(message))
              << std::endl;
  }
  void DisplayGenericWarningText(const char* message) override
  {
    this->DisplayWarningText(message);
  }
  void DisplayText(const char* message) override
  {
    std::cerr << vtkBRDFReader::GetPrintable(message) << std::flush;
  }
  void DisplayDebugText(const char*) override {}

  std::string Errors;

protected:
  MessageWindow() = default;
  ~MessageWindow() override = default;
};
vtkStandardNewMacro(MessageWindow);
}

namespace tool
{
//------------------------------------------------------------------------------
void PrintNote(const std::string& text)
{
  if (!text.empty())
  {
    std::cerr << "measured-brdf: note: " << vtkBRDFReader::GetPrintable(text)
              << (text.back() == '\n' ? "" : "\n") << std::flush;
  }
}

//------------------------------------------------------------------------------
void PrintOut(const std::string& text)
{
  std::cout << vtkBRDFReader::GetPrintable(text) << std::flush;
  if (!std::cout)
  {
    throw Error("standard output: could not be written");
  }
}

//------------------------------------------------------------------------------
void RedirectMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<MessageWindow> window;
  vtkOutputWindow::SetInstance(window);
}

//------------------------------------------------------------------------------
std::string TakeErrorText()
{
  std::string errors;
  if (auto* window = MessageWindow::SafeDownCast(vtkOutputWindow::GetInstance()))
  {
    errors.swap(window->Errors);
  }
  return errors;
}

//------------------------------------------------------------------------------
std::string FormatNumber(double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

//------------------------------------------------------------------------------
std::string FormatCount(std::size_t count, const std::string& noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}
} // namespace tool
