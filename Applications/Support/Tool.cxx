// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tool.h"

#include "NumberText.h"
#include "Progress.h"

#include "vtkBRDFReader.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkVersion.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <sstream>
#include <utility>

namespace
{
//------------------------------------------------------------------------------
// "ERROR: In FILE, line N"
bool IsPlace(const std::string& line)
{
  const auto begins = [&line](const char* kind) { return line.rfind(kind, 0) == 0; };
  const std::size_t number = line.rfind(", line ");
  return (begins("ERROR: In ") || begins("Warning: In ") || begins("WARNING: In ") ||
           begins("Generic Warning: In ")) &&
         number != std::string::npos &&
         line.find_first_not_of("0123456789", number + 7) == std::string::npos;
}

//------------------------------------------------------------------------------
// "ERROR: In FILE, line N\nvtkFoo (0x...): text\n\n" -> "text"; so too where text is such a message
// itself, of an object that vtkFoo forwards.
std::string StripOrigin(const char* message)
{
  std::istringstream lines(message ? message : "");
  std::string text;
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t object = line.find(" (");
    const std::size_t end = line.find("): ");
    if (line.rfind("vtk", 0) == 0 && object == line.find(' ') && end != std::string::npos &&
        line.find_first_not_of("0123456789abcdefABCDEFx", object + 2) == end)
    {
      line.erase(0, end + 3);
    }
    if (!line.empty() && !IsPlace(line))
    {
      text += (text.empty() ? "" : " ") + line;
    }
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
      std::cerr << tool::ProgramName << ": error: rendering needs an X server with this VTK ("
                << vtkVersion::GetVTKVersion()
                << "), and there is none at $DISPLAY. Without a screen, put xvfb-run before the "
                   "command: xvfb-run -a measured-brdf ..."
                << std::endl;
      std::_Exit(1);
    }
#endif
    tool::BackgroundWork* work = tool::BackgroundWork::Get();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::string& errors = work ? work->Errors : this->Errors;
    errors += (errors.empty() ? "" : "; ") + text;
  }

  // This thread's where it has its own, else those of all others.
  std::string TakeErrors()
  {
    tool::BackgroundWork* work = tool::BackgroundWork::Get();
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return std::exchange(work ? work->Errors : this->Errors, std::string());
  }

  void DisplayWarningText(const char* message) override
  {
    std::cerr << tool::ProgramName
              << ": warning: " << vtkBRDFReader::GetPrintable(StripOrigin(message)) << std::endl;
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

protected:
  MessageWindow() = default;
  ~MessageWindow() override = default;

private:
  std::mutex Mutex; // threads plan, read and integrate
  std::string Errors;
};
vtkStandardNewMacro(MessageWindow);
}

namespace tool
{
//------------------------------------------------------------------------------
void PrintNote(const std::string& text)
{
  BackgroundWork* work = BackgroundWork::Get();
  if (work && !text.empty())
  {
    work->Notes += (work->Notes.empty() ? "" : "\n") + text;
  }
  else if (!text.empty())
  {
    std::cerr << ProgramName << ": note: " << vtkBRDFReader::GetPrintable(text)
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
  auto* window = MessageWindow::SafeDownCast(vtkOutputWindow::GetInstance());
  return window ? window->TakeErrors() : std::string();
}

//------------------------------------------------------------------------------
std::string FormatNumber(double value) { return measuredbrdf::NumberText(value, 9); }

//------------------------------------------------------------------------------
std::string FormatCount(std::size_t count, const std::string& noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}
} // namespace tool
