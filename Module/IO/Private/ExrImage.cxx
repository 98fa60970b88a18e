// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExrImage.h"

#include "ExrStream.h"

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>

#include <algorithm>
#include <cstddef>

namespace measuredbrdf
{
//------------------------------------------------------------------------------
ExrImage ReadExrImage(const FileBytes& file)
{
  ExrStream stream(file);
  Imf::MultiPartInputFile input(stream, 0, false);
  Imf::InputPart part(input, 0);
  const Imath::Box2i window = part.header().dataWindow();
  ExrImage image;
  image.Width = window.max.x - window.min.x + 1;
  image.Height = window.max.y - window.min.y + 1;
  const std::size_t row = 3 * static_cast<std::size_t>(image.Width);
  image.Pixels.resize(row * static_cast<std::size_t>(image.Height));
  Imf::FrameBuffer buffer;
  const char* const names[] = { "R", "G", "B" };
  for (std::size_t c = 0; c < 3; ++c)
  {
    buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, &image.Pixels[c], window,
                              3 * sizeof(float), row * sizeof(float)));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
  // Files begin with the top row.
  float* const pixels = image.Pixels.data();
  for (int y = 0; y < image.Height / 2; ++y)
  {
    std::swap_ranges(
      pixels + y * row, pixels + (y + 1) * row, pixels + (image.Height - 1 - y) * row);
  }
  return image;
}
} // namespace measuredbrdf
