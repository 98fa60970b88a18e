// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CommaLocale.h"
#include "SkyCodeText.h"

#include <gtest/gtest.h>

// A comma in GLSL separates arguments: under such a locale self-shadowed surfaces were empty.
TEST(ShaderText, HasDecimalPointsInEveryLocale)
{
  const CommaLocale commas;
  if (!commas.SetsC)
  {
    GTEST_SKIP() << "no locale with decimal commas here";
  }
  EXPECT_EQ(measuredbrdf::Number(0.25), "0.250000000");
  EXPECT_EQ(measuredbrdf::Along(0), "vec2(1.000000000, 0.000000000)");
}
