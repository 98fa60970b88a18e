// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkEnvironmentReader: values, probes, and what is no image.
#include "TestImages.h"

#include <cmath>
#include <limits>

#if !defined(_WIN32)
#include <unistd.h>
#endif

using namespace testio;

//------------------------------------------------------------------------------
TEST(IOEnvironment, PutsTheTopRowLast)
{
  const Folder folder;
  WriteImage(
    folder("a.exr"), 2, 3, 3, { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18 });
  const auto reader = ReadProbe(folder("a.exr"));
  vtkEnvironment* environment = reader->GetEnvironment();
  EXPECT_EQ(environment->GetName(), "a");
  EXPECT_EQ(environment->GetWidth(), 2);
  EXPECT_EQ(environment->GetHeight(), 3);
  EXPECT_EQ(environment->GetPixels(),
    (std::vector<float>{ 13, 14, 15, 16, 17, 18, 7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6 }));
  EXPECT_NE(reader->GetNotes().find("2:1"), std::string::npos);
}

//------------------------------------------------------------------------------
// Integers are decoded by IEC 61966-2-1, floats are linear whatever the file says; one channel is
// gray, and alpha is no color: it must not darken.
TEST(IOEnvironment, DecodesEveryFormat)
{
  const Folder folder;
  using Type = OIIO::TypeDesc;
  const std::vector<float> gray(6, 0.5f);
  const float r = 200.0f / 255.0f, g = 100.0f / 255.0f, b = 50.0f / 255.0f;
  const struct
  {
    const char* Name;
    int Channels;
    OIIO::TypeDesc Type;
    std::vector<float> Pixels; // two
    std::vector<double> Expected;
    const char* Note;
  } cases[] = {
    { "gray.exr", 1, Type::FLOAT, { 0.25f, 4 }, { 0.25, 0.25, 0.25, 4, 4, 4 }, "gray" },
    { "alpha.exr", 4, Type::FLOAT, { 1, 2, 3, 0.5f, 4, 5, 6, 0 }, { 1, 2, 3, 4, 5, 6 }, "" },
    { "sun.exr", 3, Type::FLOAT, { 0, 0, 0, 0, 222208, 0 }, { 0, 0, 0, 0, 222208, 0 }, "" },
    { "8.png", 3, Type::UINT8, gray, std::vector<double>(6, 0.215861), "sRGB" },
    { "16.png", 3, Type::UINT16, gray, std::vector<double>(6, 0.214041), "sRGB" },
    { "half.exr", 3, Type::HALF, gray, std::vector<double>(6, 0.5), "" },
    { "float.tif", 3, Type::FLOAT, gray, std::vector<double>(6, 0.5), "" },
    { "16.tif", 1, Type::UINT16, { 0.5f, 1 }, { 0.214041, 0.214041, 0.214041, 1, 1, 1 }, "sRGB" },
    { "a.jpg", 3, Type::UINT8, gray, std::vector<double>(6, 0.215861), "sRGB" },
    { "a.hdr", 3, Type::FLOAT, std::vector<float>(6, 2048), std::vector<double>(6, 2048), "" },
    { "alpha.png", 4, Type::UINT8, { r, g, b, 0.25f, r, g, b, 1 },
      { 0.577580, 0.127438, 0.031896, 0.577580, 0.127438, 0.031896 }, "sRGB" },
  };
  for (const auto& one : cases)
  {
    OIIO::ImageSpec spec(2, 1, one.Channels, one.Type);
    spec.attribute("oiio:UnassociatedAlpha", 1); // values are written as given
    if (one.Type != Type::HALF)
    {
      spec.attribute("oiio:ColorSpace", "sRGB");
    }
    WriteImage(folder(one.Name), spec, one.Pixels);
    const FoundImage found = ReadTopFirst(folder(one.Name));
    ExpectValues(found, one.Expected, 2e-5, one.Name);
    EXPECT_EQ(found.Notes.empty(), one.Note[0] == 0) << found.Notes;
    EXPECT_NE(found.Notes.find(one.Note), std::string::npos) << found.Notes;
  }
}

//------------------------------------------------------------------------------
// A PNG file whose gAMA says so is linear.
TEST(IOEnvironment, IntegersMayBeLinear)
{
  const Folder folder;
  for (const auto type : { OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT16 })
  {
    WriteImage(folder("a.png"), 2, 1, 3, std::vector<float>(6, 0.2f), type, "linear");
    ExpectValues(ReadTopFirst(folder("a.png")), std::vector<double>(6, 0.2), 1e-5);
  }
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, ReadsBlackAndSingleTexelImages)
{
  const Folder folder;
  WriteImage(folder("one.exr"), 1, 1, 3, { 1, 2, 3 });
  ExpectValues(ReadTopFirst(folder("one.exr")), { 1, 2, 3 });
  WriteImage(folder("black.exr"), 7, 5, 3, std::vector<float>(7 * 5 * 3, 0.0f));
  double total[3];
  ReadProbe(folder("black.exr"))->GetEnvironment()->GetTotal(total);
  EXPECT_EQ(total[0], 0.0);
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, RepairsAndCounts)
{
  const Folder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  WriteImage(folder("bad.exr"), 2, 1, 3, { -1.0f, nan, 3, infinity, -2.0f, -3.0f });
  const auto reader = ReadProbe(folder("bad.exr"));
  EXPECT_EQ(reader->GetEnvironment()->GetNumberOfNegativeValues(), 3);
  EXPECT_EQ(reader->GetEnvironment()->GetNumberOfNonFiniteValues(), 1);
  FoundImage found = ReadTopFirst(folder("bad.exr"));
  ExpectValues(found, { 0, 0, 3, 65504, 0, 0 });
  EXPECT_NE(found.Notes.find("3 negative and 1 non-finite"), std::string::npos) << found.Notes;
  EXPECT_NE(found.Notes.find("1 value of +infinity was taken as 65504"), std::string::npos);
  // The largest half float stands for what is too large; in a file of floats, the largest value.
  WriteImage(
    folder("sun.exr"), 2, 1, 3, { 3e5f, infinity, 1, 2, -infinity, nan }, OIIO::TypeDesc::HALF);
  found = ReadTopFirst(folder("sun.exr"));
  ExpectValues(found, { 65504, 65504, 1, 2, 0, 0 });
  EXPECT_NE(found.Notes.find("2 values of +infinity were taken as 65504"), std::string::npos);
  WriteImage(folder("float.exr"), 1, 1, 3, { infinity, 1.0f, 3e6f });
  ExpectValues(ReadTopFirst(folder("float.exr")), { 3e6, 1, 3e6 });
  WriteImage(folder("gray.exr"), 2, 1, 1, { infinity, 1.0f });
  EXPECT_NE(ReadTopFirst(folder("gray.exr")).Notes.find("1 value of"), std::string::npos);
  // Probes that are converted count, too.
  std::vector<float> pixels(3 * 40 * 30, 1.0f);
  pixels[3 * (40 * 15 + 15)] = -1.0f; // row 15 of 30: inside the middle faces
  pixels[3 * (40 * 15 + 16)] = nan;
  WriteImage(folder("cross.exr"), 40, 30, 3, pixels);
  found = ReadTopFirst(folder("cross.exr"));
  EXPECT_NE(found.Notes.find("1 negative and 1 non-finite"), std::string::npos) << found.Notes;
  EXPECT_NE(found.Notes.find("cross"), std::string::npos) << found.Notes;
  for (const double value : found.Values)
  {
    EXPECT_TRUE(std::isfinite(value) && value >= 0.0);
  }
}

//------------------------------------------------------------------------------
// Only formats of the list reach a library, by their content.
TEST(IOEnvironment, RefusesWhatIsNoImage)
{
  const Folder folder;
  ExpectImageRefused(folder, "", { "no file name" });
  ExpectImageRefused(folder, folder("missing.exr"), { "no such file" });
  ExpectImageRefused(folder, folder(""), { "directory" });
  ExpectImageBytesRefused(folder, "", { "empty" });
  const std::string others[] = { "these are words, no image, whatever the name says\n",
    std::string("FOR4\0\0\0\x70"
                "CIMGTBHD",
      16),
    "SDPX" + std::string(60, '\0'), "8BPS" + std::string(60, '\0'),
    "GIF89a" + std::string(60, '\0'), "RIFF1234WEBPVP8 ", "qoif" + std::string(20, '\0'),
    "\x01\xda" + std::string(60, '\0'), "version https://git-lfs.github.com/spec/v1\n", "P7\n", "#",
    "\xff" };
  for (const std::string& bytes : others)
  {
    for (const char* name : { "a.exr", "a.hdr", "a.png", "a" })
    {
      ExpectImageRefused(folder, WriteBytes(folder(name), bytes),
        { "OpenEXR, Radiance HDR, PNG, JPEG, TIFF, BMP, PNM or PFM" });
    }
  }
#if !defined(_WIN32)
  if (geteuid() == 0)
  {
    GTEST_SKIP() << "root may read everything; the rest passed";
  }
  WriteImage(folder("secret.exr"), 1, 1, 3, { 1, 2, 3 });
  std::filesystem::permissions(folder("secret.exr"), std::filesystem::perms::none);
  ExpectImageRefused(folder, folder("secret.exr"), { "cannot be opened" });
#endif
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, RefusesTruncatedImages)
{
  const Folder folder;
  std::vector<float> pixels(32 * 16 * 3);
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    pixels[k] = 0.1f + 0.01f * float(k * 7 % 131);
  }
  std::vector<std::string> names = { "whole.exr", "whole.hdr" };
  if (ReadsByVTK) // OpenImageIO takes rows that a TIFF file lacks as black
  {
    names.insert(names.end(), { "whole.png", "whole.tif" });
  }
  for (const std::string& name : names)
  {
    WriteImage(folder(name), 32, 16, 3, pixels);
    const std::string bytes = ReadBytes(folder(name));
    for (std::size_t length = 1; length < bytes.size(); length += 1 + length / 16)
    {
      SCOPED_TRACE(name + " cut to " + std::to_string(length));
      ExpectImageBytesRefused(folder, bytes.substr(0, length), { "image" });
    }
  }
}

//------------------------------------------------------------------------------
// Headers whose size is a lie, or passes for the file's length over data that end early: refused in
// little memory.
TEST(IOEnvironment, MemoryFollowsTheData)
{
  const Folder folder;
  const double before = GetPeakMemory();
  const std::string noise(70000, '\x02');
  const std::string radiance = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  ExpectImageBytesRefused(folder, radiance + "-Y 1400 +X 1400\n" + noise, { "image, scanline" });
  ExpectImageBytesRefused(folder, "PF\n1200 1200\n-1.0\n" + noise,
    { ReadsByVTK ? "PNM or PFM files are read by OpenImageIO" : "image pixels: " });
  vtkNew<vtkEnvironmentReader> reader; // it says something behind the colon
  ExpectReadFails(reader.Get(), folder("bad.image"), {});
  EXPECT_NE(reader->GetErrorMessage().substr(reader->GetErrorMessage().size() - 2), ": ");
  // Beyond what the formats can hold: refused by the header, by newer OpenImageIO in its own words.
  for (const std::string size : { "-Y 2147483647 +X 2147483647", "-Y 65536 +X 65536",
         "-Y 16000 +X 16000", "-Y -8 +X 16", "-Y 0 +X 16", "-Y 8 +X -1", "-Y 1 +X 65537" })
  {
    SCOPED_TRACE(size);
    ExpectImageBytesRefused(folder, radiance + size + "\n" + noise, { ": image" });
  }
  for (const std::string size : { "16000 16000", "8000 8000" })
  {
    ExpectImageBytesRefused(
      folder, "PF\n" + size + "\n-1.0\n" + noise, { ReadsByVTK ? "OpenImageIO" : "image " });
  }
  WriteImage(folder("whole.exr"), 16, 8, 3, std::vector<float>(16 * 8 * 3, 1.0f));
  const std::string exr = ReadBytes(folder("whole.exr"));
  const std::string name("dataWindow\0box2i\0", 17);
  const std::size_t window = exr.find(name) + name.size() + 4;
  for (const std::int32_t lie : { -1, 1 << 20, 1 << 30, std::numeric_limits<std::int32_t>::max() })
  {
    for (const std::size_t corner : { 8, 12 })
    {
      SCOPED_TRACE(lie);
      std::string bad = exr;
      Overwrite(bad, window + corner, lie);
      ExpectImageBytesRefused(folder, bad, { "image" });
    }
  }
  std::string bad = exr;
  const std::string compression("compression\0compression\0", 24);
  Overwrite(bad, bad.find(compression) + compression.size(), std::uint32_t(0x7fffffff));
  ExpectImageBytesRefused(folder, bad, { "attribute 'compression' at byte ", "2147483647" });
  EXPECT_LT(GetPeakMemory() - before, 3e8);
}

//------------------------------------------------------------------------------
// More than one block; scanlines and tiles that do not divide the size.
TEST(IOEnvironment, ReadsInBlocks)
{
  const Folder folder;
  const int width = 1500;
  const int height = 1501;
  std::vector<float> pixels(std::size_t(width) * height * 3);
  for (std::size_t k = 0; k < pixels.size(); ++k)
  {
    pixels[k] = float(k % 65521);
  }
  for (const int tile : { 0, 64 })
  {
    SCOPED_TRACE(tile);
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = tile;
    spec.x = spec.full_x = 5; // the windows' corner
    spec.y = spec.full_y = -7;
    spec.attribute("compression", "none");
    WriteImage(folder("a.exr"), spec, pixels);
    const FoundImage found = ReadTopFirst(folder("a.exr"));
    ASSERT_EQ(found.Values.size(), pixels.size());
    EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), found.Values.begin()));
  }
}

//------------------------------------------------------------------------------
// A bright square where the projection shows a direction lights that direction.
TEST(IOEnvironment, ReadsProbesOfEveryProjection)
{
  const Folder folder;
  using Reader = vtkEnvironmentReader;
  const struct
  {
    int Projection, Width, Height;
    double U, V, Direction[3];
  } cases[] = { { Reader::ANGULAR_MAP, 128, 128, 0.75, 0.5, { 1, 0, 0 } },
    { Reader::MIRROR_BALL, 128, 128, 0.5, 0.5 + std::sqrt(0.125), { 0, 1, 0 } },
    { Reader::CUBE_HORIZONTAL_CROSS, 128, 96, 0.125, 0.5, { -1, 0, 0 } },
    { Reader::CUBE_VERTICAL_CROSS, 96, 128, 0.5, 0.125, { 0, 0, 1 } },
    { Reader::CUBE_HORIZONTAL_STRIP, 192, 32, 2.5 / 6.0, 0.5, { 0, 1, 0 } },
    { Reader::CUBE_VERTICAL_STRIP, 32, 192, 0.5, 0.5 / 6.0, { 0, 0, 1 } } };
  for (const auto& c : cases)
  {
    SCOPED_TRACE(c.Projection);
    std::vector<float> pixels;
    for (int k = 0; k < c.Width * c.Height; ++k) // files begin with the top row
    {
      const bool bright = std::abs(k % c.Width + 0.5 - c.U * c.Width) < 4.0 &&
                          std::abs(k / c.Width + 0.5 - (1.0 - c.V) * c.Height) < 4.0;
      pixels.insert(pixels.end(), 3, bright ? 1.0f : 0.0f);
    }
    WriteImage(folder("probe.exr"), c.Width, c.Height, 3, pixels);
    for (const bool automatic : { false, true })
    {
      vtkNew<vtkEnvironmentReader> reader;
      reader->SetFileName(folder("probe.exr"));
      reader->SetProjection(automatic ? int(Reader::AUTOMATIC) : c.Projection);
      ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
      if (automatic && c.Width == c.Height) // lat-long, and a note
      {
        EXPECT_NE(reader->GetNotes().find("mirror ball"), std::string::npos);
        continue;
      }
      double seen[3];
      reader->GetEnvironment()->GetRadiance(c.Direction, seen);
      EXPECT_NEAR(seen[1], 1.0, 0.02); // small bright areas keep their light, at points' accuracy
      const double opposite[3] = { -c.Direction[0], -c.Direction[1], -c.Direction[2] };
      reader->GetEnvironment()->GetRadiance(opposite, seen);
      EXPECT_EQ(seen[1], 0.0);
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, ReadsSixFaces)
{
  const Folder folder;
  // OpenGL's cubes are left-handed: +z is what is in front (-z).
  const double directions[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 },
    { 0, 0, -1 }, { 0, 0, 1 } };
  const char* const names[2][6] = { { "px", "nx", "py", "ny", "pz", "nz" },
    { "right", "left", "top", "bottom", "front", "back" } };
  for (const auto& set : names)
  {
    const std::string pattern = folder(std::string("cube_") + set[0] + "_%s.exr");
    for (int face = 0; face < 6; ++face)
    {
      WriteImage(Replace(pattern, "%s", set[face]), 16, 16, 3,
        std::vector<float>(3 * 16 * 16, float(face + 1)));
    }
    const auto reader = ReadProbe(pattern);
    for (int face = 0; face < 6; ++face)
    {
      double rgb[3];
      reader->GetEnvironment()->GetRadiance(directions[face], rgb);
      EXPECT_NEAR(rgb[1], face + 1.0, 1e-5) << set[face];
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, RefusesProbesThatDoNotFit)
{
  const Folder folder;
  const auto write = [&](const std::string& name, int width, int height)
  {
    WriteImage(folder(name), width, height, 3,
      std::vector<float>(3 * static_cast<std::size_t>(width * height), 1.0f));
  };
  write("probe.exr", 40, 30);
  using Reader = vtkEnvironmentReader;
  vtkNew<Reader> reader;
  for (const int projection : std::initializer_list<int>{ Reader::ANGULAR_MAP, Reader::MIRROR_BALL,
         Reader::CUBE_VERTICAL_CROSS, Reader::CUBE_HORIZONTAL_STRIP })
  {
    reader->SetProjection(projection);
    ExpectReadFails(reader.Get(), folder("probe.exr"), { "40 x 30" });
    EXPECT_FALSE(reader->GetEnvironment());
  }
  // Faces: none there, one missing, one not square, one of another size.
  reader->SetProjection(Reader::AUTOMATIC);
  const std::string pattern = folder("face_%s.exr");
  ExpectReadFails(reader.Get(), pattern, { "no file" });
  for (const char* name : { "px", "nx", "py", "ny", "pz" })
  {
    write(std::string("face_") + name + ".exr", 8, 8);
  }
  reader->SetFileName(pattern);
  vtkNew<ErrorCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  for (const auto& [height, word] :
    { std::pair<int, const char*>{ 0, "face_nz.exr" }, { 8, "9 x 8" }, { 9, "9 x 9" } })
  {
    if (height > 0)
    {
      write("face_nz.exr", 9, height);
    }
    EXPECT_FALSE(reader->Read());
    EXPECT_NE(reader->GetErrorMessage().find(word), std::string::npos) << reader->GetErrorMessage();
  }
  EXPECT_EQ(errors->Count, 3);
}
