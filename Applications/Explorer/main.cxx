// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The explorer: `measured-brdf explore` starts it.

#include "Inputs.h"
#include "MeasuredBRDFToolVersion.h"
#include "Window.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <filesystem>
#include <iostream>

namespace
{
//------------------------------------------------------------------------------
// Files by their whole paths, so that states can be opened from elsewhere.
QString ToPath(const std::string& file)
{
  std::error_code ignored;
  const std::string path = file.substr(0, file.find('#'));
  return QString::fromStdString(
    std::filesystem::exists(path, ignored)
      ? std::filesystem::absolute(path, ignored).string() + file.substr(path.size())
      : file);
}

//------------------------------------------------------------------------------
int Run(int argc, char* argv[])
{
  std::vector<std::string> files;
  std::string environment;
  CLI::App app("Explore measured materials in a window.", "measured-brdf explore");
  app.set_version_flag("--version", "measured-brdf " MEASUREDBRDF_VERSION);
  app.add_option("FILE", files,
    "What to open: materials (names or files), environment images, meshes, a state (.json)");
  app.add_option("--environment", environment, tool::EnvironmentHelp);
  tool::AddProjectionOption(&app);
  app.footer(
    "Files can also be dropped into the window.\n\nExample:\n  measured-brdf explore gold-paint "
    "--environment hall");
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? 0 : 2;
  }
  explorer::State state;
  explorer::Window window(state);
  QStringList paths;
  for (const std::string& file : files)
  {
    paths << ToPath(file);
  }
  if (!environment.empty())
  {
    window.GetSession()->SetEnvironment(ToPath(environment).toStdString());
  }
  window.GetSession()->Open(paths);
  window.show();
  return QApplication::exec();
}
}

int main(int argc, char* argv[])
{
  std::signal(SIGXFSZ, SIG_IGN); // a limit of file sizes is an error with a message
  for (int k = 1; k < argc; ++k) // before a display is asked for
  {
    if (std::string(argv[k]) == "--help" || std::string(argv[k]) == "-h" ||
        std::string(argv[k]) == "--version")
    {
      return Run(argc, argv);
    }
  }
  const explorer::Application application(argc, argv);
  QApplication::setApplicationName("measured-brdf-explorer");
  try
  {
    return Run(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << "measured-brdf: error: " << error.what() << std::endl;
    return 1;
  }
}
