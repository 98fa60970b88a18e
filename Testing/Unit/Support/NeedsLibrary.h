// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * At the begin of a test that needs an optional library: skips it where the build has none.
 */

#ifndef NeedsLibrary_h
#define NeedsLibrary_h

#include "vtkMeasuredBRDFConfigure.h"

#include <gtest/gtest.h>

#define SKIP_UNLESS(has, library) \
  if (!(has))                     \
  GTEST_SKIP() << "this build has no " library

#define NEEDS_OPENEXR() SKIP_UNLESS(MEASUREDBRDF_WITH_OPENEXR, "OpenEXR")
#define NEEDS_OPENIMAGEIO() SKIP_UNLESS(MEASUREDBRDF_WITH_OPENIMAGEIO, "OpenImageIO")

#endif
