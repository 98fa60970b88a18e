// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanCache.h"

#include "EnvironmentParts.h"
#include "LowDiscrepancy.h"
#include "vtkBRDF.h"
#include "vtkEnvironment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace measuredbrdf
{
namespace
{
constexpr char Magic[] = "vtkMeasuredBRDF plan 1\n"; // the number rises with the format
constexpr std::uint64_t LargestFile = 1ull << 30;
constexpr int Fingerprint = 16384;

// Multiply, then mix high bits down (as in MurmurHash3's finalizer).
std::uint64_t Mix(std::uint64_t x)
{
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdu;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53u;
  return x ^ (x >> 33);
}

std::string GetChecksum(const std::string& contents)
{
  ContentHash hash;
  hash.Add(contents.data(), contents.size());
  return hash.GetText();
}
}

void ContentHash::Add(const void* data, std::size_t bytes)
{
  const char* at = static_cast<const char*>(data);
  this->State[0] = Mix(this->State[0] ^ bytes);
  for (std::size_t k = 0; k < bytes; k += 8)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, at + k, std::min<std::size_t>(8, bytes - k));
    this->State[0] = Mix(this->State[0] ^ word) + 0x52dce729u;
    this->State[1] = (this->State[1] ^ word) * 0x100000001b3u + (this->State[1] >> 29);
  }
}

std::string ContentHash::GetText() const
{
  char text[40];
  std::snprintf(text, sizeof(text), "%016llx%016llx",
    static_cast<unsigned long long>(Mix(this->State[0])),
    static_cast<unsigned long long>(Mix(this->State[1])));
  return text;
}

void AddContent(ContentHash& hash, vtkBRDF* brdf)
{
  const auto direction = [](unsigned int k, unsigned int a, unsigned int b, double d[3])
  {
    // Uniform in cosine: half of it towards grazing.
    d[2] = 1.0 - 0.999 * RadicalInverse(k, a);
    const double s = std::sqrt(1.0 - d[2] * d[2]);
    const double phi = 6.283185307179586 * RadicalInverse(k, b);
    d[0] = s * std::cos(phi);
    d[1] = s * std::sin(phi);
  };
  std::vector<double> values;
  for (unsigned int k = 1; k <= Fingerprint; ++k)
  {
    double i[3], o[3], f[3];
    direction(k, 2, 3, i);
    direction(k, 5, 7, o);
    if (k % 4 == 0) // about the mirror direction
    {
      i[0] = 0.05 * i[0] - o[0];
      i[1] = 0.05 * i[1] - o[1];
      i[2] = o[2];
    }
    brdf->Evaluate(i, o, f);
    values.insert(values.end(), f, f + 3);
  }
  hash.Add(values.data(), values.size() * sizeof(double));
}

void AddContent(ContentHash& hash, vtkEnvironment* environment)
{
  const std::string key = environment->GetParts().GetContentKey(
    [environment]()
    {
      ContentHash pixels;
      pixels.AddValue(environment->GetWidth());
      pixels.AddValue(environment->GetHeight());
      pixels.Add(environment->GetPixels().data(), environment->GetPixels().size() * sizeof(float));
      return pixels.GetText();
    });
  hash.Add(key.data(), key.size());
}

std::string GetDefaultCacheFolder()
{
  const char* own = std::getenv("MEASUREDBRDF_CACHE");
  if (own && *own)
  {
    return std::string(own) == "off" ? "" : own;
  }
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache)
  {
    return std::string(cache) + "/vtkMeasuredBRDF";
  }
  const char* home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.cache/vtkMeasuredBRDF" : "";
}

bool ReadCache(const std::string& folder, const std::string& key, std::string& contents)
{
  std::ifstream file(fs::path(folder) / key, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(fs::path(folder) / key, error);
  const std::size_t header = sizeof(Magic) - 1 + 32;
  if (!file || error || size < header || size > LargestFile)
  {
    return false;
  }
  std::string all(static_cast<std::size_t>(size), '\0');
  file.read(all.data(), static_cast<std::streamsize>(size));
  if (!file || all.compare(0, sizeof(Magic) - 1, Magic) != 0)
  {
    return false;
  }
  const std::string checksum = all.substr(sizeof(Magic) - 1, 32);
  all.erase(0, header);
  if (GetChecksum(all) != checksum)
  {
    return false;
  }
  contents.swap(all);
  return true;
}

void WriteCache(const std::string& folder, const std::string& key, const std::string& contents,
  std::uint64_t maximumBytes)
{
  std::error_code error;
  if (contents.size() > maximumBytes)
  {
    return;
  }
  fs::create_directories(folder, error);
  // A name of its own, then the final one: nobody sees half a file.
  std::random_device random;
  std::ostringstream name;
  name << key << "." << random() << random() << ".part";
  const fs::path temporary = fs::path(folder) / name.str();
  {
    std::ofstream file(temporary, std::ios::binary);
    file << Magic << GetChecksum(contents);
    file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    file.flush();
    if (!file)
    {
      file.close();
      fs::remove(temporary, error);
      return;
    }
  }
  fs::rename(temporary, fs::path(folder) / key, error);
  if (error)
  {
    fs::remove(temporary, error);
    return;
  }

  // The oldest go first; also what programs that died left half written.
  std::vector<std::pair<fs::file_time_type, std::pair<fs::path, std::uint64_t>>> files;
  std::uint64_t total = 0;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
  {
    std::error_code ignored;
    const std::uint64_t size = it->file_size(ignored);
    const fs::file_time_type time = it->last_write_time(ignored);
    if (!ignored)
    {
      files.push_back({ time, { it->path(), size } });
      total += size;
    }
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files)
  {
    if (total <= maximumBytes)
    {
      break;
    }
    fs::remove(file.second.first, error);
    total -= file.second.second;
  }
}
} // namespace measuredbrdf
