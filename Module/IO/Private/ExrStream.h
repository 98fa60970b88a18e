// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A file in memory as OpenEXR reads it.
 */

#ifndef ExrStream_h
#define ExrStream_h

#include "FileBytes.h"

#include <Iex.h>
#include <ImfIO.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace measuredbrdf
{
class ExrStream : public Imf::IStream
{
public:
  explicit ExrStream(const FileBytes& file)
    : Imf::IStream(file.GetPath().c_str())
    , File(file)
  {
  }

  bool read(char out[], int count) override
  {
    const std::uint64_t left = this->File.GetView().size() - this->Place;
    if (count < 0 || static_cast<std::uint64_t>(count) > left)
    {
      throw Iex::InputExc("byte " + std::to_string(this->Place) + ": " + std::to_string(count) +
                          " bytes were expected, but the file ends after " + std::to_string(left));
    }
    std::memcpy(out, this->File.GetView().data() + this->Place, static_cast<std::size_t>(count));
    this->Place += static_cast<std::uint64_t>(count);
    return this->Place < this->File.GetView().size();
  }
  std::uint64_t tellg() override { return this->Place; }
  void seekg(std::uint64_t place) override
  {
    if (place > this->File.GetView().size())
    {
      throw Iex::InputExc("an offset points to byte " + std::to_string(place) +
                          ", but the file ends at " + std::to_string(this->File.GetView().size()));
    }
    this->Place = place;
  }

private:
  const FileBytes& File;
  std::uint64_t Place = 0;
};
} // namespace measuredbrdf

#endif
