// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The fuzz targets without libFuzzer: all seeds, and fixed mutations of them for a few seconds, or
// for MEASUREDBRDF_FUZZ_SECONDS.

#include "FuzzSeeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

using Target = int(const std::uint8_t* data, std::size_t size);
Target FuzzAstm;
Target FuzzBsdfXml;
Target FuzzDirectionsCsv;
Target FuzzEnvironment;
Target FuzzExrHeader;
Target FuzzExrMaterial;
Target FuzzFit;
Target FuzzImage;
Target FuzzMaterialData;
Target FuzzMbsdf;
Target FuzzMerl;
Target FuzzOpenMaterial;
Target FuzzPhotographList;
Target FuzzTensor;
Target FuzzUtia;

namespace
{
// Per target.
std::chrono::seconds GetDuration()
{
  const char* seconds = std::getenv("MEASUREDBRDF_FUZZ_SECONDS");
  return std::chrono::seconds(seconds ? std::atoi(seconds) : 4);
}

struct Case
{
  const char* Name;
  Target* Run;
};

void PrintTo(const Case& tested, std::ostream* os) { *os << tested.Name; }

// Numbers that readers stumble over, little-endian.
const std::string Values[] = { std::string(1, '\0'), "\x7f", "\xff", std::string(4, '\0'),
  "\xff\xff\xff\xff", "\xff\xff\xff\x7f", std::string("\0\0\0\x80", 4),
  std::string("\0\x08\0\0", 4), std::string("\0\0\xc0\x7f", 4), std::string("\0\0\x80\x7f", 4),
  std::string("\0\0\0\0\0\0\xf0\x7f", 8), "\xff\xff\xff\xff\xff\xff\xff\xff",
  "\xff\xff\xff\xff\xff\xff\xff\x7f", "\n", "-1", "1e999", "nan", "," };

// The raw bits of mt19937 are the same everywhere; the library's distributions are not.
class Mutator
{
public:
  explicit Mutator(const std::vector<std::string>& seeds)
    : Seeds(seeds)
  {
  }

  std::string Next()
  {
    std::string bytes = this->Seeds[this->Draw(this->Seeds.size())];
    for (std::size_t changes = 1 + this->Draw(4); changes > 0; --changes)
    {
      this->Change(bytes);
    }
    return bytes;
  }

private:
  std::size_t Draw(std::size_t count) { return this->Random() % count; }

  void Change(std::string& bytes)
  {
    // Half of the places are near the beginning, where the headers are.
    const std::size_t range =
      this->Draw(2) == 0 ? std::min<std::size_t>(bytes.size(), 64) : bytes.size();
    const std::size_t at = this->Draw(range + 1);
    const std::size_t left = bytes.size() - at;
    const std::string& value = Values[this->Draw(std::size(Values))];
    switch (this->Draw(7))
    {
      case 0: // a bit
        if (left > 0)
        {
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << this->Draw(8)));
        }
        break;
      case 1: // a byte
        if (left > 0)
        {
          bytes[at] = static_cast<char>(this->Draw(256));
        }
        break;
      case 2:
        bytes.replace(at, std::min(value.size(), left), value);
        break;
      case 3:
        bytes.insert(at, value);
        break;
      case 4:
        bytes.erase(at, this->Draw(16));
        break;
      case 5:
        bytes.insert(at, bytes.substr(this->Draw(bytes.size() + 1), this->Draw(32)));
        break;
      default:
        if (this->Draw(4) == 0) // less often: little is left of the file
        {
          bytes.resize(at);
        }
    }
  }

  const std::vector<std::string>& Seeds;
  std::mt19937 Random{ 5489 };
};

class FuzzTargets : public testing::TestWithParam<Case>
{
};

void RunOn(const Case& tested, const std::string& bytes)
{
  EXPECT_EQ(tested.Run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
}
}

//------------------------------------------------------------------------------
TEST_P(FuzzTargets, TakeSeedsAndMutations)
{
  const Case& tested = GetParam();
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::string> seeds = fuzz::MakeSeeds(tested.Name);
  ASSERT_FALSE(seeds.empty());
  RunOn(tested, "");
  for (const std::string& seed : seeds)
  {
    RunOn(tested, seed);
  }
  Mutator mutator(seeds);
  int runs = 0;
  while (std::chrono::steady_clock::now() - start < GetDuration())
  {
    RunOn(tested, mutator.Next());
    ++runs;
  }
  std::printf("%s: %zu seeds, %d mutations\n", tested.Name, seeds.size(), runs);
}

INSTANTIATE_TEST_SUITE_P(All, FuzzTargets,
  testing::Values(
#ifdef MEASUREDBRDF_FUZZ_TOOL
    Case{ "DirectionsCsv", FuzzDirectionsCsv },
#endif
    Case{ "Environment", FuzzEnvironment }, Case{ "ExrHeader", FuzzExrHeader },
    Case{ "ExrMaterial", FuzzExrMaterial }, Case{ "Astm", FuzzAstm },
    Case{ "BsdfXml", FuzzBsdfXml }, Case{ "Fit", FuzzFit }, Case{ "Image", FuzzImage },
    Case{ "MaterialData", FuzzMaterialData }, Case{ "Mbsdf", FuzzMbsdf }, Case{ "Merl", FuzzMerl },
    Case{ "OpenMaterial", FuzzOpenMaterial }, Case{ "PhotographList", FuzzPhotographList },
    Case{ "Tensor", FuzzTensor }, Case{ "Utia", FuzzUtia }),
  [](const auto& info) { return std::string(info.param.Name); });
