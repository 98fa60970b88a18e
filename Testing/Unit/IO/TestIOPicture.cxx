// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkPictureReader.
#include "ErrorCatcher.h"
#include "TestIOHelpers.h"
#include "TestImages.h"

#include "vtkImageData.h"
#include "vtkPictureReader.h"

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

void ExpectPicture(const std::string& path, int type, int width, int height, int components,
  const std::vector<double>& values, bool keepsGray = false)
{
  vtkNew<vtkPictureReader> reader;
  reader->SetKeepsGray(keepsGray);
  reader->SetFileName(path);
  ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
  vtkImageData* picture = reader->GetPicture();
  EXPECT_EQ(picture->GetScalarType(), type);
  EXPECT_EQ(picture->GetDimensions()[0], width);
  EXPECT_EQ(picture->GetDimensions()[1], height);
  ASSERT_EQ(picture->GetNumberOfScalarComponents(), components);
  std::size_t k = 0;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < components; ++c)
      {
        EXPECT_NEAR(picture->GetScalarComponentAsDouble(x, y, 0, c), values[k++], 1e-6)
          << x << " " << y << " " << c;
      }
    }
  }
}

float Byte(int value) { return static_cast<float>(value) / 255.0f; }
}

//------------------------------------------------------------------------------
TEST(IOPicture, KeepsIntegersAsTheyAre)
{
  const Folder folder;
  const auto byte = OIIO::TypeDesc::UINT8;
  // The top row last; one pixel a row.
  WritePicture(
    folder("rgb.png"), 1, 2, 3, { Byte(1), Byte(2), Byte(3), Byte(254), Byte(5), Byte(6) }, byte);
  ExpectPicture(folder("rgb.png"), VTK_UNSIGNED_CHAR, 1, 2, 3, { 254, 5, 6, 1, 2, 3 });
  WritePicture(folder("rgba.png"), 1, 1, 4, { Byte(200), Byte(100), Byte(50), Byte(10) }, byte);
  ExpectPicture(folder("rgba.png"), VTK_UNSIGNED_CHAR, 1, 1, 4, { 200, 100, 50, 10 });
  WritePicture(folder("gray.png"), 2, 1, 1, { Byte(7), Byte(8) }, byte);
  ExpectPicture(folder("gray.png"), VTK_UNSIGNED_CHAR, 2, 1, 3, { 7, 7, 7, 8, 8, 8 });
  WritePicture(folder("ya.png"), 1, 1, 2, { Byte(90), Byte(30) }, byte);
  ExpectPicture(folder("ya.png"), VTK_UNSIGNED_CHAR, 1, 1, 4, { 90, 90, 90, 30 });
  WritePicture(folder("words.png"), 1, 1, 3, { 0.5f, 1.0f, 0.0f }, OIIO::TypeDesc::UINT16);
  ExpectPicture(folder("words.png"), VTK_UNSIGNED_SHORT, 1, 1, 3, { 32768, 65535, 0 });
  for (const char* name : { "a.tif", "a.bmp" })
  {
    WritePicture(folder(name), 1, 1, 3, { Byte(10), Byte(20), Byte(30) }, byte);
    ExpectPicture(folder(name), VTK_UNSIGNED_CHAR, 1, 1, 3, { 10, 20, 30 });
  }
}

//------------------------------------------------------------------------------
TEST(IOPicture, GrayStaysGrayWhereThatIsAsked)
{
  const Folder folder;
  const auto byte = OIIO::TypeDesc::UINT8;
  WritePicture(folder("gray.png"), 2, 1, 1, { Byte(7), Byte(8) }, byte);
  WritePicture(folder("ya.png"), 1, 1, 2, { Byte(90), Byte(30) }, byte);
  WritePicture(folder("rgb.png"), 1, 1, 3, { Byte(5), Byte(5), Byte(5) }, byte);
  ExpectPicture(folder("gray.png"), VTK_UNSIGNED_CHAR, 2, 1, 1, { 7, 8 }, true);
  ExpectPicture(folder("ya.png"), VTK_UNSIGNED_CHAR, 1, 1, 2, { 90, 30 }, true);
  ExpectPicture(folder("rgb.png"), VTK_UNSIGNED_CHAR, 1, 1, 3, { 5, 5, 5 }, true);
}

//------------------------------------------------------------------------------
TEST(IOPicture, FloatsAreLinear)
{
  const Folder folder;
  WritePicture(folder("a.exr"), 1, 1, 4, { 4.0f, 0.5f, 0.25f, 0.5f }, OIIO::TypeDesc::FLOAT);
  ExpectPicture(folder("a.exr"), VTK_FLOAT, 1, 1, 4, { 4.0, 0.5, 0.25, 0.5 });
  WritePicture(folder("a.hdr"), 1, 1, 3, { 2.0f, 1.0f, 0.5f }, OIIO::TypeDesc::FLOAT);
  ExpectPicture(folder("a.hdr"), VTK_FLOAT, 1, 1, 3, { 2.0, 1.0, 0.5 });
}

//------------------------------------------------------------------------------
TEST(IOPicture, RefusesBadFiles)
{
  const Folder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  WritePicture(folder("good.exr"), 1, 1, 3, { 1, 1, 1 }, OIIO::TypeDesc::FLOAT);
  WritePicture(
    folder("nan.exr"), 2, 2, 3, { 0, 0, 0, 0, 0, nan, 0, 0, 0, 0, 0, 0 }, OIIO::TypeDesc::FLOAT);
  WritePicture(
    folder("cut.png"), 64, 64, 3, std::vector<float>(3 * 64 * 64, 0.3f), OIIO::TypeDesc::UINT16);
  std::filesystem::resize_file(folder("cut.png"), 80);
  std::ofstream(folder("huge.hdr"), std::ios::binary)
    << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n\x80\x80\x80\x81";
  std::ofstream(folder("junk.png"), std::ios::binary) << "junk";
  vtkNew<vtkPictureReader> reader;
  ErrorCatcher errors(reader);
  reader->SetFileName(folder("good.exr"));
  ASSERT_TRUE(reader->Read());
  vtkImageData* before = reader->GetPicture();
  const struct
  {
    const char* Name;
    std::vector<std::string> Words;
  } cases[] = { { "nan.exr", { "pixel (1, 0)", "top left", "channel 2", "nan", "finite" } },
    { "cut.png", {} }, { "huge.hdr", { "60000" } }, { "junk.png", {} }, { "none.png", {} },
    { ".", {} } }; // newer OpenImageIO refuses the huge one by itself, in its own words
  for (const auto& one : cases)
  {
    reader->SetFileName(folder(one.Name));
    EXPECT_FALSE(reader->Read()) << one.Name;
    EXPECT_EQ(errors.Take(), 1);
    EXPECT_EQ(reader->GetPicture(), before);
    EXPECT_NE(reader->GetErrorMessage().find(one.Name), std::string::npos);
    for (const std::string& word : one.Words)
    {
      EXPECT_NE(reader->GetErrorMessage().find(word), std::string::npos)
        << "'" << word << "' in: " << reader->GetErrorMessage();
    }
  }
}
