// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CommaLocale.h"
#include "NumberText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <locale>
#include <string>

using namespace measuredbrdf;

namespace
{
void ExpectPoints()
{
  EXPECT_EQ(NumberText(450.5), "450.5");
  EXPECT_EQ(NumberText(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(NumberText(1e-9, 2), "1e-09");
  EXPECT_EQ(NumberText(1234567.0, 9), "1234567");
  EXPECT_EQ(FixedText(-0.125, 9), "-0.125000000");
  EXPECT_EQ(FixedText(12345.6, 0), "12346");
  EXPECT_EQ(FixedText(1e300, 1).size(), 303u);
  EXPECT_EQ(FixedText(1e308, 200), "?"); // not more than its buffer
  TextStream text;
  text << 1234567 << " " << 0.5;
  EXPECT_EQ(text.str(), "1234567 0.5");
  double number = 0.0;
  EXPECT_TRUE(ParseNumber("+1.5e2", number));
  EXPECT_EQ(number, 150.0);
  EXPECT_TRUE(ParseNumber("-.25", number));
  EXPECT_EQ(number, -0.25);
  EXPECT_EQ(ReadNumber("2.5e1,3", number), 5u);
  EXPECT_EQ(number, 25.0);
  EXPECT_EQ(ReadNumber("0.5", number), 3u);
  EXPECT_EQ(ReadNumber("+1", number), 0u);
  for (const char* bad :
    { "", "+", "1,5", "1.5 ", "+-1", "++1", " 1", "nan", "inf", "1e999", "0.5x" })
  {
    EXPECT_FALSE(ParseNumber(bad, number)) << bad;
  }
}
}

//------------------------------------------------------------------------------
TEST(CoreNumberText, KeepsThePointInEveryLocale)
{
  ExpectPoints();
  const CommaLocale commas;
  ExpectPoints();
}
