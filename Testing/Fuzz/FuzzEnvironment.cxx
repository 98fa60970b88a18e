// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkEnvironmentReader's own code, with images that OpenImageIO reads: the first byte picks the
// projection, the second whether the file's size is a lie, a cut or the truth, or lines of the
// header are among what follows; then width, height, and texels.
#include "FuzzTarget.h"

#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkNew.h"
#include "vtkPictureReader.h"

#include <numeric>

namespace
{
// Radiance's format, without runs.
std::string MakeImage(
  int width, int height, std::size_t texels, std::string_view values, std::string_view lines)
{
  std::string bytes = "#?RADIANCE\n" + std::string(lines) + "\n\n-Y " + std::to_string(height) +
                      " +X " + std::to_string(width) + "\n";
  for (std::size_t k = 0; k < 4 * texels; ++k)
  {
    bytes += values.empty() ? '\x80' : values[k % values.size()];
  }
  return bytes;
}
}

int FuzzEnvironment(const std::uint8_t* data, std::size_t size)
{
  if (size < 6)
  {
    return 0;
  }
  static const fuzz::ScratchFolder folder;
  const fuzz::Silence silence;
  const auto takeSize = [data](int at) { return data[at] | data[at + 1] << 8; };
  const int kind = data[1] % 4;
  const bool lies = kind == 0;
  // A quarter are small probes: these are projected and, of few texels, subdivided, which takes
  // longer than all else. The others are what an environment's map may be at once.
  const bool small = std::accumulate(data, data + size, 0u) % 4 == 0;
  const int least = small || lies ? 0 : 64;
  const int width = lies ? takeSize(2) * 16 : 2 * least + takeSize(2) % 49;
  const int height = lies ? takeSize(4) * 16 : least + takeSize(4) % 49;
  const std::string_view values = fuzz::ToView(data + 6, size - 6);
  const std::size_t texels =
    lies ? 64 : static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::string image = MakeImage(width, height, texels, values,
    kind == 2 ? values.substr(0, 80) : std::string_view("FORMAT=32-bit_rle_rgbe"));
  if (kind == 1)
  {
    image.resize(image.size() / 2 + 1);
  }
  vtkNew<vtkEnvironmentReader> reader;
  const int projection = small ? data[0] % (vtkEnvironmentReader::CUBE_VERTICAL_STRIP + 3) - 1
                               : static_cast<int>(vtkEnvironmentReader::LAT_LONG);
  if (projection == vtkEnvironmentReader::CUBE_VERTICAL_STRIP + 1)
  {
    for (const char* face : { "px", "nx", "py", "ny", "pz", "nz" })
    {
      folder.Write(std::string(face) + ".hdr", image);
    }
    reader->SetFileName(folder("%s.hdr"));
  }
  else
  {
    reader->SetFileName(folder.Write("image.hdr", image));
    reader->SetProjection(projection);
  }
  const bool read = reader->Read();
  vtkNew<vtkPictureReader> pictures; // the same bytes
  pictures->SetFileName(folder("image.hdr"));
  fuzz::Require(pictures->Read() == pictures->GetErrorMessage().empty());
  fuzz::Require(read == reader->GetErrorMessage().empty());
  fuzz::Require(read == (reader->GetEnvironment() != nullptr));
  if (read)
  {
    for (const float value : reader->GetEnvironment()->GetPixels())
    {
      fuzz::Require(std::isfinite(value) && value >= 0.0f);
    }
  }
  return 0;
}
