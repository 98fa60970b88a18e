// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// OpenMATERIAL 3D: tables of a formula, and the measured asphalt where it is at hand.

#include "AngleFormula.h"
#include "HalfVector.h"
#include "SmallOpenMaterial.h"
#include "SpectraForTests.h"
#include "TestIOHelpers.h"

#include "vtkAngularTableBRDF.h"

#include <charconv>
#include <numeric>

namespace
{
using namespace testio;

const std::string OpenMaterialFormat = "OpenMATERIAL 3D";

std::vector<double> Count(double first, double step, int count)
{
  std::vector<double> numbers;
  for (int k = 0; k < count; ++k)
  {
    numbers.push_back(first + step * k);
  }
  return numbers;
}

const double Gray[3] = { 1.0, 1.0, 1.0 };

vtkSmartPointer<vtkBRDFReader> ReadBytesOf(const Folder& folder, const std::string& bytes)
{
  return ReadFile(WriteBytes(folder("road.xompt"), bytes));
}

// f = the shape, times the wavelength in micrometers.
double ShapeAt(double l, double i, double o, double p) { return l / 1000.0 * Shape(i, o, p); }

//------------------------------------------------------------------------------
TEST(IOOpenMaterial, InterpolatesBetweenUnevenAngles)
{
  const Folder folder;
  const auto value = [](double, double i, double o, double p) { return Shape(i, o, p); };
  // A half turn is mirrored; a whole one is taken as it is, its end once.
  for (const std::vector<double>& phi :
    { std::vector<double>{ 0.0, 30.0, 100.0, 180.0 }, Count(0.0, 45.0, 9) })
  {
    const auto reader =
      ReadBytesOf(folder, MakeOpenMaterial({ 400.0, 555.5, 700.0 }, { 0.0, 10.0, 45.0, 90.0 },
                            { 0.0, 5.0, 60.0, 90.0 }, phi, value));
    EXPECT_EQ(reader->GetFormatName(), OpenMaterialFormat);
    EXPECT_EQ(reader->GetBRDF()->GetName(), "road");
    EXPECT_NE(reader->GetBRDF()->GetSource().find("CC0-1.0"), std::string::npos);
    ExpectNote(reader, "mirrored", phi.back() == 180.0);
    ExpectNote(reader, "missing", false);
    ExpectFormula(reader->GetBRDF(), Gray, 2e-6);
    const auto copy = vtkSmartPointer<vtkBRDF>::Take(reader->GetBRDF()->NewSnapshot());
    EXPECT_TRUE(reader->GetBRDF()->IsIsotropic() && copy->IsIsotropic());
    ExpectSameValues(reader->GetBRDF(), copy);
  }
}

//------------------------------------------------------------------------------
// A material that is not symmetric about the plane of incidence.
TEST(IOOpenMaterial, AzimuthsRunAboutTheNormal)
{
  const Folder folder;
  const auto value = [](double, double i, double o, double p) { return 0.1 + i * o * p * 1e-7; };
  const auto reader = ReadBytesOf(folder,
    MakeOpenMaterial({ 905.0 }, { 0.0, 90.0 }, { 0.0, 90.0 }, { 0.0, 90.0, 180.0, 270.0 }, value));
  for (const double light : { 0.0, 77.0, 200.0, 359.0 })
  {
    for (const double azimuth : { 45.0, 90.0, 135.0, 270.0 })
    {
      const glm::dvec3 f = EvaluateAt(reader->GetBRDF(), 50.0, light, 70.0, light + azimuth);
      EXPECT_NEAR(f[0], value(905.0, 50.0, 70.0, azimuth), 1e-6) << light << " " << azimuth;
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOOpenMaterial, OneWavelengthIsGray)
{
  const Folder folder;
  const auto reader = ReadBytesOf(folder,
    MakeOpenMaterial({ 905.0, 1550.0 }, { 0.0, 90.0 }, { 0.0, 90.0 }, { 0.0, 180.0 }, ShapeAt));
  const double first[3] = { 0.905, 0.905, 0.905 };
  ExpectFormula(reader->GetBRDF(), first, 2e-6);
  ExpectNote(reader, "Gray, of the wavelength 905nm");
  EXPECT_EQ(reader->GetMaterialNames(), (std::vector<std::string>{ "905nm", "1550nm" }));
  const double second[3] = { 1.55, 1.55, 1.55 };
  ExpectFormula(Read(folder("road.xompt#1550nm")), second, 2e-6);
  ExpectRefused(
    folder, folder("road.xompt#550nm"), { OpenMaterialFormat, "'550nm'", "905nm, 1550nm" });
}

//------------------------------------------------------------------------------
// Views on the normal have one azimuth, as goniometers list them; one row in seven is missing; and
// what was measured ends at 60 degrees.
TEST(IOOpenMaterial, HolesAreFilledAndReported)
{
  const Folder folder;
  const std::vector<double> nodes = Count(0.0, 10.0, 7);
  std::string rows;
  int k = 0;
  for (const double i : nodes)
  {
    for (const double o : nodes)
    {
      for (const double p : o == 0.0 ? std::vector<double>{ 0.0 } : Count(0.0, 20.0, 10))
      {
        if (std::fmod(p, 180.0) == 0.0 || ++k % 7 != 3) // where the formula has no kink
        {
          rows += (rows.empty() ? "" : ",") + MakeOpenMaterialRow(905.0, i, o, p, Shape(i, o, p));
        }
      }
    }
  }
  rows += ",[9.05e-7, 0.1, 0.1, 0.1, null]";
  const auto reader = ReadBytesOf(folder, MakeOpenMaterialFile("9.05e-7", rows));
  for (const char* part : { "values are missing in the grid", "1 rows hold a null", "mirrored",
         "light at 0 to 60 and views at 0 to 60" })
  {
    ExpectNote(reader, part);
  }
  ExpectFormula(reader->GetBRDF(), Gray, 2e-6, 60.0); // holes lie on lines: exact again
  const glm::dvec3 f = EvaluateAt(reader->GetBRDF(), 80.0, 10.0, 85.0, 40.0);
  EXPECT_NEAR(f[0], Shape(60.0, 60.0, 30.0), 2e-6); // constant beyond
}

//------------------------------------------------------------------------------
TEST(IOOpenMaterial, ScatteredViewsAreInterpolated)
{
  const Folder folder;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  std::string rows;
  for (const double i : { 0.0, 30.0, 60.0, 85.0 })
  {
    for (int k = 0; k < 600; ++k)
    {
      const double o = measuredbrdf::ToDegrees(std::acos(number(random)));
      const double p = 360.0 * number(random);
      rows += (rows.empty() ? "" : ",") + MakeOpenMaterialRow(905.0, i, o, p, Shape(i, o, p));
    }
  }
  const auto reader = ReadBytesOf(folder, MakeOpenMaterialFile("9.05e-7", rows));
  const std::string notes = reader->GetNotes();
  EXPECT_NE(notes.find("The views are scattered"), std::string::npos) << notes;
  const std::size_t at = notes.find("readings is ");
  ASSERT_NE(at, std::string::npos) << notes;
  double error = 0.0;
  std::from_chars(notes.data() + at + 12, notes.data() + notes.size(), error);
  EXPECT_GT(error, 0.0);
  EXPECT_LT(error, 0.05);
  double largest = 0.0;
  double rms = 0.0;
  Compare(reader->GetBRDF(), Gray, 80.0, largest, rms); // f is up to 0.24
  std::printf("scattered: largest difference %.4f, RMS %.5f\n", largest, rms);
  EXPECT_LT(largest, 0.009);
  EXPECT_LT(rms, 0.0009); // the nearest reading alone: 0.0012
}

//------------------------------------------------------------------------------
TEST(IOOpenMaterial, StrangeAlbedosAreNoted)
{
  const Folder folder;
  for (const double scale : { 0.1, 1e-4, 1.0 })
  {
    const auto reader =
      ReadBytesOf(folder, MakeOpenMaterial({ 905.0 }, { 0.0, 90.0 }, { 0.0, 90.0 }, { 0.0 },
                            [scale](double, double, double, double) { return scale; }));
    ExpectNote(reader, "another unit", scale != 0.1);
  }
}

//------------------------------------------------------------------------------
TEST(IOOpenMaterial, RefusesBadFiles)
{
  const Folder folder;
  const auto expect = [&folder](const std::string& bytes, std::vector<std::string> words)
  {
    words.push_back(OpenMaterialFormat);
    ExpectRefused(folder, WriteBytes(folder("a.xompt"), bytes), words);
  };
  const std::string good = "[5e-7, 0.1, 0.2, 0.3, 0.4]";
  const auto rows = [](const std::string& text) { return MakeOpenMaterialFile("5e-7", text); };
  expect(rows(good + ", [5e-7, 0.1, 0.2, 0.3]"), { "row 2", "found 4 numbers, expected 5" });
  expect(rows(good + ", [5e-7, 0, 0, 0, 1, 2]"), { "row 2", "found 6" });
  expect(rows("5"), { "row 1", "number alone" });
  expect(rows("[5e-7, 0, 0, 0, \"x\"]"), { "row 1", "found string" });
  expect(rows("[5e-7, 0, 0, 0, [1]]"), { "row 1", "found array" });
  expect(rows("[5e-7, 0, 0, 0, {}]"), { "row 1", "found object" });
  expect(rows("[5e-7, 0, 0, true, 0]"), { "row 1", "found boolean" });
  expect(rows(""), { "lookupTable", "no row" });
  expect(rows("[null, 0, 0, 0, 0]"), { "lookupTable", "no row" });
  expect(rows("[500, 0, 0, 0, 1]"), { "row 1", "wavelength is 500", "0.01716" });
  expect(rows("[5e-7, 45, 0, 0, 1]"), { "row 1", "incident zenith angle is 45" });
  expect(rows("[5e-7, 0, -0.1, 0, 1]"), { "row 1", "exit zenith angle is -0.1" });
  expect(rows("[5e-7, 0, 0, 7, 1]"), { "row 1", "azimuth angle is 7" });
  expect(rows("[5e-7, 0, 0, 0, 1e39]"), { "row 1", "value is 1e+39" });
  expect(rows("[5e-7, 0, 0, 0, 1e999]"), { "JSON at byte ", "1e999" });
  expect(rows("[5e-7, 0, 0, 0, nan]"), { "JSON at byte " });
  expect("{\"metadata\": {}}", { "brdf", "missing" });
  expect("{\"brdf\": {\"wavelengths\": []}}", { "lookupTable", "missing" });
  expect("{\"brdf\": {\"lookupTable\": [], \"lookupTable\": []}}", { "twice" });
  expect(rows(good) + "x", { "JSON at byte " });
  WriteBytes(folder("a.xompt"), "\xef\xbb\xbf\r\n" + rows(good)); // editors add these
  EXPECT_TRUE(Read(folder("a.xompt")));
  ExpectTruncationsRefused(folder, rows(good), 280, 23, OpenMaterialFormat);
}

//------------------------------------------------------------------------------
TEST(IOOpenMaterial, HostileFilesAreRefusedInLittleMemory)
{
  const Folder folder;
  const auto expect = [&folder](const std::string& bytes, const std::string& word) {
    ExpectRefused(folder, WriteBytes(folder("a.xompt"), bytes), { OpenMaterialFormat, word });
  };
  const double before = GetPeakMemory();
  expect("{\"brdf\":" + std::string(1 << 20, '['), "nested deeper");
  std::string objects;
  for (int k = 0; k < 100000; ++k)
  {
    objects += "{\"a\":";
  }
  expect("{\"x\":" + objects, "nested deeper");
  // Each row's angles are its own: a full grid of them would have 1e12 nodes.
  std::string sparse;
  std::string many;
  for (int k = 0; k < 10000; ++k)
  {
    sparse += (k > 0 ? "," : "") +
              MakeOpenMaterialRow(500.0, 0.0089 * k, 0.0087 * (k * 7 % 10000), 0.03 * k, 0.1);
    many += (k > 0 ? "," : "") + MakeOpenMaterialRow(400.0 + 0.01 * k, 10.0, 20.0, 30.0, 0.1);
  }
  expect(MakeOpenMaterialFile("5e-7", sparse), "expected a grid");
  expect(MakeOpenMaterialFile("5e-7", many), "at most 4096");
  std::string apart; // wavelengths that share no directions
  for (int k = 0; k < 3000; ++k)
  {
    apart +=
      (k > 0 ? "," : "") + MakeOpenMaterialRow(400.0 + 0.1 * k, 0.02 * k, 0.02 * k, 0.02 * k, 0.1);
  }
  expect(MakeOpenMaterialFile("5e-7", apart), "in common");
  EXPECT_LT(GetPeakMemory() - before, 3e8);
}

//------------------------------------------------------------------------------
// The standard's own examples.
TEST(IOOpenMaterial, ReadsMeasuredAsphalt)
{
  const std::filesystem::path folder = std::filesystem::path(SharedData) / "materials/asphalt";
  if (!std::filesystem::is_directory(folder))
  {
    GTEST_SKIP() << "no shared data";
  }
  const auto camera = Read((folder / "example_material_camera_brdf.xompt").string());
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->GetName(), "asphalt_brdf_for_camera");
  const glm::dvec3 f = EvaluateAt(camera, 30.0, 0.0, 0.0, 0.0);
  // By the program that SpectraForTests.h names.
  const double expected[3] = { 2.36343433e-5, 1.94732855e-5, 1.57571673e-5 };
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(f[c], expected[c], SpectrumTolerance * expected[c]);
  }
  const auto lidar = Read((folder / "example_material_lidar_brdf.xompt").string());
  ASSERT_TRUE(lidar);
  const glm::dvec3 row = EvaluateAt(lidar, 88.0, 20.0, 40.0, 200.0);
  EXPECT_NEAR(row.x, 0.000663154, 1e-7); // a row of the file
  EXPECT_EQ(row.x, row.z);
}
}
