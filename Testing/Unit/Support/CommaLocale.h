// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CommaLocale_h
#define CommaLocale_h

#include <clocale>
#include <locale>
#include <string>

// A program in which numbers have decimal commas and dots between thousands, while it lives: C++'s
// locale always, C's where the machine has such a one.
class CommaLocale
{
public:
  CommaLocale()
    : OldC(std::setlocale(LC_NUMERIC, nullptr))
    , Old(std::locale::global(std::locale(std::locale::classic(), new Punctuation)))
  {
    for (const char* name : { "de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8" })
    {
      this->SetsC = this->SetsC || std::setlocale(LC_NUMERIC, name) != nullptr;
    }
  }
  ~CommaLocale()
  {
    std::locale::global(this->Old);
    std::setlocale(LC_NUMERIC, this->OldC.c_str());
  }
  CommaLocale(const CommaLocale&) = delete;
  void operator=(const CommaLocale&) = delete;

  bool SetsC = false;

private:
  struct Punctuation : std::numpunct<char>
  {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };

  std::string OldC;
  std::locale Old;
};

#endif
