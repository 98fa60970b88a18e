// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkEnvironmentReader.
#include "TestIOHelpers.h"
#include "TestImages.h"

#include "vtkEnvironment.h"
#include "vtkEnvironmentReader.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cmath>
#include <limits>

#if !defined(_WIN32)
#include <unistd.h>
#endif

using namespace testio;

namespace
{
vtkSmartPointer<vtkEnvironment> ReadEnvironment(
  const std::string& path, std::string* notes = nullptr)
{
  vtkNew<vtkEnvironmentReader> reader;
  reader->SetFileName(path);
  EXPECT_TRUE(reader->Read()) << reader->GetErrorMessage();
  if (notes)
  {
    *notes = reader->GetNotes();
  }
  return reader->GetEnvironment();
}

void ExpectImageRefused(
  const Folder& folder, const std::string& path, const std::vector<std::string>& words)
{
  const std::string good = folder("good.exr");
  WriteImage(good, 2, 1, 3, std::vector<float>(6, 1.0f));
  vtkNew<vtkEnvironmentReader> reader;
  reader->SetFileName(good);
  ASSERT_TRUE(reader->Read());
  vtkEnvironment* before = reader->GetEnvironment();
  vtkNew<ErrorCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetFileName(path);
  EXPECT_FALSE(reader->Read());
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(reader->GetEnvironment(), before);
  const std::string message = reader->GetErrorMessage();
  EXPECT_NE(message.find(path), std::string::npos) << message;
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' in: " << message;
  }
}
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, PutsTheTopRowLast)
{
  const Folder folder;
  const std::vector<float> pixels = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17,
    18 };
  WriteImage(folder("a.exr"), 2, 3, 3, pixels);
  std::string notes;
  const auto environment = ReadEnvironment(folder("a.exr"), &notes);
  ASSERT_TRUE(environment);
  EXPECT_EQ(environment->GetName(), "a");
  EXPECT_EQ(environment->GetWidth(), 2);
  EXPECT_EQ(environment->GetHeight(), 3);
  EXPECT_EQ(environment->GetPixels(),
    (std::vector<float>{ 13, 14, 15, 16, 17, 18, 7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6 }));
  EXPECT_NE(notes.find("2:1"), std::string::npos);
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, ReadsChannelsOfAnyNumber)
{
  const Folder folder;
  WriteImage(folder("gray.exr"), 2, 1, 1, { 0.25f, 4.0f });
  std::string notes;
  EXPECT_EQ(ReadEnvironment(folder("gray.exr"), &notes)->GetPixels(),
    (std::vector<float>{ 0.25f, 0.25f, 0.25f, 4, 4, 4 }));
  EXPECT_NE(notes.find("gray"), std::string::npos);
  WriteImage(folder("alpha.exr"), 2, 1, 4, { 1, 2, 3, 0.5f, 4, 5, 6, 0 });
  EXPECT_EQ(ReadEnvironment(folder("alpha.exr"), &notes)->GetPixels(),
    (std::vector<float>{ 1, 2, 3, 4, 5, 6 }));
  EXPECT_EQ(notes, "");
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, DecodesIntegerFormats)
{
  const Folder folder;
  const std::vector<float> gray(6, 0.5f);
  std::string notes;
  // 0.5 is stored as 128/255 or 32768/65535; IEC 61966-2-1 decodes 128/255 to 0.215861.
  WriteImage(folder("a.png"), 2, 1, 3, gray, OIIO::TypeDesc::UINT8, "sRGB");
  EXPECT_NEAR(ReadEnvironment(folder("a.png"), &notes)->GetPixels()[0], 0.215861, 1e-4);
  EXPECT_NE(notes.find("sRGB"), std::string::npos);
  WriteImage(folder("b.png"), 2, 1, 3, gray, OIIO::TypeDesc::UINT16, "sRGB");
  EXPECT_NEAR(ReadEnvironment(folder("b.png"))->GetPixels()[0], 0.214041, 1e-4);
  // A half-float file is linear.
  WriteImage(folder("c.exr"), 2, 1, 3, gray, OIIO::TypeDesc::HALF);
  EXPECT_EQ(ReadEnvironment(folder("c.exr"), &notes)->GetPixels()[0], 0.5f);
  EXPECT_EQ(notes, "");
  // So are floats of which the file does not say it.
  WriteImage(folder("d.tif"), 2, 1, 3, gray, OIIO::TypeDesc::FLOAT, "sRGB");
  EXPECT_EQ(ReadEnvironment(folder("d.tif"), &notes)->GetPixels()[0], 0.5f);
  EXPECT_EQ(notes, "");
}

//------------------------------------------------------------------------------
// PNG keeps colors as they are where alpha covers less; alpha is no color, so it must not darken.
TEST(IOEnvironment, AlphaOfPngDoesNotDarken)
{
  const Folder folder;
  auto out = OIIO::ImageOutput::create(folder("a.png"));
  ASSERT_TRUE(out) << OIIO::geterror();
  OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1); // bytes are written as given
  ASSERT_TRUE(out->open(folder("a.png"), spec)) << out->geterror();
  const unsigned char bytes[8] = { 200, 100, 50, 64, 200, 100, 50, 255 };
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::UINT8, bytes)) << out->geterror();
  out->close();
  const auto environment = ReadEnvironment(folder("a.png"));
  ASSERT_TRUE(environment);
  const double expected[3] = { 0.577580, 0.127438, 0.031896 }; // IEC 61966-2-1 of the bytes
  for (std::size_t k = 0; k < 6; ++k)
  {
    EXPECT_NEAR(environment->GetPixels()[k], expected[k % 3], 1e-5) << k;
  }
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, ReadsRadianceFiles)
{
  const Folder folder;
  WriteImage(folder("a.hdr"), 16, 8, 3, std::vector<float>(16 * 8 * 3, 2048.0f));
  const auto environment = ReadEnvironment(folder("a.hdr"));
  ASSERT_TRUE(environment);
  EXPECT_EQ(environment->GetPixels()[0], 2048.0f);
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, ReadsOddBlackAndSingleTexelImages)
{
  const Folder folder;
  WriteImage(folder("one.exr"), 1, 1, 3, { 1, 2, 3 });
  EXPECT_EQ(ReadEnvironment(folder("one.exr"))->GetPixels(), (std::vector<float>{ 1, 2, 3 }));

  std::vector<float> pixels(7 * 5 * 3, 0.0f);
  WriteImage(folder("black.exr"), 7, 5, 3, pixels);
  auto environment = ReadEnvironment(folder("black.exr"));
  EXPECT_EQ(environment->GetPixels(), pixels);
  double total[3];
  environment->GetTotal(total);
  EXPECT_EQ(total[0], 0.0);

  pixels[3 * (7 * 1 + 6) + 1] = 222208.0f; // row 1 from the top, last column, green
  WriteImage(folder("sun.exr"), 7, 5, 3, pixels);
  environment = ReadEnvironment(folder("sun.exr"));
  double rgb[3];
  environment->GetPixel(6, 3, rgb);
  EXPECT_EQ(rgb[0], 0.0);
  EXPECT_EQ(rgb[1], 222208.0);
  environment->GetTotal(total);
  EXPECT_GT(total[1], 0.0);
  EXPECT_EQ(total[0], 0.0);
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, RepairsAndCounts)
{
  const Folder folder;
  WriteImage(folder("bad.exr"), 2, 1, 3,
    { -1.0f, std::numeric_limits<float>::quiet_NaN(), 3, std::numeric_limits<float>::infinity(),
      -2.0f, -3.0f });
  std::string notes;
  const auto environment = ReadEnvironment(folder("bad.exr"), &notes);
  EXPECT_EQ(environment->GetPixels(), (std::vector<float>{ 0, 0, 3, 65504, 0, 0 }));
  EXPECT_EQ(environment->GetNumberOfNegativeValues(), 3);
  EXPECT_EQ(environment->GetNumberOfNonFiniteValues(), 1);
  EXPECT_NE(notes.find("3 negative and 1 non-finite"), std::string::npos) << notes;
  EXPECT_NE(notes.find("1 value of +infinity was taken as 65504"), std::string::npos) << notes;
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, RefusesWhatIsNoImage)
{
  const Folder folder;
  ExpectImageRefused(folder, "", { "no file name" });
  ExpectImageRefused(folder, folder("missing.exr"), { "no such file" });
  ExpectImageRefused(folder, folder(""), { "directory" });
  WriteBytes(folder("empty.exr"), "");
  ExpectImageRefused(folder, folder("empty.exr"), { "empty" });
  for (const std::string name : { "words.exr", "words.hdr", "words.png", "words" })
  {
    WriteBytes(folder(name), "these are words, no image, whatever the name says\n");
    ExpectImageRefused(folder, folder(name), { "header" });
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
  for (const std::string extension : { ".exr", ".hdr" })
  {
    WriteImage(folder("whole" + extension), 32, 16, 3, pixels);
    const std::string bytes = ReadBytes(folder("whole" + extension));
    const std::string cut = folder("cut" + extension);
    for (std::size_t length = 1; length < bytes.size(); length += 1 + length / 16)
    {
      SCOPED_TRACE("cut to " + std::to_string(length) + " of " + std::to_string(bytes.size()));
      WriteBytes(cut, bytes.substr(0, length));
      ExpectImageRefused(folder, cut, { "image" });
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, RefusesSizesThatLie)
{
  const Folder folder;
  WriteImage(folder("whole.hdr"), 16, 8, 3, std::vector<float>(16 * 8 * 3, 1.0f));
  const std::string bytes = ReadBytes(folder("whole.hdr"));
  const std::string size = "-Y 8 +X 16\n";
  const std::size_t place = bytes.find(size);
  ASSERT_NE(place, std::string::npos);
  const std::vector<std::string> lies = { "-Y 2147483647 +X 2147483647\n", "-Y 65536 +X 65536\n",
    "-Y 16000 +X 16000\n", "-Y -8 +X 16\n", "-Y 0 +X 16\n", "-Y 8 +X -1\n" };
  for (const std::string& lie : lies)
  {
    SCOPED_TRACE(lie);
    std::string bad = bytes;
    bad.replace(place, size.size(), lie);
    WriteBytes(folder("lie.hdr"), bad);
    ExpectImageRefused(folder, folder("lie.hdr"), { "image" });
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
      WriteBytes(folder("lie.exr"), bad);
      ExpectImageRefused(folder, folder("lie.exr"), { "image" });
    }
  }
}

//------------------------------------------------------------------------------
// Headers whose size passes for the file's length, over data that end early.
TEST(IOEnvironment, MemoryFollowsTheData)
{
  const Folder folder;
  const double before = GetPeakMemory();
  const std::string noise(70000, '\x02');
  WriteBytes(folder("lie.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1400 +X 1400\n" + noise);
  ExpectImageRefused(folder, folder("lie.hdr"), { "image pixels: " });
  WriteBytes(folder("lie.pfm"), "PF\n1200 1200\n-1.0\n" + noise);
  ExpectImageRefused(folder, folder("lie.pfm"), { "image pixels: " });
  vtkNew<vtkEnvironmentReader> reader;
  vtkNew<ErrorCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetFileName(folder("lie.pfm"));
  EXPECT_FALSE(reader->Read());
  EXPECT_NE(reader->GetErrorMessage().substr(reader->GetErrorMessage().size() - 2), ": ");

  EXPECT_LT(GetPeakMemory() - before, 3e8);

  // Beyond what the formats can hold: refused by the header, by newer OpenImageIO in its own words.
  for (const std::string size : { "16000 16000", "8000 8000" })
  {
    WriteBytes(folder("lie.pfm"), "PF\n" + size + "\n-1.0\n" + noise);
    ExpectImageRefused(folder, folder("lie.pfm"), { "image " });
  }
  WriteBytes(folder("wide.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 65537\n" + noise);
  ExpectImageRefused(folder, folder("wide.hdr"), { "image " });

  WriteImage(folder("good.exr"), 2, 1, 3, std::vector<float>(6, 1.0f));
  std::string exr = ReadBytes(folder("good.exr"));
  const std::string name("compression\0compression\0", 24);
  ASSERT_NE(exr.find(name), std::string::npos);
  Overwrite(exr, exr.find(name) + name.size(), std::uint32_t(0x7fffffff));
  WriteBytes(folder("lie.exr"), exr);
  ExpectImageRefused(
    folder, folder("lie.exr"), { "attribute 'compression' at byte ", "2147483647" });
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
    const auto environment = ReadEnvironment(folder("a.exr"));
    ASSERT_TRUE(environment);
    const std::vector<float>& found = environment->GetPixels();
    ASSERT_EQ(found.size(), pixels.size());
    const std::ptrdiff_t row = 3 * width;
    for (int y = 0; y < height; ++y)
    {
      ASSERT_TRUE(std::equal(found.begin() + y * row, found.begin() + (y + 1) * row,
        pixels.begin() + (height - 1 - y) * row))
        << "row " << y;
    }
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
  // Faces of one color each: right left up down front back.
  const float colors[6][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 0 }, { 1, 0, 1 },
    { 0, 1, 1 } };
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
      std::vector<float> pixels;
      for (int k = 0; k < 16 * 16; ++k)
      {
        pixels.insert(pixels.end(), colors[face], colors[face] + 3);
      }
      std::string path = pattern;
      path.replace(path.find("%s"), 2, set[face]);
      WriteImage(path, 16, 16, 3, pixels);
    }
    const vtkSmartPointer<vtkEnvironment> environment = ReadEnvironment(pattern);
    ASSERT_TRUE(environment);
    for (int face = 0; face < 6; ++face)
    {
      double rgb[3];
      environment->GetRadiance(directions[face], rgb);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(rgb[c], colors[face][c], 1e-5) << set[face] << " " << c;
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, RefusesProbesThatDoNotFit)
{
  const Folder folder;
  const std::string path = folder("probe.exr");
  WriteImage(path, 40, 30, 3, std::vector<float>(3 * 40 * 30, 1.0f));
  vtkNew<vtkEnvironmentReader> reader;
  vtkNew<ErrorCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  for (const int projection : std::initializer_list<int>{ vtkEnvironmentReader::ANGULAR_MAP,
         vtkEnvironmentReader::MIRROR_BALL, vtkEnvironmentReader::CUBE_VERTICAL_CROSS,
         vtkEnvironmentReader::CUBE_HORIZONTAL_STRIP })
  {
    reader->SetFileName(path);
    reader->SetProjection(projection);
    EXPECT_FALSE(reader->Read());
    const std::string message = reader->GetErrorMessage();
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_NE(message.find("40 x 30"), std::string::npos) << message;
    EXPECT_FALSE(reader->GetEnvironment());
  }
  for (const int projection : { 99, -2 })
  {
    const int before = errors->Count;
    reader->SetProjection(projection);
    EXPECT_EQ(errors->Count, before + 1);
    EXPECT_EQ(reader->GetProjection(), vtkEnvironmentReader::CUBE_HORIZONTAL_STRIP);
  }
  // Faces: none there, one missing, one not square, one of another size.
  reader->SetProjection(vtkEnvironmentReader::AUTOMATIC);
  reader->SetFileName(folder("face_%s.exr"));
  const auto refused = [&](const std::string& word)
  {
    EXPECT_FALSE(reader->Read());
    EXPECT_NE(reader->GetErrorMessage().find(word), std::string::npos) << reader->GetErrorMessage();
  };
  const auto write = [&](const char* name, int width, int height)
  {
    WriteImage(folder(std::string("face_") + name + ".exr"), width, height, 3,
      std::vector<float>(3 * static_cast<std::size_t>(width * height), 1.0f));
  };
  refused("no file");
  for (const char* name : { "px", "nx", "py", "ny", "pz" })
  {
    write(name, 8, 8);
  }
  refused("face_nz.exr");
  write("nz", 8, 9);
  refused("8 x 9");
  write("nz", 9, 9);
  refused("9 x 9");
  EXPECT_EQ(errors->Count, 10);
}

//------------------------------------------------------------------------------
TEST(IOEnvironment, CountsWhatConvertedProbesHold)
{
  const Folder folder;
  const std::string path = folder("cross.exr");
  std::vector<float> pixels(3 * 40 * 30, 1.0f);
  pixels[3 * (40 * 15 + 15)] = -1.0f; // row 15 of 30: inside the middle faces
  pixels[3 * (40 * 15 + 16)] = std::numeric_limits<float>::quiet_NaN();
  WriteImage(path, 40, 30, 3, pixels);
  std::string notes;
  const vtkSmartPointer<vtkEnvironment> environment = ReadEnvironment(path, &notes);
  EXPECT_NE(notes.find("1 negative and 1 non-finite"), std::string::npos) << notes;
  EXPECT_NE(notes.find("cross"), std::string::npos) << notes;
  for (const float value : environment->GetPixels())
  {
    EXPECT_TRUE(std::isfinite(value) && value >= 0.0f);
  }
}
