// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Images that tests write.
 */

#ifndef TestImages_h
#define TestImages_h

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace testio
{
/// Pixels as files have them: top row first.
inline void WriteImage(
  const std::string& path, const OIIO::ImageSpec& spec, const std::vector<float>& pixels)
{
  auto out = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(out) << OIIO::geterror();
  ASSERT_TRUE(out->open(path, spec)) << out->geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << out->geterror();
  out->close();
}

inline void WriteImage(const std::string& path, int width, int height, int channels,
  const std::vector<float>& pixels, OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT,
  const std::string& colorSpace = "")
{
  OIIO::ImageSpec spec(width, height, channels, type);
  if (!colorSpace.empty())
  {
    spec.attribute("oiio:ColorSpace", colorSpace);
  }
  WriteImage(path, spec, pixels);
}
} // namespace testio

#endif
