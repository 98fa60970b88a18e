// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

#include "Meshes.h"
#include "Tool.h"

#include "MeasuredBRDFToolVersion.h"
#include "vtkBRDFReader.h"
#include "vtkVersion.h"

#include <CLI/CLI.hpp>

#include <sys/utsname.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>

namespace
{
//------------------------------------------------------------------------------
// CLI11 prints a description as it is: break it between words.
std::string Wrap(const std::string& text)
{
  constexpr std::size_t width = 62;
  std::istringstream words(text);
  std::string result;
  std::size_t column = 0;
  for (std::string word; words >> word;)
  {
    const bool fits = column + 1 + word.size() <= width;
    result += column == 0 ? "" : (fits ? " " : "\n");
    column = fits && column > 0 ? column + 1 + word.size() : word.size();
    result += word;
  }
  return result;
}

//------------------------------------------------------------------------------
int RunUnguarded(int argc, char* argv[], const tool::Program& program)
{
  tool::RedirectMessages();
  if (argc == 4 && std::string(argv[1]) == tool::ReadMeshOption)
  {
    return tool::AnswerLoadMesh(argv[2], argv[3]);
  }

  tool::ProgramName = program.Name;
  CLI::App app(program.Description, program.Name);
#if CLI11_VERSION_MAJOR > 2 || CLI11_VERSION_MINOR >= 5
  // From 2.5 on CLI11 fills paragraphs; these have their line breaks already.
  app.get_formatter()->enable_description_formatting(false);
  app.get_formatter()->enable_footer_formatting(false);
#endif
  app.require_subcommand(1);
  app.set_version_flag("--version", program.Name + " " MEASUREDBRDF_VERSION);
  app.footer(program.Footer +
             "\n\nExit status: 0 done, 1 failed (a bad file, say), 2 called the wrong way.");
  program.AddCommands(app);

  for (CLI::App* command : app.get_subcommands({}))
  {
    for (CLI::Option* option : command->get_options())
    {
      option->description(Wrap(option->get_description()));
    }
  }

  if (argc == 1)
  {
    std::cerr << app.help();
    return 2;
  }
  try
  {
    app.parse(argc, argv);
    return 0;
  }
  catch (const CLI::ParseError& e)
  {
    std::ostringstream out, err; // which quote the arguments
    const int status = app.exit(e, out, err);
    std::cout << vtkBRDFReader::GetPrintable(out.str()) << std::flush;
    std::cerr << vtkBRDFReader::GetPrintable(err.str()) << std::flush;
    return status == 0 ? 0 : 2; // 0: --help, --version
  }
  catch (const tool::UsageError& e)
  {
    std::cerr << program.Name << ": " << vtkBRDFReader::GetPrintable(e.what())
              << "\nRun with --help for more information." << std::endl;
    return 2;
  }
  catch (const std::exception& e)
  {
    std::cerr << program.Name << ": error: " << vtkBRDFReader::GetPrintable(e.what()) << std::endl;
    return dynamic_cast<const tool::InputError*>(&e) ? 2 : 1;
  }
}
}

namespace tool
{
//------------------------------------------------------------------------------
int RunProgram(int argc, char* argv[], const Program& program)
{
  std::signal(SIGXFSZ, SIG_IGN); // a limit of file sizes is an error with a message
  try
  {
    return RunUnguarded(argc, argv, program);
  }
  catch (const std::exception& e) // before there was a command: no memory, say
  {
    std::fprintf(stderr, "%s: error: %s\n", program.Name.c_str(), e.what());
    return 1;
  }
}

//------------------------------------------------------------------------------
nlohmann::ordered_json DescribeMachine()
{
  std::string processor = "unknown";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t colon = line.find(": ");
    if (line.compare(0, 10, "model name") == 0 && colon != std::string::npos)
    {
      processor = line.substr(colon + 2);
      break;
    }
  }
  utsname system{};
  uname(&system);
  return { { "processor", processor }, { "threads", std::thread::hardware_concurrency() },
    { "system", std::string(system.sysname) + " " + system.machine },
    { "vtk", vtkVersion::GetVTKVersion() }, { "program", MEASUREDBRDF_VERSION } };
}

//------------------------------------------------------------------------------
std::string FindBeside(const std::string& program)
{
  std::error_code error;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto beside = own.parent_path() / program;
  return !error && std::filesystem::exists(beside, error) ? beside.string() : "";
}

//------------------------------------------------------------------------------
void AddAbsentCommand(CLI::App& app, const std::string& name, const std::string& reason)
{
  CLI::App* command = app.add_subcommand(name, "");
  command->group("");
  command->set_help_flag();
  command->allow_extras();
  command->callback([name, reason]() { throw Error(name + ": " + reason); });
}
} // namespace tool
