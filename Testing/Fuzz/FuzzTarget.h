// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the fuzz targets share. A target is a function that takes any bytes and must come back: it
 * crashes where a reader does, throws what the reader should not, or returns nonsense.
 *
 * With libFuzzer each target is a program; without it TestFuzzTargets calls them by name.
 */

#ifndef FuzzTarget_h
#define FuzzTarget_h

#include "MaterialFormat.h"
#include "TestFolder.h"
#include "vtkBRDF.h"
#include "vtkBTDF.h"
#include "vtkObject.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <string_view>

#ifdef MEASUREDBRDF_LIBFUZZER // the program's target
int MEASUREDBRDF_LIBFUZZER(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  return MEASUREDBRDF_LIBFUZZER(data, size);
}
#endif

namespace fuzz
{
/// Ends the program where a promise is broken.
inline void Require(bool promise)
{
  if (!promise)
  {
    std::abort();
  }
}

inline std::string_view ToView(const std::uint8_t* data, std::size_t size)
{
  return std::string_view(reinterpret_cast<const char*>(data), size);
}

/// VTK's messages off, while it lives.
class Silence
{
public:
  Silence()
    : Before(vtkObject::GetGlobalWarningDisplay())
  {
    vtkObject::GlobalWarningDisplayOff();
  }
  ~Silence() { vtkObject::SetGlobalWarningDisplay(this->Before); }
  Silence(const Silence&) = delete;
  void operator=(const Silence&) = delete;

private:
  int Before;
};

/// A folder of this process, in memory where the system has such a place; removed at its end.
class ScratchFolder : public TestFolder
{
public:
  ScratchFolder()
    : TestFolder(std::filesystem::is_directory("/dev/shm") ? "/dev/shm"
                                                           : std::filesystem::temp_directory_path())
  {
  }

  /// The path of the file with these contents.
  std::string Write(const std::string& name, std::string_view bytes) const
  {
    std::ofstream file((*this)(name), std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    Require(file.good());
    return (*this)(name);
  }
};

/// Values of a material, or of what goes through one, keep their promise.
template <typename Material>
void RequireValues(Material* material)
{
  constexpr double directions[][3] = { { 0.0, 0.0, 1.0 }, { 0.6, 0.0, 0.8 }, { 0.0, -0.6, -0.8 },
    { -0.28, 0.9553, 0.0925 }, { -0.28, 0.9553, -0.0925 } };
  for (const auto& i : directions)
  {
    for (const auto& o : directions)
    {
      double f[3];
      material->Evaluate(i, o, f);
      for (const double value : f)
      {
        Require(std::isfinite(value) && value >= 0.0);
      }
    }
  }
}

/// What programs do with a material that was read. sampled: also what takes long to build.
inline void Use(vtkBRDF* brdf, bool sampled)
{
  Require(brdf != nullptr);
  if (sampled)
  {
    brdf->Prepare();
    for (const double o : { 0.0, 0.6, 0.9553 })
    {
      const double view[3] = { o, 0.0, std::sqrt(1.0 - o * o) };
      double drawn[3] = { 0.0, 0.0, 1.0 };
      brdf->Sample(view, 0.3, 0.7, drawn);
      brdf->Pdf(drawn, view);
    }
  }
  RequireValues(brdf);
}

/// True for one input in 32, always for the same ones.
inline bool IsRare(const std::uint8_t* data, std::size_t size)
{
  return std::accumulate(data, data + size, 0u) % 32 == 0;
}

/// Read a material's file by a function of a format. FileError is how it refuses; any other
/// exception is a fault: what was not checked before it was used or allocated.
template <typename Reader>
void ReadMaterial(const std::uint8_t* data, std::size_t size, Reader reader)
{
  const Silence silence;
  try
  {
    Use(reader(measuredbrdf::FileBytes::View("file", ToView(data, size))).BRDF, IsRare(data, size));
  }
  catch (const measuredbrdf::FileError&)
  {
  }
}

/// The same by a format, of the material of that name.
inline int ReadFormat(const measuredbrdf::MaterialFormat& format, const std::uint8_t* data,
  std::size_t size, const std::string& name = "")
{
  ReadMaterial(
    data, size, [&](const measuredbrdf::FileBytes& file) { return format.Read(file, name); });
  return 0;
}
} // namespace fuzz

#endif
