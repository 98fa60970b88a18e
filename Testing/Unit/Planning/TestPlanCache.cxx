// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Plans that outlive the program: found again, made again where files are damaged, bounded in size,
// and among other people's files.

#include "PlanCache.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkDistributionBRDF.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceIntegrator.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/socket.h>
#if defined(__linux__)
#include <sys/inotify.h>
#endif
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace
{
class PlanCache : public ::testing::Test
{
protected:
  void SetUp() override
  {
    std::random_device random;
    this->Folder =
      (fs::temp_directory_path() / ("measuredbrdf-plans-" + std::to_string(random()))).string();
    this->BRDF->SetExponent(20.0);
    this->Environment->SetToProceduralSky();
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  vtkSmartPointer<vtkRadiancePlanner> Plan()
  {
    auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
    planner->SetBRDF(this->Other ? this->Other.Get() : this->BRDF.Get());
    if (this->GivenNormals)
    {
      EXPECT_TRUE(planner->SetPairs(this->GivenNormals, this->GivenViews));
    }
    planner->SetEnvironment(this->Environment);
    planner->SetErrorTolerance(this->Tolerance);
    planner->SetMaximumTextureBytes(this->TextureBytes);
    planner->SetViewDirection(this->View);
    planner->SetMaximumCacheBytes(this->MaximumBytes);
    planner->SetCacheFolder(this->Folder);
    EXPECT_TRUE(planner->Update());
    return planner;
  }

  fs::path GetOwnFolder() const { return fs::path(this->Folder) / "vtkMeasuredBRDF-plans"; }

  std::vector<fs::path> GetFiles() const
  {
    std::vector<fs::path> files;
    if (fs::exists(this->GetOwnFolder()))
    {
      for (const auto& entry : fs::directory_iterator(this->GetOwnFolder()))
      {
        files.push_back(entry.path());
      }
    }
    return files;
  }

  static std::vector<double> Integrate(vtkRadiancePlanner* planner)
  {
    auto integrator = vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
    vtkNew<vtkDoubleArray> normals, views, radiance;
    normals->SetNumberOfComponents(3);
    views->SetNumberOfComponents(3);
    normals->InsertNextTuple3(0.1, 0.9, 0.3);
    views->InsertNextTuple3(0.5, 0.5, 0.7);
    normals->InsertNextTuple3(-0.4, 0.2, 0.3);
    views->InsertNextTuple3(-0.5, -0.1, 0.7);
    EXPECT_TRUE(integrator->Integrate(normals, views, radiance));
    return std::vector<double>(
      radiance->GetPointer(0), radiance->GetPointer(0) + radiance->GetNumberOfValues());
  }

  // Whatever is there, as old as may be.
  static void MakeOld(const fs::path& path, int seconds = 1000000)
  {
    const struct timespec times[2] = { { std::time(nullptr) - seconds, 0 },
      { std::time(nullptr) - seconds, 0 } };
    EXPECT_EQ(utimensat(AT_FDCWD, path.c_str(), times, AT_SYMLINK_NOFOLLOW), 0) << path;
  }

  static void WriteText(const fs::path& path, const std::string& text)
  {
    std::ofstream(path, std::ios::binary) << text;
  }

  static std::string ReadText(const fs::path& path)
  {
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  vtkSmartPointer<vtkDoubleArray> GivenNormals;
  vtkSmartPointer<vtkDoubleArray> GivenViews;
  std::string Folder;
  double Tolerance = 0.05;
  double View[3] = { 0.0, 0.0, 1.0 };
  vtkIdType MaximumBytes = 512 << 20;
  vtkIdType TextureBytes = 96 << 20;
  vtkSmartPointer<vtkBRDF> Other; // instead of BRDF
  vtkNew<vtkBlinnPhongBRDF> BRDF;
  vtkNew<vtkEnvironment> Environment;
};
}

TEST_F(PlanCache, FindsAPlanAgain)
{
  const auto first = this->Plan();
  EXPECT_FALSE(first->GetFromCache());
  EXPECT_EQ(this->GetFiles().size(), 1u);
  const auto second = this->Plan();
  EXPECT_TRUE(second->GetFromCache());
  EXPECT_EQ(first->GetPlan(), second->GetPlan());
  ASSERT_EQ(first->GetNumberOfCandidates(), second->GetNumberOfCandidates());
  for (int k = 0; k < first->GetNumberOfCandidates(); ++k)
  {
    EXPECT_EQ(first->GetPredictedError(k), second->GetPredictedError(k));
    EXPECT_EQ(first->GetPredictedCost(k), second->GetPredictedCost(k));
  }
  EXPECT_EQ(Integrate(first), Integrate(second));
}

// Layers keep their table; lights and samples are made again.
TEST_F(PlanCache, FindsLayersAgain)
{
  this->BRDF->SetSpecular(0.5, 0.5, 0.5);
  this->BRDF->SetExponent(2000.0);
  this->Tolerance = 0.02;
  this->TextureBytes = 6 << 20; // no room for a table that does without lights
  this->Environment->SetToProceduralHall();
  const auto first = this->Plan();
  std::printf("%s\n", first->GetPlan().c_str());
  ASSERT_EQ(first->GetMethodName(first->GetChoice()), "hybrid");
  const auto second = this->Plan();
  EXPECT_TRUE(second->GetFromCache());
  EXPECT_EQ(first->GetPlan(), second->GetPlan());
  EXPECT_EQ(Integrate(first), Integrate(second));
  const fs::path file = this->GetFiles().at(0);
  EXPECT_GT(fs::file_size(file), 100000u);
}

TEST_F(PlanCache, WhatItDependsOnMakesAnother)
{
  this->Plan();
  this->Tolerance = 0.06;
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->BRDF->SetExponent(20.001);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  std::vector<float> pixels = this->Environment->GetPixels();
  pixels[100] += 1e-3f;
  this->Environment->SetPixels(
    this->Environment->GetWidth(), this->Environment->GetHeight(), pixels);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  EXPECT_EQ(this->GetFiles().size(), 4u);
  this->Environment->SetRotationY(40.0);
  EXPECT_FALSE(this->Plan()->GetFromCache()); // seen from one side
  const double view = this->View[2];
  this->View[2] = 0.0;
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->Environment->SetRotationY(50.0);
  EXPECT_TRUE(this->Plan()->GetFromCache()); // seen from everywhere
  this->View[2] = view;
  this->View[0] = 0.5;
  EXPECT_FALSE(this->Plan()->GetFromCache());
}

TEST_F(PlanCache, DamagedFilesAreMadeAgain)
{
  const auto good = this->Plan();
  const fs::path file = this->GetFiles().at(0);
  for (int damage = 0; damage < 5; ++damage)
  {
    const std::uintmax_t size = fs::file_size(file); // the text has times in it: they differ
    if (damage == 0)                                 // a byte in the middle
    {
      std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
      stream.seekp(static_cast<std::streamoff>(size / 2));
      stream.put('\x5a');
      stream.put('\xa5');
    }
    else if (damage == 1)
    {
      fs::resize_file(file, size - 1);
    }
    else if (damage == 2)
    {
      fs::resize_file(file, 0);
    }
    else if (damage == 3)
    {
      std::ofstream(file, std::ios::binary) << "something else altogether";
    }
    else
    {
      fs::remove(file);
      fs::create_directory(file); // in the way for good
    }
    const auto again = this->Plan();
    EXPECT_FALSE(again->GetFromCache()) << damage;
    EXPECT_EQ(again->GetChoice(), good->GetChoice());
    EXPECT_EQ(Integrate(again), Integrate(good));
  }
}

TEST_F(PlanCache, StaysWithinItsBounds)
{
  const auto plan = this->Plan();
  const std::uintmax_t size = fs::file_size(this->GetFiles().at(0));
  this->MaximumBytes = static_cast<vtkIdType>(size + size / 2);
  for (int k = 0; k < 3; ++k)
  {
    this->BRDF->SetExponent(21.0 + k);
    this->Plan();
    std::uintmax_t total = 0;
    for (const fs::path& file : this->GetFiles())
    {
      total += fs::file_size(file);
    }
    EXPECT_LE(total, static_cast<std::uintmax_t>(this->MaximumBytes));
  }
  this->MaximumBytes = 100;
  this->BRDF->SetExponent(30.0);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  EXPECT_FALSE(this->Plan()->GetFromCache());
}

#if defined(__linux__)
// Hundreds of programs may share a folder on a server.
TEST_F(PlanCache, OpensOnlyWhatGoes)
{
  const std::string digits = "0123456789abcdef";
  std::string key(32, '0');
  const auto write = [&](std::uint64_t most)
  {
    key.back() = digits[(digits.find(key.back()) + 1) % 16];
    measuredbrdf::WriteCache(this->Folder, key, std::string(1000, 'x'), most);
  };
  write(1 << 20);
  const std::string own = this->Folder + "/" + measuredbrdf::CacheSubfolder;
  const int watch = inotify_init1(IN_NONBLOCK);
  ASSERT_GE(inotify_add_watch(watch, own.c_str(), IN_OPEN), 0);
  const auto countOpened = [watch]()
  {
    int count = 0;
    alignas(inotify_event) char buffer[8192];
    for (ssize_t size = 0; (size = read(watch, buffer, sizeof(buffer))) > 0;)
    {
      for (char* at = buffer; at < buffer + size;)
      {
        const auto* event = reinterpret_cast<const inotify_event*>(at);
        count += event->len > 0 ? 1 : 0; // not the folder itself
        at += sizeof(inotify_event) + event->len;
      }
    }
    return count;
  };
  for (int k = 0; k < 8; ++k)
  {
    write(1 << 20);
  }
  EXPECT_EQ(countOpened(), 8); // each write its own file
  EXPECT_EQ(this->GetFiles().size(), 9u);
  write(9 * 1100); // one has to go
  EXPECT_EQ(countOpened(), 2);
  EXPECT_EQ(this->GetFiles().size(), 9u);
  close(watch);
}
#endif

TEST_F(PlanCache, UnwritableFoldersAreNoCache)
{
  this->Folder = "/proc/no such place/for plans";
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->Folder = "";
  EXPECT_FALSE(this->Plan()->GetFromCache());
}

TEST_F(PlanCache, DefaultFolderFollowsTheEnvironment)
{
  setenv("MEASUREDBRDF_CACHE", "off", 1);
  EXPECT_EQ(vtkRadiancePlanner::GetDefaultCacheFolder(), "");
  setenv("MEASUREDBRDF_CACHE", "/some/where", 1);
  EXPECT_EQ(vtkRadiancePlanner::GetDefaultCacheFolder(), "/some/where");
  unsetenv("MEASUREDBRDF_CACHE");
  setenv("XDG_CACHE_HOME", "/x", 1);
  EXPECT_EQ(vtkRadiancePlanner::GetDefaultCacheFolder(), "/x/vtkMeasuredBRDF");
  // "All paths set in these environment variables must be absolute", else to be ignored.
  setenv("HOME", "/home/somebody", 1);
  for (const char* relative : { "x", "./x", "../x", "" })
  {
    setenv("XDG_CACHE_HOME", relative, 1);
    EXPECT_EQ(vtkRadiancePlanner::GetDefaultCacheFolder(), "/home/somebody/.cache/vtkMeasuredBRDF");
  }
}

namespace
{
const std::string Magic = "vtkMeasuredBRDF plan 1\n";
const std::string Key = "0123456789abcdef0123456789abcdef";
}

// A folder that the user keeps other things in, ours full to the brim: only our own files go.
TEST_F(PlanCache, KeepsWhatIsNotOurs)
{
  this->Plan();
  const fs::path plan = this->GetFiles().at(0);
  const std::uintmax_t size = fs::file_size(plan);
  const fs::path own = this->GetOwnFolder();
  const fs::path user(this->Folder);
  const std::vector<fs::path> files = { user / "thesis.tex", user / "data.vti", user / Key,
    user / (Key + ".1.part"), own / "thesis.tex", own / Key, own / (Key + ".12.part"),
    own / "0123456789abcdef0123456789abcdeF", own / (Key + "0"), own / (Key + ".x.part") };
  for (const fs::path& file : files)
  {
    // Names that only look like ours bear the magic; the name of one of ours does not.
    const bool ours = file == own / Key || file == own / (Key + ".12.part");
    WriteText(file, (ours ? "" : Magic) + "years of work");
    MakeOld(file);
  }
  const std::string reversed(Key.rbegin(), Key.rend());
  fs::create_symlink(user / Key, own / reversed); // to a file with our magic and name
  MakeOld(own / reversed);
  const std::string other = "f" + Key.substr(1);
  ASSERT_EQ(mkfifo((own / other).c_str(), 0600), 0);
  MakeOld(own / other);
  fs::create_directory(own / ("e" + Key.substr(1)));

  this->MaximumBytes = static_cast<vtkIdType>(size + size / 2);
  this->BRDF->SetExponent(21.0);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  EXPECT_TRUE(this->Plan()->GetFromCache()); // the cache is at work
  EXPECT_FALSE(fs::exists(plan));            // ours was too old
  for (const fs::path& file : files)
  {
    EXPECT_NE(ReadText(file).find("years of work"), std::string::npos) << file;
  }
  EXPECT_TRUE(fs::is_symlink(own / reversed));
  EXPECT_TRUE(fs::is_fifo(own / other));
  EXPECT_TRUE(fs::is_directory(own / ("e" + Key.substr(1))));
}

// Files that are whole by their checksum, and whose text ends too early: the plan is made again.
TEST_F(PlanCache, ContentsThatEndEarlyOrLieAreNoPlan)
{
  const auto made = this->Plan();
  const auto files = this->GetFiles();
  ASSERT_EQ(files.size(), 1u);
  const std::string key = files[0].filename().string();
  std::string genuine;
  ASSERT_TRUE(measuredbrdf::ReadCache(this->Folder, key, genuine));
  std::vector<std::string> contents = { "", "1" };
  // The number of candidates, the choice; one line each; the reason; then what is prepared.
  const int count = made->GetNumberOfCandidates();
  std::size_t place = 0;
  for (int line = 0; line < count + 2; ++line)
  {
    place = genuine.find('\n', place) + 1;
    contents.push_back(genuine.substr(0, place - 1));
    contents.push_back(genuine.substr(0, place));
  }
  const std::string head = std::to_string(count) + " " + std::to_string(made->GetChoice()) + " ";
  ASSERT_EQ(genuine.substr(0, head.size()), head);
  for (const int choice : { -1, count, count + 1 })
  {
    contents.push_back(
      std::to_string(count) + " " + std::to_string(choice) + " " + genuine.substr(head.size()));
  }
  // The chosen one's sizes, a number of them and then each.
  place = 0;
  for (int line = 0; line <= made->GetChoice(); ++line)
  {
    place = genuine.find('\n', place) + 1;
  }
  place = genuine.find(' ', genuine.find(' ', place) + 1) + 1;
  for (const char* size : { "0", "-5", "100000000" })
  {
    contents.push_back(genuine.substr(0, place) + size + genuine.substr(genuine.find(' ', place)));
  }
  for (const std::string& content : contents)
  {
    SCOPED_TRACE("'" + content.substr(0, 200) + "'");
    measuredbrdf::WriteCache(this->Folder, key, content, 1 << 20);
    const auto again = this->Plan();
    EXPECT_FALSE(again->GetFromCache());
    EXPECT_EQ(again->GetDescription(again->GetChoice()), made->GetDescription(made->GetChoice()));
  }
  measuredbrdf::WriteCache(this->Folder, key, genuine, 1 << 20);
  EXPECT_TRUE(this->Plan()->GetFromCache());
}

// What lies under a plan's own key: nothing hangs, and nothing is harmed.
TEST_F(PlanCache, AnythingMayLieUnderAKey)
{
  const fs::path file = this->GetOwnFolder() / Key;
  const fs::path target = fs::path(this->Folder) / "target";
  std::string read;
  measuredbrdf::WriteCache(this->Folder, Key, "a plan", 1000);
  ASSERT_TRUE(measuredbrdf::ReadCache(this->Folder, Key, read));
  const std::string genuine = ReadText(file);
  for (int kind = 0; kind < 6; ++kind)
  {
    fs::remove_all(file);
    if (kind == 0)
    {
      ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    }
    else if (kind == 1)
    {
      sockaddr_un address = {};
      address.sun_family = AF_UNIX;
      ASSERT_LT(file.string().size(), sizeof(address.sun_path));
      std::strcpy(address.sun_path, file.c_str());
      const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
      ASSERT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
      close(socket);
    }
    else if (kind == 2)
    {
      fs::create_directory(file);
      WriteText(file / "inside", "years of work");
    }
    else if (kind == 3)
    {
      WriteText(target, genuine); // a link is not followed, whatever it leads to
      fs::create_symlink(target, file);
    }
    else if (kind == 4)
    {
      fs::create_symlink("/dev/zero", file);
    }
    else
    {
      WriteText(file, "years of work");
    }
    const fs::file_type before = fs::symlink_status(file).type();
    EXPECT_FALSE(measuredbrdf::ReadCache(this->Folder, Key, read)) << kind;
    measuredbrdf::WriteCache(this->Folder, Key, "another plan", 1000);
    EXPECT_FALSE(measuredbrdf::ReadCache(this->Folder, Key, read)) << kind;
    EXPECT_EQ(read, "a plan");
    EXPECT_EQ(fs::symlink_status(file).type(), before) << kind;
    EXPECT_EQ(this->GetFiles().size(), 1u) << kind; // no .part is left
  }
  EXPECT_EQ(ReadText(file), "years of work");
  EXPECT_EQ(ReadText(target), genuine);
}

TEST_F(PlanCache, FolderIsForThisUserOnly)
{
  const std::string folder = this->Folder + "/deeper/still";
  const fs::path own = fs::path(folder) / "vtkMeasuredBRDF-plans";
  std::string read;
  const mode_t mask = umask(0);
  measuredbrdf::WriteCache(folder, Key, "a plan", 1000);
  umask(mask);
  EXPECT_TRUE(measuredbrdf::ReadCache(folder, Key, read));
  EXPECT_EQ(fs::status(own).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(this->Folder).permissions(), fs::perms::owner_all); // ours, too: made here
  EXPECT_EQ(fs::status(own / Key).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  // Where others may write, anybody may have written.
  fs::permissions(own, fs::perms::all);
  EXPECT_FALSE(measuredbrdf::ReadCache(folder, Key, read));
  fs::permissions(own, fs::perms::owner_all);
  EXPECT_TRUE(measuredbrdf::ReadCache(folder, Key, read));
  // Nor is a link to a folder our folder.
  fs::rename(own, folder + "/elsewhere");
  fs::create_directory_symlink(folder + "/elsewhere", own);
  EXPECT_FALSE(measuredbrdf::ReadCache(folder, Key, read));
}

TEST_F(PlanCache, HalfWrittenFilesOfTheDeadGo)
{
  measuredbrdf::WriteCache(this->Folder, Key, "a plan", 1000);
  const fs::path own = this->GetOwnFolder();
  const fs::path stale = own / (Key + ".123.part");
  const fs::path fresh = own / (Key + ".456.part");
  const fs::path alien = own / (Key + ".789.part");
  WriteText(stale, Magic + "half a pl");
  WriteText(fresh, Magic + "half a pl");
  WriteText(alien, "half a novel");
  MakeOld(stale, 7200);
  MakeOld(fresh, 60);
  MakeOld(alien);
  measuredbrdf::WriteCache(this->Folder, "f" + Key.substr(1), "a plan", 1000);
  EXPECT_FALSE(fs::exists(stale));
  EXPECT_TRUE(fs::exists(fresh)); // its program may be alive
  EXPECT_TRUE(fs::exists(alien));
}

// What is in use stays.
TEST_F(PlanCache, WhatWasUsedLongestAgoGoesFirst)
{
  const auto key = [](char c) { return std::string(1, c) + Key.substr(1); };
  for (const char c : { 'a', 'b', 'c' })
  {
    measuredbrdf::WriteCache(this->Folder, key(c), std::string(100, c), 1000);
    MakeOld(this->GetOwnFolder() / key(c), 1000 - c);
  }
  std::string read;
  EXPECT_TRUE(measuredbrdf::ReadCache(this->Folder, key('a'), read)); // the oldest one
  measuredbrdf::WriteCache(this->Folder, key('d'), std::string(100, 'd'), 500);
  EXPECT_TRUE(measuredbrdf::ReadCache(this->Folder, key('a'), read));
  EXPECT_FALSE(measuredbrdf::ReadCache(this->Folder, key('b'), read));
  EXPECT_TRUE(measuredbrdf::ReadCache(this->Folder, key('c'), read));
  EXPECT_TRUE(measuredbrdf::ReadCache(this->Folder, key('d'), read));
}

// Plans in view hold for one rotation of the environment.
TEST_F(PlanCache, PairsHoldForOneRotation)
{
  this->GivenNormals = vtkSmartPointer<vtkDoubleArray>::New();
  this->GivenViews = vtkSmartPointer<vtkDoubleArray>::New();
  this->GivenNormals->SetNumberOfComponents(3);
  this->GivenViews->SetNumberOfComponents(3);
  for (int k = 0; k < 32; ++k)
  {
    const double angle = 0.02 * k;
    this->GivenNormals->InsertNextTuple3(std::sin(angle), 0.0, std::cos(angle));
    this->GivenViews->InsertNextTuple3(0.0, 0.0, 1.0);
  }
  EXPECT_FALSE(this->Plan()->GetFromCache());
  EXPECT_TRUE(this->Plan()->GetFromCache());
  this->Environment->SetRotationY(40.0);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->Environment->SetRotationY(0.0);
  EXPECT_TRUE(this->Plan()->GetFromCache());
}

namespace
{
vtkSmartPointer<vtkTabulatedBRDF> MakeTable(const std::vector<float>& rgb)
{
  const int dimensions[3] = { 16, 64, 64 };
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  EXPECT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, dimensions, rgb));
  return table;
}
const std::size_t TableSize = 3 * 16 * 64 * 64;

// Of nobody's knowledge: what it adds to its superclass stays unknown.
class SecretBRDF : public vtkLambertBRDF
{
public:
  static SecretBRDF* New();
  vtkTypeMacro(SecretBRDF, vtkLambertBRDF);
  double Secret = 1.0;

protected:
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override
  {
    this->Superclass::EvaluateAbove(i, o, f);
    f[0] *= this->Secret;
  }
};
vtkStandardNewMacro(SecretBRDF);

// One without even a name of its own.
class NamelessBRDF : public vtkLambertBRDF
{
public:
  static NamelessBRDF* New() { VTK_STANDARD_NEW_BODY(NamelessBRDF); }
};

class OpenBRDF : public SecretBRDF
{
public:
  static OpenBRDF* New();
  vtkTypeMacro(OpenBRDF, SecretBRDF);

protected:
  std::pair<std::type_index, std::string> GetContent() override
  {
    return { typeid(OpenBRDF), std::to_string(this->Secret) };
  }
};
vtkStandardNewMacro(OpenBRDF);
}

// A cell that no pair of directions above the horizon reads: sampled values would be the same.
TEST_F(PlanCache, TablesThatDifferInOneCellGetTwoPlans)
{
  std::vector<float> rgb(TableSize, 0.25f);
  this->Other = MakeTable(rgb);
  EXPECT_FALSE(this->Plan()->GetFromCache());
  this->Other = MakeTable(rgb);
  EXPECT_TRUE(this->Plan()->GetFromCache());
  rgb.back() = 0.3f;
  this->Other = MakeTable(rgb);
  EXPECT_FALSE(this->Plan()->GetFromCache());
}

TEST_F(PlanCache, MaterialsThatDoNotSayWhatTheyAreAreNotKept)
{
  this->Other = vtkSmartPointer<SecretBRDF>::New();
  EXPECT_EQ(this->Other->GetContentKey(), "");
  EXPECT_EQ(vtkSmartPointer<NamelessBRDF>::New()->GetContentKey(), "");
  EXPECT_FALSE(this->Plan()->GetFromCache());
  EXPECT_FALSE(this->Plan()->GetFromCache());
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(this->BRDF);
  EXPECT_NE(sum->GetContentKey(), "");
  sum->AddTerm(this->Other);
  EXPECT_EQ(sum->GetContentKey(), "");
  EXPECT_TRUE(this->GetFiles().empty());

  const auto open = vtkSmartPointer<OpenBRDF>::New();
  const std::string key = open->GetContentKey();
  EXPECT_EQ(key.size(), 32u);
  open->Secret = 2.0;
  EXPECT_NE(open->GetContentKey(), key);
}

// Every parameter and every value counts; names and where the material is from do not.
TEST(ContentKey, EverythingThatCountsChangesIt)
{
  std::vector<std::string> keys;
  const auto add = [&keys](vtkBRDF* brdf)
  {
    const std::string key = brdf->GetContentKey();
    EXPECT_EQ(key.size(), 32u);
    EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 0) << brdf->GetClassName();
    keys.push_back(key);
    const auto copy = vtkSmartPointer<vtkBRDF>::Take(brdf->NewSnapshot());
    ASSERT_TRUE(copy);
    copy->SetName("another");
    copy->SetSource("elsewhere");
    EXPECT_EQ(copy->GetContentKey(), key) << brdf->GetClassName();
    copy->SetResamplingTolerance(0.125);
    EXPECT_NE(copy->GetContentKey(), key) << brdf->GetClassName();
  };
  vtkNew<vtkLambertBRDF> lambert;
  add(lambert);
  lambert->SetAlbedo(0.8, 0.8, 0.8000001);
  add(lambert);
  vtkNew<vtkBlinnPhongBRDF> phong;
  add(phong);
  phong->SetSpecular(0.1, 0.2, 0.1);
  add(phong);
  phong->SetExponent(51.0);
  add(phong);
  vtkNew<vtkAshikhminShirleyBRDF> lobe;
  add(lobe);
  lobe->SetSpecularScale(1.0, 1.0, 0.5);
  add(lobe);
  lobe->SetReflectance(0.04, 0.05, 0.04);
  add(lobe);
  lobe->SetDiffuse(0.0, 0.0, 0.1);
  add(lobe);
  lobe->SetExponentU(101.0);
  add(lobe);
  lobe->SetExponentV(102.0);
  add(lobe);
  lobe->SetFresnelModelToDielectric();
  add(lobe);
  lobe->SetIndexOfRefraction(1.6);
  add(lobe);
  vtkNew<vtkDistributionBRDF> distribution;
  add(distribution);
  ASSERT_TRUE(distribution->SetDistribution(1, 2, { 1.0f, 1.0f, 1.0f, 2.0f, 2.0f, 2.0f }));
  add(distribution);
  ASSERT_TRUE(distribution->SetDistribution(2, 1, { 1.0f, 1.0f, 1.0f, 2.0f, 2.0f, 2.0f }));
  add(distribution);
  ASSERT_TRUE(distribution->SetFresnel(1, { 1.0f, 1.0f, 0.5f }));
  add(distribution);
  std::vector<float> rgb(3 * 2 * 3 * 4, 0.5f);
  const int dimensions[3] = { 2, 3, 4 }, turned[3] = { 4, 3, 2 };
  vtkNew<vtkTabulatedBRDF> table;
  add(table);
  for (const int parameterization : { 0, 1 })
  {
    for (const int range : { 0, 1 })
    {
      ASSERT_TRUE(table->SetVolume(parameterization, range, dimensions, rgb));
      add(table);
    }
  }
  ASSERT_TRUE(table->SetVolume(0, 0, turned, rgb));
  add(table);
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    std::vector<float> other = rgb;
    other[k] = std::nextafter(other[k], 1.0f);
    ASSERT_TRUE(table->SetVolume(0, 0, dimensions, other));
    add(table);
  }
  table->SetCosineWeighted(true);
  add(table);
  table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
  add(table);
  table->SetResamplingError(0.1);
  add(table);
  vtkNew<vtkBasisBRDF> basis;
  const double zone[2] = { 9.0, 57.0 }, wide[2] = { 9.0, 60.0 };
  const auto set = [&](int type, int order, const double in[2], const double out[2], float last)
  {
    std::vector<float> values(3u * 4u * static_cast<std::size_t>(order * order + 2 * order + 1));
    values.back() = last;
    ASSERT_EQ(basis->SetCoefficients(type, order, in, out, 4, 1, values), "");
    add(basis);
  };
  set(vtkBasisBRDF::ZONAL, 1, zone, zone, 0.0f);
  set(vtkBasisBRDF::ZONAL, 1, zone, zone, 1.0f);
  set(vtkBasisBRDF::ZONAL, 1, wide, zone, 1.0f);
  set(vtkBasisBRDF::ZONAL, 1, zone, wide, 1.0f);
  set(vtkBasisBRDF::LEGENDRE_FOURIER, 1, zone, zone, 1.0f);
  set(vtkBasisBRDF::ZONAL, 2, zone, zone, 1.0f);
  basis->SetIncidentCosine(true);
  add(basis);
  basis->SetOutgoingCosine(true);
  add(basis);
  basis->SetResamplingError(0.5);
  add(basis);
  vtkAdaptiveWarpBRDF::Tables tables;
  tables.ThetaI = { 0.0f, 1.4f };
  tables.PhiI = { 0.0f };
  tables.Ndf = { { 2, 2 }, std::vector<float>(4, 1.0f) };
  tables.Sigma = tables.Ndf;
  tables.Vndf = { { 1, 2, 2, 2 }, std::vector<float>(8, 1.0f) };
  tables.Luminance = tables.Vndf;
  tables.Rgb = { { 1, 2, 3, 2, 2 }, std::vector<float>(24, 1.0f) };
  vtkNew<vtkAdaptiveWarpBRDF> warp;
  const auto addTables = [&]()
  {
    ASSERT_EQ(warp->SetTables(tables), "");
    add(warp);
  };
  addTables();
  tables.ThetaI[1] = 1.5f;
  addTables();
  tables.PhiI[0] = 0.1f;
  addTables();
  for (std::vector<float>* values : { &tables.Ndf.Values, &tables.Sigma.Values, &tables.Vndf.Values,
         &tables.Luminance.Values, &tables.Rgb.Values })
  {
    values->back() = 0.75f;
    addTables();
  }
  tables.Jacobian = false;
  addTables();
  vtkNew<vtkSumBRDF> sum;
  add(sum);
  sum->AddTerm(lambert);
  add(sum);
  sum->AddTerm(phong);
  add(sum);
  sum->RemoveAllTerms();
  sum->AddTerm(phong);
  sum->AddTerm(lambert);
  add(sum); // in another order: another form for the GPU
  std::printf("%zu keys\n", keys.size());
}
