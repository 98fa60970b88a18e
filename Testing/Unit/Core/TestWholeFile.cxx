// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TestFolder.h"
#include "WholeFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#if !defined(_WIN32)
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

using namespace measuredbrdf;
namespace fs = std::filesystem;

namespace
{
std::string ReadBack(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

std::string GetFailure(const std::string& path)
{
  try
  {
    WriteWholeFile(path, "new");
  }
  catch (const std::runtime_error& e)
  {
    return e.what();
  }
  return "";
}

std::size_t CountFiles(const std::string& folder)
{
  return static_cast<std::size_t>(
    std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}
}

//------------------------------------------------------------------------------
TEST(WholeFile, IsNewOrReplacesTheOldOne)
{
  const TestFolder folder;
  const std::string bytes(3000000, 'x');
  WriteWholeFile(folder("a"), bytes);
  EXPECT_EQ(ReadBack(folder("a")), bytes);
  fs::permissions(folder("a"), fs::perms(0640));
  WriteWholeFile(folder("a"), "");
  EXPECT_EQ(ReadBack(folder("a")), "");
#if !defined(_WIN32)
  EXPECT_EQ(fs::status(folder("a")).permissions(), fs::perms(0640));
#endif
  const std::string longest(240, 'n');
  WriteWholeFile(folder(longest), "long");
  EXPECT_EQ(ReadBack(folder(longest)), "long");
  EXPECT_EQ(CountFiles(folder("")), 2u); // nothing else
}

//------------------------------------------------------------------------------
TEST(WholeFile, RefusesWhatCannotBeWritten)
{
  const TestFolder folder;
  EXPECT_NE(GetFailure(folder("none/a")).find("there is no folder"), std::string::npos);
  EXPECT_NE(GetFailure(folder("")).find("directory"), std::string::npos);
  EXPECT_NE(GetFailure(folder(std::string(300, 'n'))).find("too long"), std::string::npos);
  EXPECT_THROW(CheckWritePlace(folder("none/a")), std::runtime_error);
  EXPECT_NO_THROW(CheckWritePlace(folder("a")));
  EXPECT_EQ(CountFiles(folder("")), 0u);
}

#if !defined(_WIN32)
//------------------------------------------------------------------------------
TEST(WholeFile, KeepsLinksAndWritesWhatTheyName)
{
  const TestFolder folder;
  fs::create_directory(folder("other"));
  std::ofstream(folder("other/target")) << "old";
  fs::create_symlink("other/target", folder("link"));
  fs::create_symlink(folder("link"), folder("link-to-link"));
  fs::create_symlink("other/not-yet", folder("dangling"));
  WriteWholeFile(folder("link-to-link"), "new");
  WriteWholeFile(folder("dangling"), "made");
  EXPECT_TRUE(fs::is_symlink(folder("link")));
  EXPECT_TRUE(fs::is_symlink(folder("link-to-link")));
  EXPECT_TRUE(fs::is_symlink(folder("dangling")));
  EXPECT_EQ(ReadBack(folder("other/target")), "new");
  EXPECT_EQ(ReadBack(folder("other/not-yet")), "made");
  EXPECT_EQ(CountFiles(folder("other")), 2u);

  fs::create_symlink("b", folder("a"));
  fs::create_symlink("a", folder("b"));
  EXPECT_NE(GetFailure(folder("a")), "");
}

//------------------------------------------------------------------------------
TEST(WholeFile, WritesIntoPipesAndDevices)
{
  const TestFolder folder;
  const std::string pipe = folder("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  WriteWholeFile(pipe, "through");
  char text[8] = {};
  EXPECT_EQ(read(reader, text, 7), 7);
  EXPECT_STREQ(text, "through");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(GetFailure("/dev/null"), "");
  if (fs::exists("/dev/full"))
  {
    EXPECT_NE(GetFailure("/dev/full").find("No space left"), std::string::npos);
  }
}

//------------------------------------------------------------------------------
TEST(WholeFile, NeedsNoFolderThatCanBeRead)
{
  const TestFolder folder;
  fs::permissions(folder(""), fs::perms(0333));
  const bool isRoot = geteuid() == 0; // whom permissions do not bind
  ASSERT_TRUE(!isRoot || seteuid(65534) == 0);
  const std::string failure = GetFailure(folder("a"));
  ASSERT_TRUE(!isRoot || seteuid(0) == 0);
  fs::permissions(folder(""), fs::perms(0700));
  EXPECT_EQ(failure, "");
  EXPECT_EQ(ReadBack(folder("a")), "new");
}
#endif
