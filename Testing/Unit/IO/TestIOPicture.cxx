// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkPictureReader.
#include "TestImages.h"

#include "vtkImageData.h"

#include <limits>

using namespace testio;

namespace
{
void WritePicture(const std::string& path, int width, int height, int channels,
  const std::vector<float>& pixels, OIIO::TypeDesc type)
{
  OIIO::ImageSpec spec(width, height, channels, type);
  spec.alpha_channel = channels == 2 || channels == 4 ? channels - 1 : -1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  WriteImage(path, spec, pixels);
}
}

//------------------------------------------------------------------------------
// Integers as they are, floats linear, the top row last; gray stays gray where that is asked.
TEST(IOPicture, KeepsValuesAsTheyAre)
{
  const Folder folder;
  const auto byte = OIIO::TypeDesc::UINT8;
  const struct
  {
    const char* Name;
    int Width, Height, Channels;
    OIIO::TypeDesc Type;
    std::vector<float> Pixels; // bytes
    bool KeepsGray;
    int Components;
    std::vector<double> Expected;
  } cases[] = {
    { "rgb.png", 1, 2, 3, byte, { 1, 2, 3, 254, 5, 6 }, false, 3, { 254, 5, 6, 1, 2, 3 } },
    { "rgba.png", 1, 1, 4, byte, { 200, 100, 50, 10 }, false, 4, { 200, 100, 50, 10 } },
    { "gray.png", 2, 1, 1, byte, { 7, 8 }, false, 3, { 7, 7, 7, 8, 8, 8 } },
    { "gray.png", 2, 1, 1, byte, { 7, 8 }, true, 1, { 7, 8 } },
    { "ya.png", 1, 1, 2, byte, { 90, 30 }, false, 4, { 90, 90, 90, 30 } },
    { "ya.png", 1, 1, 2, byte, { 90, 30 }, true, 2, { 90, 30 } },
    { "color.png", 1, 1, 3, byte, { 5, 5, 5 }, true, 3, { 5, 5, 5 } },
    { "a.tif", 1, 1, 3, byte, { 10, 20, 30 }, false, 3, { 10, 20, 30 } },
    { "a.bmp", 1, 1, 3, byte, { 10, 20, 30 }, false, 3, { 10, 20, 30 } },
    { "words.png", 1, 1, 3, OIIO::TypeDesc::UINT16, { 127.5f, 255, 0 }, false, 3,
      { 32768, 65535, 0 } },
    { "a.exr", 1, 1, 4, OIIO::TypeDesc::FLOAT, { 4 * 255, 51, 102, 153 }, false, 4,
      { 4.0, 0.2f, 0.4f, 0.6f } },
    { "a.hdr", 1, 1, 3, OIIO::TypeDesc::FLOAT, { 2 * 255, 255, 127.5f }, false, 3, { 2, 1, 0.5 } },
  };
  for (const auto& one : cases)
  {
    SCOPED_TRACE(one.Name);
    if (ReadsByVTK && std::string(one.Name) == "a.bmp")
    {
      continue;
    }
    std::vector<float> pixels;
    for (const float value : one.Pixels)
    {
      pixels.push_back(value / 255.0f);
    }
    WritePicture(folder(one.Name), one.Width, one.Height, one.Channels, pixels, one.Type);
    vtkNew<vtkPictureReader> reader;
    reader->SetKeepsGray(one.KeepsGray);
    reader->SetFileName(folder(one.Name));
    ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
    vtkImageData* picture = reader->GetPicture();
    EXPECT_EQ(picture->GetScalarType(), one.Type == byte                     ? VTK_UNSIGNED_CHAR
                                        : one.Type == OIIO::TypeDesc::UINT16 ? VTK_UNSIGNED_SHORT
                                                                             : VTK_FLOAT);
    EXPECT_EQ(picture->GetDimensions()[0], one.Width);
    EXPECT_EQ(picture->GetDimensions()[1], one.Height);
    ASSERT_EQ(picture->GetNumberOfScalarComponents(), one.Components);
    for (int k = 0; k < int(one.Expected.size()); ++k)
    {
      const int pixel = k / one.Components;
      EXPECT_NEAR(picture->GetScalarComponentAsDouble(
                    pixel % one.Width, pixel / one.Width, 0, k % one.Components),
        one.Expected[std::size_t(k)], 1e-6)
        << k;
    }
  }
}

//------------------------------------------------------------------------------
// 5 x 3 texels (x + 2 y) % 4 of a palette, in two bits each, in seven passes; alpha of colors 0, 1.
TEST(IOPicture, ExpandsPalettesOfInterlacedFiles)
{
  const Folder folder;
  const std::string digits =
    "89504e470d0a1a0a0000000d4948445200000005000000030203000001515f1dfd0000000c504c54"
    "450a141e28323c46505a646e78c64877df0000000274524e53c8643f6f353f000000144944415478"
    "da63600082060605860220dcd800000c5102b2f07c7cc10000000049454e44ae426082";
  std::string bytes;
  for (std::size_t k = 0; k < digits.size(); k += 2)
  {
    bytes += static_cast<char>(std::stoi(digits.substr(k, 2), nullptr, 16));
  }
  vtkNew<vtkPictureReader> reader;
  reader->SetFileName(WriteBytes(folder("a.png"), bytes));
  ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
  vtkImageData* picture = reader->GetPicture();
  ASSERT_EQ(picture->GetNumberOfScalarComponents(), 4);
  for (int k = 0; k < 15; ++k)
  {
    const int index = (k % 5 + 2 * (k / 5)) % 4;
    const int expected[4] = { 30 * index + 10, 30 * index + 20, 30 * index + 30,
      index == 0   ? 200
      : index == 1 ? 100
                   : 255 };
    for (int c = 0; c < 4; ++c)
    {
      EXPECT_EQ(picture->GetScalarComponentAsDouble(k % 5, 2 - k / 5, 0, c), expected[c]) << k;
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOPicture, ReadsTiledTiff)
{
  const Folder folder;
  for (const auto type : { OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16, OIIO::TypeDesc::FLOAT })
  {
    OIIO::ImageSpec spec(37, 21, 4, type);
    spec.tile_width = 16;
    spec.tile_height = 32;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    std::vector<float> pixels;
    for (int k = 0; k < 37 * 21 * 4; ++k)
    {
      pixels.push_back(static_cast<float>(k % 256) / 255.0f);
    }
    WriteImage(folder("a.tif"), spec, pixels);
    vtkNew<vtkPictureReader> reader;
    reader->SetFileName(folder("a.tif"));
    ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
    vtkImageData* picture = reader->GetPicture();
    ASSERT_EQ(picture->GetNumberOfScalarComponents(), 4);
    const double scale = type == OIIO::TypeDesc::UINT8    ? 255.0
                         : type == OIIO::TypeDesc::UINT16 ? 65535.0
                                                          : 1.0;
    for (int k = 0; k < 37 * 21 * 4; ++k)
    {
      const int texel = k / 4;
      EXPECT_NEAR(picture->GetScalarComponentAsDouble(texel % 37, 20 - texel / 37, 0, k % 4),
        scale * pixels[std::size_t(k)], 0.01);
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOPicture, RefusesBadFiles)
{
  const Folder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  WriteImage(folder("good.exr"), 1, 1, 3, { 1, 1, 1 });
  WriteImage(folder("nan.exr"), 2, 2, 3, { 0, 0, 0, 0, 0, nan, 0, 0, 0, 0, 0, 0 });
  WriteImage(
    folder("cut.png"), 64, 64, 3, std::vector<float>(3 * 64 * 64, 0.3f), OIIO::TypeDesc::UINT16);
  std::filesystem::resize_file(folder("cut.png"), 80);
  vtkNew<vtkPictureReader> reader;
  reader->SetFileName(folder("good.exr"));
  ASSERT_TRUE(reader->Read());
  vtkImageData* before = reader->GetPicture();
  ExpectReadFails(
    reader.Get(), folder("nan.exr"), { "pixel (1, 0)", "top left", "channel 2", "nan", "finite" });
  ExpectReadFails(reader.Get(), folder("cut.png"), {});
  WriteImage(
    folder("whole.png"), 64, 64, 3, std::vector<float>(3 * 64 * 64, 0.3f), OIIO::TypeDesc::UINT8);
  std::string bytes = ReadBytes(folder("whole.png"));
  bytes[bytes.size() / 2] ^= 1; // its sums do not fit any more
  ExpectReadFails(reader.Get(), WriteBytes(folder("flipped.png"), bytes), {});
  ExpectReadFails(reader.Get(), folder("none.png"), {});
  ExpectReadFails(reader.Get(), folder("."), {});
  EXPECT_EQ(reader->GetPicture(), before);
}
