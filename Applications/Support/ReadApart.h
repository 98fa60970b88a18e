// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Work that trusts a file, in a process of its own.
 */

#ifndef ReadApart_h
#define ReadApart_h

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>

namespace tool
{
/**
 * What AnswerApart makes of a file, in a process of the tool's program. A crash there is an Error
 * here that names the file, and Ctrl-C, or the stop of this thread's BackgroundWork, ends that
 * process whatever it does. Errors that read throws and notes that it prints pass through. Where
 * the tool's program does not lie beside this one, or is not found (Windows, macOS), read runs in
 * this process.
 */
vtkSmartPointer<vtkPolyData> ReadApart(
  const std::string& path, const std::function<vtkSmartPointer<vtkPolyData>()>& read);

/// The tool's first argument in that process; the file's path is the second.
constexpr const char* ReadMeshOption = "--read-mesh-for-parent";

/// Write what read returns, or its error, to standard output for ReadApart. Returns the status.
int AnswerApart(const std::string& path, const std::function<vtkSmartPointer<vtkPolyData>()>& read);
} // namespace tool

#endif
