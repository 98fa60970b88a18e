// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What an image's header says: each file says in its own way how its pixels are to be read.
#include "TestImages.h"

#include <ImfRgbaFile.h>
#include <OpenImageIO/deepdata.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace testio;

namespace
{
using Spec = OIIO::ImageSpec;

/// 1, 2, 3, ... as gray texels: every texel is another.
std::vector<float> CountTexels(int texels)
{
  std::vector<float> values;
  for (int k = 0; k < texels; ++k)
  {
    values.insert(values.end(), 3, static_cast<float>(k + 1));
  }
  return values;
}

/// RGBE without runs: one byte a channel, of a value from 0 to 255.
std::string MakeRadiance(
  const std::string& lines, const std::string& size, const std::vector<float>& values)
{
  std::string bytes = "#?RADIANCE\n" + lines + "\n" + size + "\n";
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    bytes += static_cast<char>(static_cast<int>(values[k]));
    if (k % 3 == 2)
    {
      bytes += static_cast<char>(136);
    }
  }
  return bytes;
}

std::vector<double> ToDoubles(const std::vector<float>& values)
{
  return std::vector<double>(values.begin(), values.end());
}

bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}

//------------------------------------------------------------------------------
TEST(IOImageHeaders, RadianceIsDividedByAllExposures)
{
  const Folder folder;
  WriteBytes(folder("a.hdr"),
    MakeRadiance("# a comment\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=4\npfilt -1\n\tEXPOSURE=7\n"
                 "EXPOSURE= 0.5\nCOLORCORR= 1 2 4\n",
      "-Y 1 +X 2", { 8, 8, 8, 40, 40, 40 }));
  ExpectValues(ReadTopFirst(folder("a.hdr")), { 4, 2, 1, 20, 10, 5 }, 1e-6);
  for (const std::string lie : { "EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=1,5",
         "EXPOSURE=", "EXPOSURE=1e40", "COLORCORR=1 2", "PRIMARIES= 1 2 3", "FORMAT=text" })
  {
    ExpectImageBytesRefused(folder, MakeRadiance(lie + "\n", "-Y 1 +X 1", { 8, 8, 8 }),
      { lie.substr(0, lie.find('=')), "at byte 11" });
  }
}

//------------------------------------------------------------------------------
TEST(IOImageHeaders, RadianceHasRuns)
{
  const Folder folder;
  const std::vector<double> expected = { 8, 1, 3, 8, 2, 3, 8, 2, 3, 8, 2, 3, 8, 2, 3, 8, 2, 3, 8, 2,
    3, 8, 2, 3, 8, 2, 3 };
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n";
  const std::string channels =
    std::string("\2\2\0\x09", 4) + "\x89\x08" + "\1\1\x88\2" + "\2\3\3\x87\3" + "\x89\x88";
  WriteBytes(folder("a.hdr"), head + channels);
  EXPECT_EQ(ReadTopFirst(folder("a.hdr")).Values, expected);
  for (const std::string& bad : { Replace(channels, "\x89\x08", "\x8a\x08"),
         Replace(channels, "\x89\x08", std::string("\0\x08", 2)),
         Replace(channels, std::string("\0\x09", 2), std::string("\0\x0a", 2)),
         channels.substr(0, channels.size() - 1) })
  {
    ExpectImageBytesRefused(folder, head + bad, { "scanline at byte " });
  }
}

//------------------------------------------------------------------------------
// All eight resolution lines of Radiance's format, of a picture of 3 x 2.
TEST(IOImageHeaders, RadianceHasEightOrders)
{
  const Folder folder;
  const std::vector<float> picture = CountTexels(6);
  for (const bool rows : { true, false })
  {
    for (const bool down : { true, false })
    {
      for (const bool right : { true, false })
      {
        const std::string y = std::string(down ? "-" : "+") + "Y 2";
        const std::string x = std::string(right ? "+" : "-") + "X 3";
        const std::string size = rows ? y + " " + x : x + " " + y;
        SCOPED_TRACE(size);
        std::vector<float> stored;
        for (int k = 0; k < 6; ++k)
        {
          const int across = rows ? k % 3 : k / 2;
          const int along = rows ? k / 3 : k % 2;
          const int column = right ? across : 2 - across;
          const int row = down ? along : 1 - along;
          stored.insert(stored.end(), 3, picture[static_cast<std::size_t>(3 * (3 * row + column))]);
        }
        WriteBytes(folder("a.hdr"), MakeRadiance("FORMAT=32-bit_rle_rgbe\n", size, stored));
        const FoundImage found = ReadTopFirst(folder("a.hdr"));
        EXPECT_EQ(found.Width, 3);
        EXPECT_EQ(found.Height, 2);
        ExpectValues(found, ToDoubles(picture), 1e-6);
      }
    }
  }
}

//------------------------------------------------------------------------------
// EXIF's and TIFF's tag 274, which OpenEXR files may have, too. A picture of 3 x 2 as each stores
// it; of blocks of 16 x 16 in JPEG, which changes values a little.
TEST(IOImageHeaders, OrientationTurns)
{
  const Folder folder;
  // Texels 1 2 3 / 4 5 6, by the tag's definition: the sides of the picture that row 0 and column 0
  // are.
  const std::vector<std::vector<int>> stored = { { 1, 2, 3, 4, 5, 6 }, { 3, 2, 1, 6, 5, 4 },
    { 6, 5, 4, 3, 2, 1 }, { 4, 5, 6, 1, 2, 3 }, { 1, 4, 2, 5, 3, 6 }, { 3, 6, 2, 5, 1, 4 },
    { 6, 3, 5, 2, 4, 1 }, { 4, 1, 5, 2, 6, 3 } };
  for (int orientation = 1; orientation <= 8; ++orientation)
  {
    for (const char* name : { "a.tif", "a.exr" })
    {
      SCOPED_TRACE(name + std::to_string(orientation));
      std::vector<float> values;
      for (const int value : stored[static_cast<std::size_t>(orientation - 1)])
      {
        values.insert(values.end(), 3, static_cast<float>(value));
      }
      Spec spec(orientation > 4 ? 2 : 3, orientation > 4 ? 3 : 2, 3, OIIO::TypeDesc::FLOAT);
      spec.attribute("Orientation", orientation);
      WriteImage(folder(name), spec, values);
      const FoundImage found = ReadTopFirst(folder(name));
      EXPECT_EQ(found.Width, 3);
      EXPECT_EQ(found.Height, 2);
      ExpectValues(found, ToDoubles(CountTexels(6)), 1e-6);
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOImageHeaders, OrientationTurnsJpeg)
{
  const Folder folder;
  Spec spec(32, 16, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Orientation", 6); // row 0 is the right side, column 0 the top
  std::vector<float> values;
  for (int k = 0; k < 32 * 16; ++k)
  {
    values.insert(values.end(), 3, k % 32 < 16 ? 0.0f : 1.0f);
  }
  WriteImage(folder("a.jpg"), spec, values);
  const FoundImage found = ReadTopFirst(folder("a.jpg"));
  EXPECT_EQ(found.Width, 16);
  EXPECT_EQ(found.Height, 32);
  EXPECT_LT(found.Values.front(), 0.01);
  EXPECT_LT(found.Values[3 * 15], 0.01);
  EXPECT_GT(found.Values.back(), 0.99);
}

//------------------------------------------------------------------------------
// ACEScg to linear sRGB with Bradford's adaptation, as published (colour-science's and ACES's own
// figures: 1.70505, -0.62179, ...); XYZ by the matrix of IEC 61966-2-1 behind the same adaptation.
TEST(IOImageHeaders, ChromaticitiesBecomeRec709)
{
  const Folder folder;
  const std::vector<float> colors = { 100, 50, 50, 50, 100, 50, 50, 50, 100, 60, 60, 60 };
  const auto expect = [&colors](const std::array<double, 9>& matrix)
  {
    std::vector<double> expected;
    for (std::size_t k = 0; k < colors.size(); k += 3)
    {
      for (std::size_t c = 0; c < 9; c += 3)
      {
        expected.push_back(std::max(0.0, // negative radiance is set to 0
          matrix[c] * colors[k] + matrix[c + 1] * colors[k + 1] + matrix[c + 2] * colors[k + 2]));
      }
    }
    return expected;
  };
  const std::vector<double> ap1 = expect(
    { 1.70505, -0.62179, -0.08326, -0.13026, 1.14080, -0.01055, -0.02400, -0.12897, 1.15297 });
  const std::string size = "-Y 2 +X 2";
  WriteBytes(folder("ap1.hdr"),
    MakeRadiance("PRIMARIES= 0.713 0.293 0.165 0.830 0.128 0.044 0.32168 0.33767\n", size, colors));
  ExpectValues(ReadTopFirst(folder("ap1.hdr")), ap1, 0.02);

  WriteBytes(folder("xyz.hdr"), MakeRadiance("FORMAT=32-bit_rle_xyze\n", size, colors));
  ExpectValues(ReadTopFirst(folder("xyz.hdr")),
    expect({ 3.1462519, -1.6661246, -0.4801273, -0.9955355, 1.9557639, 0.0397716, 0.0635979,
      -0.2145965, 1.1509987 }),
    0.05);

  const float chromaticities[8] = { 0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f,
    0.33767f };
  Spec spec(2, 2, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
  WriteImage(folder("ap1.exr"), spec, colors);
  ExpectValues(ReadTopFirst(folder("ap1.exr")), ap1, 0.02);

  // Rec. 709's own, rounded: not a bit changes.
  const float own[8] = { 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.31271f, 0.32902f };
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), own);
  WriteImage(folder("own.exr"), spec, colors);
  EXPECT_EQ(ReadTopFirst(folder("own.exr")).Values, ToDoubles(colors));

  // All zero, as some programs write: the header says nothing.
  WriteBytes(folder("zero.hdr"), MakeRadiance("PRIMARIES=0 0 0 0 0 0 0 0\n", size, colors));
  EXPECT_EQ(ReadTopFirst(folder("zero.hdr")).Values, ToDoubles(colors));

  for (const char* bad : { "0.6 0.3 0.6 0.3 0.1 0.06 0.3 0.3", "0.64 0.33 0.3 0.6 0.15 0.06 0.9 0",
         "0.64 0.33 0.3 0.6 0.15 0.06 0.8 0.1" })
  {
    ExpectImageBytesRefused(folder,
      MakeRadiance(std::string("PRIMARIES=") + bad + "\n", size, colors),
      { "chromaticities: found 0.6" });
  }
}

//------------------------------------------------------------------------------
TEST(IOImageHeaders, DataWindowsAreBlackOutside)
{
  const Folder folder;
  Spec spec(2, 2, 3, OIIO::TypeDesc::HALF);
  spec.x = 11;
  spec.y = -4;
  spec.full_x = 10;
  spec.full_y = -5;
  spec.full_width = 4;
  spec.full_height = 3;
  WriteImage(folder("inside.exr"), spec, CountTexels(4));
  FoundImage found = ReadTopFirst(folder("inside.exr"));
  EXPECT_EQ(found.Width, 4);
  EXPECT_EQ(found.Height, 3);
  std::vector<double> red;
  for (std::size_t k = 0; k < found.Values.size(); k += 3)
  {
    red.push_back(found.Values[k]);
  }
  EXPECT_EQ(red, (std::vector<double>{ 0, 0, 0, 0, 0, 1, 2, 0, 0, 3, 4, 0 }));
  EXPECT_TRUE(Contains(found.Notes, "8 texels of the display window")) << found.Notes;

  spec.x = 13; // half of it outside
  WriteImage(folder("moved.exr"), spec, CountTexels(4));
  found = ReadTopFirst(folder("moved.exr"));
  EXPECT_EQ(found.Width, 4);
  EXPECT_EQ(found.Values[3 * 7], 1.0);
  EXPECT_EQ(found.Values[3 * 11], 3.0);
  EXPECT_TRUE(Contains(found.Notes, "2 texels outside")) << found.Notes;

  spec.x = 20; // all of it
  WriteImage(folder("away.exr"), spec, CountTexels(4));
  EXPECT_EQ(ReadTopFirst(folder("away.exr")).Values, std::vector<double>(36, 0.0));

  spec.full_width = spec.full_height = 60000; // no memory for nothing
  WriteImage(folder("huge.exr"), spec, CountTexels(4));
  const double before = GetPeakMemory();
  ExpectImageRefused(folder, folder("huge.exr"), { "display window" });
  EXPECT_LT(GetPeakMemory() - before, 1e8);
}

//------------------------------------------------------------------------------
TEST(IOImageHeaders, LayersAreChosenByName)
{
  const Folder folder;
  Spec spec(1, 1, 7, OIIO::TypeDesc::FLOAT);
  spec.channelnames = { "View.AO.R", "View.AO.G", "View.AO.B", "View.Combined.R", "View.Combined.G",
    "View.Combined.B", "View.Depth.Z" };
  WriteImage(folder("blender.exr"), spec, { 1, 2, 3, 4, 5, 6, 7 });
  FoundImage found = ReadTopFirst(folder("blender.exr"));
  EXPECT_EQ(found.Values, (std::vector<double>{ 4, 5, 6 }));
  EXPECT_TRUE(Contains(found.Notes, "'View.AO', 'View.Combined': 'View.Combined' was taken"))
    << found.Notes;
  EXPECT_EQ(
    ReadTopFirst(folder("blender.exr"), "View.AO").Values, (std::vector<double>{ 1, 2, 3 }));
  ExpectImageRefused(folder, folder("blender.exr"), { "'View.Combined'" }, "View.Mist");

  spec.channelnames = { "AO.R", "AO.G", "AO.B", "R", "G", "B", "Z" };
  WriteImage(folder("unnamed.exr"), spec, { 1, 2, 3, 4, 5, 6, 7 });
  EXPECT_EQ(ReadTopFirst(folder("unnamed.exr")).Values, (std::vector<double>{ 4, 5, 6 }));

  // Two parts: the first has a layer's name, the second none.
  std::vector<Spec> parts(2, Spec(1, 1, 3, OIIO::TypeDesc::FLOAT));
  parts[0].channelnames = { "A.R", "A.G", "A.B" };
  parts[0].attribute("oiio:subimagename", "first");
  parts[1].attribute("oiio:subimagename", "second");
  auto out = OIIO::ImageOutput::create(folder("parts.exr"));
  ASSERT_TRUE(out->open(folder("parts.exr"), 2, parts.data())) << out->geterror();
  const float values[2][3] = { { 1, 2, 3 }, { 4, 5, 6 } };
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values[0]));
  ASSERT_TRUE(out->open(folder("parts.exr"), parts[1], OIIO::ImageOutput::AppendSubimage));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values[1]));
  out->close();
  found = ReadTopFirst(folder("parts.exr"));
  EXPECT_EQ(found.Values, (std::vector<double>{ 4, 5, 6 }));
  EXPECT_TRUE(Contains(found.Notes, "'second' was taken")) << found.Notes;
  for (const char* name : { "first", "first.A", "A" })
  {
    EXPECT_EQ(ReadTopFirst(folder("parts.exr"), name).Values, (std::vector<double>{ 1, 2, 3 }));
  }
}

//------------------------------------------------------------------------------
// Channels that leave texels out are refused, and so are deep samples.
TEST(IOImageHeaders, DeepAndSubsampledAreRefused)
{
  const Folder folder;
  Spec spec(2, 1, 3, OIIO::TypeDesc::FLOAT);
  spec.deep = true;
  OIIO::DeepData samples;
  samples.init(spec);
  samples.set_samples(0, 2);
  auto out = OIIO::ImageOutput::create(folder("deep.exr"));
  ASSERT_TRUE(out->open(folder("deep.exr"), spec)) << out->geterror();
  ASSERT_TRUE(out->write_deep_scanlines(0, 1, 0, samples)) << out->geterror();
  out->close();
  ExpectImageRefused(folder, folder("deep.exr"), { "found deep samples" });

  {
    const std::vector<Imf::Rgba> pixels(16);
    Imf::RgbaOutputFile file(folder("chroma.exr").c_str(), 4, 4, Imf::WRITE_YC);
    file.setFrameBuffer(pixels.data(), 1, 4);
    file.writePixels(4);
  }
  ExpectImageRefused(folder, folder("chroma.exr"), { "'BY'", "2. by 2. texel" });
}

//------------------------------------------------------------------------------
// ImfEnvmap.h: +x -x +y -y +z -z below each other, each as it is seen from inside, +y up; lat-long
// images have +z in the center and +x to the left of it.
TEST(IOImageHeaders, EnvmapAttributeNamesTheAxes)
{
  const Folder folder;
  const double directions[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 },
    { 0, 0, 1 }, { 0, 0, -1 } };
  Spec spec(8, 48, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("textureformat", "CubeFace Environment");
  std::vector<float> cube;
  for (int face = 0; face < 6; ++face)
  {
    cube.insert(cube.end(), 3 * 64, static_cast<float>(face + 1));
  }
  WriteImage(folder("cube.exr"), spec, cube);
  Spec around(64, 32, 3, OIIO::TypeDesc::FLOAT);
  around.attribute("textureformat", "LatLong Environment");
  std::vector<float> map;
  for (int y = 0; y < 32; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      const int face = y < 6 ? 2 : y >= 26 ? 3 : x < 8 || x >= 56 ? 5 : x < 24 ? 0 : x < 40 ? 4 : 1;
      map.insert(map.end(), 3, static_cast<float>(face + 1));
    }
  }
  WriteImage(folder("around.exr"), around, map);
  for (const char* name : { "cube.exr", "around.exr" })
  {
    const auto reader = ReadProbe(folder(name));
    for (int face = 0; face < 6; ++face)
    {
      double rgb[3];
      reader->GetEnvironment()->GetRadiance(directions[face], rgb);
      EXPECT_NEAR(rgb[0], face + 1.0, 1e-5) << name;
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOImageHeaders, NamesMayHoldAnyCharacter)
{
  const Folder folder;
  for (const char* name : { "cloudy 80%sky.hdr", "100%.hdr", "%d %s %n.hdr", "what?a=b.hdr",
         "#1 a.0001.hdr", "no ending", "wrong.jpg" })
  {
    WriteBytes(folder(name), MakeRadiance("", "-Y 1 +X 2", { 1, 1, 1, 2, 2, 2 }));
    EXPECT_EQ(ReadTopFirst(folder(name)).Values, (std::vector<double>{ 1, 1, 1, 2, 2, 2 })) << name;
  }
}

//------------------------------------------------------------------------------
// Sizes are checked before anything of that size is allocated.
TEST(IOImageHeaders, MemoryFollowsChannelsAndTiles)
{
  const Folder folder;
  const double before = GetPeakMemory();
  // A tile of 1024 x 1024 texels is fine; of 64 channels of floats, it would take 268 MB.
  Spec spec(16, 16, 64, OIIO::TypeDesc::FLOAT);
  spec.tile_width = spec.tile_height = 64;
  WriteImage(folder("fine.tif"), spec, std::vector<float>(64 * 16 * 16, 0.5f));
  EXPECT_EQ(ReadTopFirst(folder("fine.tif")).Width, 16);
  std::string tiff = ReadBytes(folder("fine.tif"));
  const auto put = [&tiff](int tag, int value) // little-endian, SHORT or LONG
  {
    const std::uint32_t at = *reinterpret_cast<const std::uint32_t*>(tiff.data() + 4);
    const int count = *reinterpret_cast<const std::uint16_t*>(tiff.data() + at);
    for (int k = 0; k < count; ++k)
    {
      const std::size_t entry = at + 2 + 12 * static_cast<std::size_t>(k);
      if (*reinterpret_cast<const std::uint16_t*>(tiff.data() + entry) == tag)
      {
        Overwrite(tiff, entry + 8, static_cast<std::uint16_t>(value));
      }
    }
  };
  put(322, 1024); // TileWidth
  put(323, 1024); // TileLength
  ExpectImageBytesRefused(folder, tiff, { "tile size: found 1024 x 1024 with 64 channels" });

  // A JPEG file of 65500 x 65500, progressive: its reader would allocate 25 GB as it opens it.
  WriteImage(
    folder("a.jpg"), Spec(16, 16, 3, OIIO::TypeDesc::UINT8), std::vector<float>(3 * 256, 0.5f));
  std::string jpeg = ReadBytes(folder("a.jpg"));
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame, 2, "\xff\xc2");
  jpeg.replace(frame + 5, 4, "\xff\xdc\xff\xdc");
  ExpectImageBytesRefused(folder, jpeg, { "65500 x 65500" });

  // A bitmap of runs, which is decoded as it is opened.
  std::string bitmap =
    "BM" + std::string(52, '\0') + std::string(1024, '\0') + std::string(2, '\0');
  Overwrite(bitmap, 10, std::uint32_t(1078));
  Overwrite(bitmap, 14, std::uint32_t(40));
  Overwrite(bitmap, 18, std::int32_t(60000));
  Overwrite(bitmap, 22, std::int32_t(-60000));
  Overwrite(bitmap, 26, std::uint16_t(1));
  Overwrite(bitmap, 28, std::uint16_t(8));
  Overwrite(bitmap, 30, std::uint32_t(1));
  ExpectImageBytesRefused(folder, bitmap, { "60000 x 60000" });
  EXPECT_LT(GetPeakMemory() - before, 1e8);
}
