// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkPhotographSetReader: lists, folders named as Bonn's and UTIA's are, and hostile ones. No file
// of either database was at hand: the names are written from UTIA's published description and from
// public programs that read UBO2003.

#include "ErrorCatcher.h"
#include "TestImages.h"

#include "vtkImageData.h"
#include "vtkPhotographSet.h"
#include "vtkPhotographSetReader.h"

#include <filesystem>

using namespace testio;

namespace
{
void WriteTwoRows(const std::string& path, int channels, const std::vector<float>& pixels,
  OIIO::TypeDesc type, const std::string& space = "")
{
  const int width = static_cast<int>(pixels.size()) / channels / 2;
  WriteImage(path, width, 2, channels, pixels, type, space);
}

const std::vector<float> SixPixels = { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0.2f, 0.4f,
  0.6f };

/// The error of a list; "" where it is read.
std::string ReadList(const std::string& path)
{
  vtkNew<vtkPhotographSetReader> reader;
  ErrorCatcher errors(reader);
  reader->SetFileName(path);
  const bool read = reader->Read();
  EXPECT_EQ(errors.Take(), read ? 0 : 1);
  EXPECT_EQ(reader->GetErrorMessage().empty(), read);
  EXPECT_EQ(reader->GetPhotographs() != nullptr, read);
  return reader->GetErrorMessage();
}

void ExpectDirection(const double direction[3], double theta, double phi)
{
  double expected[3];
  vtkPhotographSet::GetDirection(theta, phi, expected);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(direction[c], expected[c], 1e-12);
  }
}

const char* const GoodList = R"({"irradiance": 2, "transfer": "power", "gamma": 1.8,
  "saturation": 0.9, "black": 0.01, "levels_for_floats": true, "comment": "x", "photographs": [
  {"file": "a.exr", "light": {"theta": 15, "phi": 30}, "view": [0, 3, 3], "exposure": 0.5},
  {"file": "a.exr", "light": {"theta": 0}, "view": {"theta": 89, "phi": -90}}]})";
}

//------------------------------------------------------------------------------
TEST(IOPhotographs, ReadsLists)
{
  const Folder folder;
  WriteTwoRows(folder("a.exr"), 3, SixPixels, OIIO::TypeDesc::FLOAT);
  WriteBytes(folder("list.json"), GoodList);
  vtkNew<vtkPhotographSetReader> reader;
  reader->SetFileName(folder("list.json"));
  ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
  vtkPhotographSet* set = reader->GetPhotographs();
  ASSERT_EQ(set->GetNumberOfPhotographs(), 2);
  double direction[3];
  set->GetLight(0, direction);
  ExpectDirection(direction, 15.0, 30.0);
  set->GetView(0, direction);
  ExpectDirection(direction, 45.0, 90.0);
  set->GetView(1, direction);
  ExpectDirection(direction, 89.0, 270.0);
  EXPECT_EQ(set->GetExposure(0), 0.5);
  EXPECT_EQ(set->GetExposure(1), 1.0);
  EXPECT_EQ(set->GetIrradiance(), 2.0);
  EXPECT_EQ(set->GetTransfer(), vtkPhotographSet::POWER);
  EXPECT_EQ(set->GetGamma(), 1.8);
  EXPECT_EQ(set->GetSaturationLevel(), 0.9);
  EXPECT_EQ(set->GetBlackLevel(), 0.01);
  EXPECT_TRUE(set->GetLevelsForFloats());
  const auto picture = vtkSmartPointer<vtkImageData>::Take(set->NewPicture(1));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->GetScalarType(), VTK_FLOAT);
  EXPECT_EQ(picture->GetScalarComponentAsDouble(0, 1, 0, 0), 1.0); // the top row is the last
  EXPECT_FLOAT_EQ(static_cast<float>(picture->GetScalarComponentAsDouble(2, 0, 0, 1)), 0.4f);
}

//------------------------------------------------------------------------------
TEST(IOPhotographs, ReadsFoldersNamedAsBonnNamesThem)
{
  const Folder folder;
  std::filesystem::create_directories(folder("tv045_pv060"));
  const auto byte = OIIO::TypeDesc::UINT8;
  WriteTwoRows(folder("tv045_pv060/00007 tl015 pl030 tv045 pv060.png"), 3, SixPixels, byte);
  WriteTwoRows(folder("tl000_pl000_tv000_pv000.png"), 3, SixPixels, byte);
  WriteTwoRows(folder("CORDUROY_TL075_PL345_TV060_PV-18.png"), 3, SixPixels, byte);
  WriteBytes(folder("readme.txt"), "hello");
  WriteBytes(folder("tl015_pl030_tv045.png"), "no pv");
  vtkNew<vtkPhotographSetReader> reader;
  reader->SetFileName(folder.GetPath().string());
  ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
  EXPECT_EQ(reader->GetNumberOfIgnoredFiles(), 2);
  vtkPhotographSet* set = reader->GetPhotographs();
  ASSERT_EQ(set->GetNumberOfPhotographs(), 3); // in the order of their paths
  double direction[3];
  set->GetLight(0, direction);
  ExpectDirection(direction, 75.0, 345.0);
  set->GetView(0, direction);
  ExpectDirection(direction, 60.0, 342.0);
  set->GetLight(2, direction);
  ExpectDirection(direction, 15.0, 30.0);
  set->GetView(2, direction);
  ExpectDirection(direction, 45.0, 60.0);
  const auto picture = vtkSmartPointer<vtkImageData>::Take(set->NewPicture(2));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->GetScalarType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(picture->GetScalarComponentAsDouble(0, 1, 0, 0), 255.0);

  WriteBytes(folder("tl090_pl000_tv000_pv000.png"), "x");
  EXPECT_NE(ReadList(folder.GetPath().string()).find("a polar angle of 90"), std::string::npos);
}

//------------------------------------------------------------------------------
TEST(IOPhotographs, RefusesHostileLists)
{
  const Folder folder;
  WriteTwoRows(folder("a.exr"), 3, SixPixels, OIIO::TypeDesc::FLOAT);
  const std::string entry = R"({"file": "a.exr", "light": [0, 0, 1], "view": [0, 0, 1]})";
  const auto list = [&](const std::string& photographs)
  { return R"({"photographs": [)" + photographs + "]}"; };
  const auto with = [](std::string text, const std::string& from, const std::string& to)
  { return text.replace(text.find(from), from.size(), to); };
  const std::pair<std::string, std::string> cases[] = {
    { "", "" },
    { "{", "JSON" },
    { "{}", "array named 'photographs'" },
    { R"({"photographs": 3})", "array named 'photographs'" },
    { list(""), "found 0 photographs" },
    { list("3"), "photograph 0: expected an object" },
    { list(entry + "," + with(entry, "a.exr", "b.exr")), "b.exr" },
    { list(with(entry, "a.exr", "")), "photograph 0: file: found ''" },
    { list(with(entry, "a.exr", "a\\u0000.exr")), "photograph 0: file: found" },
    { list(with(entry, "[0, 0, 1]", "[0, 1, 0]")), "photograph 0: light: found (0, 1, 0)" },
    { list(with(entry, "[0, 0, 1]", "[0, 0]")), "light: expected three numbers" },
    { list(with(entry, "[0, 0, 1]", "[0, 0, \"1\"]")), "light: expected three numbers" },
    { list(with(entry, "[0, 0, 1]", "[0, 0, 1e999]")), "" },
    { list(with(entry, "[0, 0, 1]", "{\"theta\": 90}")), "light: found a polar angle of 90" },
    { list(with(entry, "[0, 0, 1]", "{\"teta\": 90}")), "found the key 'teta'" },
    { list(with(entry, "\"view\"", "\"exposure\": 0, \"view\"")), "exposure: found 0" },
    { list(with(entry, "\"view\"", "\"vieux\"")), "found the key 'vieux'" },
    { with(list(entry), "{", "{\"transfer\": \"rec709\","), "transfer: expected automatic" },
    { with(list(entry), "{", "{\"irradiance\": -1,"), "irradiance > 0" },
    { with(list(entry), "{", "{\"gamma\": null,"), "gamma: expected a finite number" },
    { with(list(entry), "{", "{\"levels_for_floats\": 1,"), "expected true or false" },
    { std::string(100000, '['), "" },
  };
  for (const auto& bad : cases)
  {
    WriteBytes(folder("list"), bad.first);
    const std::string said = ReadList(folder("list"));
    EXPECT_NE(said.find(folder.GetPath().string()), std::string::npos)
      << bad.first.substr(0, 200) << "\n"
      << said;
    EXPECT_NE(said.find(bad.second), std::string::npos) << bad.first.substr(0, 200) << "\n" << said;
  }
  EXPECT_FALSE(ReadList(folder("absent")).empty());
  std::filesystem::create_directories(folder("empty"));
  EXPECT_NE(ReadList(folder("empty")).find("found 0 files"), std::string::npos);
}

//------------------------------------------------------------------------------
// Files are read when they are asked for: the error comes then, and names them.
TEST(IOPhotographs, NamesAFileThatIsNoImage)
{
  const Folder folder;
  WriteBytes(folder("a.png"), "no image");
  WriteBytes(folder("list.json"), Replace(Replace(GoodList, "a.exr", "a.png"), "a.exr", "b.tif"));
  WriteTwoRows(folder("b.tif"), 3, SixPixels, OIIO::TypeDesc::UINT16, "linear");
  vtkNew<vtkPhotographSetReader> reader;
  reader->SetFileName(folder("list.json"));
  ASSERT_TRUE(reader->Read());
  ErrorCatcher errors(reader->GetPhotographs());
  EXPECT_EQ(reader->GetPhotographs()->NewPicture(0), nullptr);
  EXPECT_NE(errors.GetText().find("a.png"), std::string::npos);
  EXPECT_EQ(reader->GetPhotographs()->NewPicture(2), nullptr);
  EXPECT_EQ(errors.Take(), 2);
}
