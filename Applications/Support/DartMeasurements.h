// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What CTest takes out of a test's output and sends to CDash: numbers, texts and files, in the
 * elements that vtkTesting writes.
 */

#ifndef DartMeasurements_h
#define DartMeasurements_h

#include <string>

namespace tool
{
/// Whether CTest runs this program.
bool IsRunByCTest();

///@{
/// The element for a number, a text, or a file (an image where its name's ending says so), in one
/// line.
std::string FormatMeasurement(const std::string& name, double value);
std::string FormatMeasurement(const std::string& name, const std::string& text);
std::string FormatMeasurementFile(const std::string& name, const std::string& path);
///@}
} // namespace tool

#endif
