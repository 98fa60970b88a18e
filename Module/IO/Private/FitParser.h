// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The grammar of published fits as text (FitFile.h): names, calls of models, numbers, comments.
 */

#ifndef FitParser_h
#define FitParser_h

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace measuredbrdf
{
constexpr const char* FitFormatName = "published fits (text)";

/// Model(attribute = value, ..., Model(...), ...)
struct FitCall
{
  std::string Model;
  int Line = 0;
  std::map<std::string, std::vector<double>> Attributes;
  std::vector<FitCall> Terms;
};

/// Throw FileError: "PATH: FORMAT, line N: what".
[[noreturn]] void FailAtLine(const std::string& path, int line, const std::string& what);

/**
 * Recursive descent over the grammar. Every method steps over white space and comments first, and
 * throws FileError where the text is not what it reads.
 */
class FitParser
{
public:
  /// Both stay with the caller.
  FitParser(const std::string& path, std::string_view text)
    : Path(path)
    , Text(text)
  {
  }

  int GetLine() const { return this->Line; }

  /// The text of all comments so far.
  const std::string& GetComments() const { return this->Comments; }

  bool IsAtEnd();

  /// what: how an error calls it.
  std::string ReadName(const std::string& what);

  void Expect(char character);

  FitCall ReadCall(int depth = 0);

private:
  void SkipSpace();
  bool Accept(char character);
  double ReadNumber(const std::string& attribute);
  std::vector<double> ReadValue(const std::string& attribute);
  [[noreturn]] void Expected(const std::string& what);

  const std::string& Path;
  std::string_view Text;
  std::size_t Place = 0;
  int Line = 1;
  std::string Comments;
  std::size_t CommentsEnd = 0;
};
} // namespace measuredbrdf

#endif
