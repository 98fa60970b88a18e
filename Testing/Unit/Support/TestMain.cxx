// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// GoogleTest's main, in the locale of C that MEASUREDBRDF_TEST_LOCALE names, as a program of Qt's
// or GTK's is in its user's. Messages stay in English. C++'s locale, by which tests read and write
// files of their own, is CommaLocale's.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <iostream>

int main(int argc, char** argv)
{
  const char* const name = std::getenv("MEASUREDBRDF_TEST_LOCALE");
  if (name && *name)
  {
    if (!std::setlocale(LC_ALL, name))
    {
      std::cerr << "MEASUREDBRDF_TEST_LOCALE: there is no locale '" << name << "' here\n";
      return 1;
    }
#if !defined(_WIN32)
    std::setlocale(LC_MESSAGES, "C");
#endif
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
