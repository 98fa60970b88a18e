// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the subcommands of measured-brdf share: errors, messages, and their registration.
 */

#ifndef Tool_h
#define Tool_h

#include <cstddef>
#include <stdexcept>
#include <string>

namespace CLI
{
class App;
}

namespace tool
{
/// Something went wrong while running (a bad file, say): exit status 1.
struct Error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The command was called the wrong way: exit status 2.
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Bad input, in a command where exit status 1 says something else: exit status 2.
struct InputError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// What messages begin with; RunProgram sets it.
inline std::string ProgramName = "measured-brdf";

/// "PROGRAM: note: TEXT" on stderr, or to this thread's BackgroundWork; nothing where text is
/// empty.
void PrintNote(const std::string& text);

/// Text on stdout, flushed; Error where stdout can't take it (a full disk, a closed pipe).
void PrintOut(const std::string& text);

/// VTK's messages become the tool's: warnings go to stderr, errors wait for TakeErrorText.
void RedirectMessages();

/// What VTK's error events said since the last call, without file and line; "" if nothing. Of this
/// thread where it has a BackgroundWork.
std::string TakeErrorText();

/// Figures that stand in CSV files: 9 significant digits, enough to give back any float.
std::string FormatNumber(double value);

/// "1 pair", "2 pairs".
std::string FormatCount(std::size_t count, const std::string& noun);

///@{
/// Add one subcommand each.
void AddListCommand(CLI::App& app);
void AddFetchCommand(CLI::App& app);
void AddInfoCommand(CLI::App& app);
void AddEvaluateCommand(CLI::App& app);
void AddExploreCommand(CLI::App& app);
void AddIntegrateCommand(CLI::App& app);
void AddLightsCommand(CLI::App& app);
void AddRenderCommand(CLI::App& app);
void AddPlanCommand(CLI::App& app);
void AddCompareCommand(CLI::App& app);
void AddDiffCommand(CLI::App& app);
void AddChartCommand(CLI::App& app);
void AddGalleryCommand(CLI::App& app);
void AddConvertCommand(CLI::App& app);
void AddSvbrdfCommand(CLI::App& app);
void AddFitCommand(CLI::App& app);
void AddExportCommand(CLI::App& app);
///@}
} // namespace tool

#endif
