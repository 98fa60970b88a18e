// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What IO's tests share: a temporary folder, bytes, refusals.
 */

#ifndef TestIOHelpers_h
#define TestIOHelpers_h

#include "SharedData.h"
#include "SmallFiles.h"
#include "TestFolder.h"

#include "vtkAdaptiveWarpBRDF.h"
#include "vtkBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBRDFWriter.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace testio
{
using Folder = ::TestFolder;

/// Returns the path.
inline std::string WriteBytes(const std::string& path, const std::string& bytes)
{
  // A new file each time: some file systems flush one that is truncated and written again.
  std::error_code error;
  std::filesystem::remove(path, error);
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
  return path;
}

/// The text with the first `old` in it replaced, which must be there.
inline std::string Replace(std::string text, const std::string& old, const std::string& with)
{
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), with);
}

inline std::string ReadBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

template <typename T>
void Overwrite(std::string& bytes, std::size_t offset, T value)
{
  ASSERT_LE(offset + sizeof(T), bytes.size());
  std::memcpy(&bytes[offset], &value, sizeof(T));
}

/// Counts an object's error events and keeps them off the terminal.
class ErrorCounter : public vtkCommand
{
public:
  static ErrorCounter* New() { return new ErrorCounter; }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Count; }
  int Count = 0;
};

/// Fixed random pairs of directions above the horizon.
inline void ForPairs(
  int count, const std::function<void(const double i[3], const double o[3])>& use)
{
  std::mt19937 random(5489);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto draw = [&](double d[3])
  {
    d[2] = 0.02 + 0.98 * uniform(random);
    const double s = std::sqrt(1.0 - d[2] * d[2]);
    const double phi = 6.283185307179586 * uniform(random);
    d[0] = s * std::cos(phi);
    d[1] = s * std::sin(phi);
  };
  for (int k = 0; k < count; ++k)
  {
    double i[3];
    double o[3];
    draw(i);
    draw(o);
    use(i, o);
  }
}

inline void ExpectSameValues(vtkBRDF* a, vtkBRDF* b)
{
  ASSERT_TRUE(a && b);
  a->Prepare();
  b->Prepare();
  double sum = 0.0;
  ForPairs(300,
    [&](const double i[3], const double o[3])
    {
      double fa[3];
      double fb[3];
      a->Evaluate(i, o, fa);
      b->Evaluate(i, o, fb);
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_EQ(fa[k], fb[k]);
        sum += fa[k];
      }
    });
  EXPECT_GT(sum, 0.0);
}

/// The most memory this process has held, in bytes; 0 where it cannot be told.
inline double GetPeakMemory()
{
#if defined(__linux__)
  rusage usage;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * double(usage.ru_maxrss) : 0.0;
#else
  return 0.0;
#endif
}

/// The reader of a file that is read without error.
inline vtkSmartPointer<vtkBRDFReader> ReadFile(const std::string& path)
{
  auto reader = vtkSmartPointer<vtkBRDFReader>::New();
  reader->SetFileName(path);
  EXPECT_TRUE(reader->Read()) << reader->GetErrorMessage();
  EXPECT_EQ(reader->GetErrorMessage(), "");
  return reader;
}

inline vtkSmartPointer<vtkBRDF> Read(const std::string& path) { return ReadFile(path)->GetBRDF(); }

/// Whether the reader's notes hold the words.
inline void ExpectNote(vtkBRDFReader* reader, const std::string& words, bool holds = true)
{
  EXPECT_EQ(reader->GetNotes().find(words) != std::string::npos, holds)
    << words << " in: " << reader->GetNotes();
}

inline void Write(vtkBRDF* brdf, const std::string& path)
{
  vtkNew<vtkBRDFWriter> writer;
  writer->SetBRDF(brdf);
  writer->SetFileName(path);
  EXPECT_TRUE(writer->Write()) << writer->GetErrorMessage();
}

/**
 * The file is refused: one error event, whose message holds the path and all words; the material
 * that was read before stays.
 */
inline void ExpectRefused(
  const Folder& folder, const std::string& path, const std::vector<std::string>& words)
{
  const std::string good = folder("good.fit");
  WriteBytes(good, SmallFit);
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(good);
  ASSERT_TRUE(reader->Read());
  vtkBRDF* before = reader->GetBRDF();

  vtkNew<ErrorCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetFileName(path);
  EXPECT_FALSE(reader->Read());
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(reader->GetBRDF(), before);
  const std::string message = reader->GetErrorMessage();
  EXPECT_NE(message.find(path.substr(0, path.rfind('#'))), std::string::npos) << message;
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' in: " << message;
  }
}

/// A file's bytes, and words of the message that refuses them.
using Refusals = std::vector<std::pair<std::string, std::vector<std::string>>>;

inline void ExpectBytesRefused(
  const Folder& folder, const std::string& bytes, const std::vector<std::string>& words)
{
  const std::string path = folder("bad.file");
  WriteBytes(path, bytes);
  ExpectRefused(folder, path, words);
}

/// All of them are refused, with the format named.
inline void ExpectAllRefused(
  const Folder& folder, const std::string& format, const Refusals& refusals)
{
  for (const auto& [bytes, words] : refusals)
  {
    std::vector<std::string> all = words;
    all.push_back(format);
    SCOPED_TRACE(words.empty() ? format : words.back());
    ExpectBytesRefused(folder, bytes, all);
  }
}

/// Rows of numbers with commas between, but for comments and the line of names.
inline std::vector<std::vector<double>> ReadCsv(const std::string& path)
{
  std::vector<std::vector<double>> rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    std::vector<double> row{ std::istream_iterator<double>(numbers), {} };
    if (!row.empty())
    {
      rows.push_back(row);
    }
  }
  return rows;
}

/// Every shorter beginning of the bytes (every `step`-th length) is refused with `format` named.
inline void ExpectTruncationsRefused(const Folder& folder, const std::string& bytes,
  std::size_t from, std::size_t step, const std::string& format)
{
  for (std::size_t length = from; length < bytes.size(); length += step)
  {
    SCOPED_TRACE("cut to " + std::to_string(length) + " of " + std::to_string(bytes.size()));
    ExpectBytesRefused(folder, bytes.substr(0, length), { format });
    if (testing::Test::HasFailure())
    {
      return;
    }
  }
}
} // namespace testio

#endif
