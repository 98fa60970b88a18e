// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the IO room's tests share: a temporary folder, bytes, small files of every format, refusals.
 */

#ifndef TestIOHelpers_h
#define TestIOHelpers_h

#include "vtkAdaptiveWarpBRDF.h"
#include "vtkBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBRDFWriter.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace testio
{
/// A folder of this test's own, removed at its end.
class Folder
{
public:
  Folder()
    : Path(std::filesystem::temp_directory_path() /
           ("measuredbrdf-io-" + std::to_string(std::random_device()()) +
             std::to_string(std::random_device()())))
  {
    std::filesystem::create_directories(this->Path);
  }
  ~Folder()
  {
    std::error_code error;
    std::filesystem::remove_all(this->Path, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator()(const std::string& name) const { return (this->Path / name).string(); }

  std::size_t CountFiles() const
  {
    return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(this->Path), {}));
  }

private:
  std::filesystem::path Path;
};

inline void WriteBytes(const std::string& path, const std::string& bytes)
{
  // A new file each time: some file systems flush one that is truncated and written again.
  std::error_code error;
  std::filesystem::remove(path, error);
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

inline std::string ReadBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// A value's bytes at the end (the machines that run these tests are little-endian).
template <typename T>
void Append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
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

inline bool SameBits(const std::vector<float>& a, const std::vector<float>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

constexpr const char* SmallFit =
  "# a comment\n"
  "plain = Aggregate(Lambertian(albedo = [0.1, 0.2, 0.3]),\n"
  "  LowAshikhminShirley(sharpness = 20, fresnelReflectance = 1.5, albedo = [0.4, 0.5, 0.6]))\n";

/// MERL file of the given sizes; values grow with the cell, one cell is invalid.
inline std::string MakeMerl(int nThetaH, int nThetaD, int nPhiD)
{
  std::string bytes;
  Append<std::int32_t>(bytes, nThetaH);
  Append<std::int32_t>(bytes, nThetaD);
  Append<std::int32_t>(bytes, nPhiD);
  const int cells = nThetaH * nThetaD * nPhiD;
  for (int channel = 0; channel < 3; ++channel)
  {
    for (int cell = 0; cell < cells; ++cell)
    {
      Append<double>(bytes, cell == cells - 1 ? -1.0 : 100.0 + cell + 1000.0 * channel);
    }
  }
  return bytes;
}

inline std::string MakeMbsdf(bool color, int nTheta, int nPhi, bool transmission = false)
{
  std::string bytes = "NVIDIA ARC MBSDF V1\ncomment=\"made by a test\"\n";
  for (int block = 0; block < (transmission ? 2 : 1); ++block)
  {
    bytes += block == 0 ? "MBSDF_DATA_REFLECTION=\n" : "MBSDF_DATA_TRANSMISSION=\n";
    Append<std::uint32_t>(bytes, color ? 1 : 0);
    Append<std::uint32_t>(bytes, std::uint32_t(nTheta));
    Append<std::uint32_t>(bytes, std::uint32_t(nPhi));
    const int count = nTheta * nTheta * nPhi * (color ? 3 : 1);
    for (int k = 0; k < count; ++k)
    {
      Append<float>(bytes, k == 1 ? -0.5f : 0.25f + 0.01f * float(k));
    }
  }
  return bytes;
}

/// Small, valid tables of an isotropic warp.
inline vtkAdaptiveWarpBRDF::Tables MakeTables()
{
  const auto fill = [](std::vector<int> shape, float start)
  {
    vtkAdaptiveWarpBRDF::Table table;
    std::size_t count = 1;
    for (const int size : shape)
    {
      count *= std::size_t(size);
    }
    table.Shape = std::move(shape);
    for (std::size_t k = 0; k < count; ++k)
    {
      table.Values.push_back(start + 0.125f * float((7 * k) % 11));
    }
    return table;
  };
  vtkAdaptiveWarpBRDF::Tables tables;
  tables.ThetaI = { 0.0f, 0.7f, 1.4f };
  tables.PhiI = { 0.0f };
  tables.Ndf = fill({ 2, 8 }, 0.5f);
  tables.Sigma = fill({ 2, 8 }, 0.5f);
  tables.Vndf = fill({ 1, 3, 8, 8 }, 0.25f);
  tables.Luminance = fill({ 1, 3, 4, 4 }, 0.25f);
  tables.Rgb = fill({ 1, 3, 3, 4, 4 }, -0.1f);
  return tables;
}

struct TensorField
{
  std::string Name;
  std::uint8_t Type;
  std::vector<std::uint64_t> Shape;
  std::string Data;
};

inline std::vector<TensorField> MakeTensorFields(const vtkAdaptiveWarpBRDF::Tables& tables)
{
  const auto field = [](const std::string& name, const vtkAdaptiveWarpBRDF::Table& table)
  {
    return TensorField{ name, 10, { table.Shape.begin(), table.Shape.end() },
      std::string(
        reinterpret_cast<const char*>(table.Values.data()), table.Values.size() * sizeof(float)) };
  };
  const auto axis = [](const std::vector<float>& values) {
    return vtkAdaptiveWarpBRDF::Table{ { int(values.size()) }, values };
  };
  return { { "description", 1, { 6 }, "sample" }, field("phi_i", axis(tables.PhiI)),
    field("theta_i", axis(tables.ThetaI)), field("sigma", tables.Sigma), field("ndf", tables.Ndf),
    field("vndf", tables.Vndf), field("luminance", tables.Luminance), field("rgb", tables.Rgb),
    { "jacobian", 1, { 1 }, "\x01" } };
}

inline std::string MakeTensor(const std::vector<TensorField>& fields)
{
  std::string bytes("tensor_file\0\x01\0", 14);
  Append<std::uint32_t>(bytes, std::uint32_t(fields.size()));
  std::uint64_t offset = bytes.size();
  for (const TensorField& field : fields)
  {
    offset += 2 + field.Name.size() + 2 + 1 + 8 + 8 * field.Shape.size();
  }
  std::string data;
  for (const TensorField& field : fields)
  {
    Append<std::uint16_t>(bytes, std::uint16_t(field.Name.size()));
    bytes += field.Name;
    Append<std::uint16_t>(bytes, std::uint16_t(field.Shape.size()));
    Append<std::uint8_t>(bytes, field.Type);
    Append<std::uint64_t>(bytes, offset + data.size());
    for (const std::uint64_t size : field.Shape)
    {
      Append<std::uint64_t>(bytes, size);
    }
    data += field.Data;
  }
  return bytes + data;
}

inline vtkSmartPointer<vtkBRDF> Read(const std::string& path)
{
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(path);
  EXPECT_TRUE(reader->Read()) << reader->GetErrorMessage();
  EXPECT_EQ(reader->GetErrorMessage(), "");
  return reader->GetBRDF();
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

inline void ExpectBytesRefused(
  const Folder& folder, const std::string& bytes, const std::vector<std::string>& words)
{
  const std::string path = folder("bad.file");
  WriteBytes(path, bytes);
  ExpectRefused(folder, path, words);
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
