// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What has to be set before there is a QApplication.
 */

#ifndef Application_h
#define Application_h

namespace explorer
{
/// Contexts that views share, high-DPI displays, VTK's messages for tool::TakeErrorText.
void PrepareApplication();

/// To be called after the QApplication was made, which sets the user's locale: numbers in files
/// have points.
void PrepareLocale();
} // namespace explorer

#endif
