// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// UTIA's .bin, written here from its published layout: no file of the database was at hand.

#include "AngleFormula.h"
#include "TestIOHelpers.h"

#include "vtkAngularTableBRDF.h"

#include <limits>

namespace
{
using namespace testio;

constexpr std::size_t Side = 288;

// Linear in each of the four angles between the nodes: interpolation is exact. Degrees.
double Tent(double phi) { return std::abs(std::remainder(phi, 360.0)) / 180.0; }

double Formula(int channel, double thetaI, double phiI, double thetaO, double phiO)
{
  const double light = 0.1 + 0.001 * thetaI + 0.05 * Tent(phiI);
  const double view = 0.9 - 0.004 * thetaO + 0.2 * Tent(phiO - 90.0);
  return light * view * (channel + 1.0);
}

std::string MakeUtia(double scale = 1.0)
{
  std::string bytes(3 * Side * Side * sizeof(double), '\0');
  for (std::size_t c = 0; c < 3; ++c)
  {
    for (std::size_t row = 0; row < Side; ++row)
    {
      for (std::size_t column = 0; column < Side; ++column)
      {
        const double value = scale * Formula(static_cast<int>(c), 15.0 * (row / 48),
                                       7.5 * (row % 48), 15.0 * (column / 48), 7.5 * (column % 48));
        std::memcpy(
          &bytes[((c * Side + row) * Side + column) * sizeof(double)], &value, sizeof(double));
      }
    }
  }
  return bytes;
}

TEST(IOUtia, InterpolatesAlongAllFourAxes)
{
  const Folder folder;
  const auto reader = ReadFile(WriteBytes(folder("cloth.bin"), MakeUtia()));
  vtkBRDF* brdf = reader->GetBRDF();
  EXPECT_EQ(reader->GetFormatName(), "UTIA binary");
  EXPECT_EQ(brdf->GetName(), "cloth");
  EXPECT_FALSE(brdf->IsIsotropic());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  for (int k = 0; k < 2000; ++k)
  {
    const double angles[4] = { 88.0 * number(random), 360.0 * number(random), 88.0 * number(random),
      360.0 * number(random) }; // beyond 75 degrees: extrapolated
    const glm::dvec3 f = EvaluateAt(brdf, angles[0], angles[1], angles[2], angles[3]);
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_NEAR(f[c], Formula(c, angles[0], angles[1], angles[2], angles[3]), 1e-6) << k;
    }
  }
}

TEST(IOUtia, DisplayColorsAreDecoded)
{
  const Folder folder;
  WriteBytes(folder("cloth.bin"), MakeUtia(10.0));
  const auto brdf = Read(folder("cloth.bin#display"));
  const glm::dvec3 f = EvaluateAt(brdf, 30.0, 15.0, 45.0, 90.0);
  for (int c = 0; c < 3; ++c)
  {
    const double encoded = 10.0 * Formula(c, 30.0, 15.0, 45.0, 90.0) / 140.0;
    const double linear =
      encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(f[c], 100.0 * linear, 1e-5);
  }
  ExpectRefused(folder, folder("cloth.bin#other"), { "UTIA binary", "'#other'", "'#display'" });
}

TEST(IOUtia, NegativeValuesCountAsNothing)
{
  const Folder folder;
  std::string bytes = MakeUtia();
  Overwrite(bytes, 0, -5.0);
  const auto reader = ReadFile(WriteBytes(folder("a.bin"), bytes));
  EXPECT_EQ(reader->GetNumberOfNegativeValues(), 1);
  ExpectNote(reader, "1 of 248832 values are negative");
  const double normal[3] = { 0.0, 0.0, 1.0 };
  double f[3];
  reader->GetBRDF()->Evaluate(normal, normal, f);
  EXPECT_EQ(f[0], 0.0);
  EXPECT_GT(f[1], 0.0);
}

TEST(IOUtia, RefusesOtherFiles)
{
  const Folder folder;
  const std::string good = MakeUtia();
  const auto expect = [&folder](const std::string& bytes, const std::string& part) {
    ExpectRefused(folder, WriteBytes(folder("a.bin"), bytes), { "UTIA binary", part });
  };
  expect(good.substr(0, good.size() - 1), "1990656 bytes, found 1990655");
  expect(good + "x", "found 1990657");
  std::string bytes = good;
  Overwrite(bytes, 8 * 1000, std::numeric_limits<double>::quiet_NaN());
  expect(bytes, "byte 8000");
  Overwrite(bytes, 8 * 1000, 1e300); // no float
  expect(bytes, "found 1e+300");
  ExpectNote(
    ReadFile(WriteBytes(folder("a.bin"), good + std::string(100, '\0'))), "100 bytes of padding");
}

TEST(IOUtia, TablesAreChecked)
{
  using Nodes = vtkAngularTableBRDF::Nodes;
  vtkNew<vtkAngularTableBRDF> table;
  const Nodes one = { { 0.0f }, { 0.0f } };
  ASSERT_EQ(table->SetValues(one, one, { 0.1f, 0.2f, 0.3f }), "");
  const auto expect =
    [&](const Nodes& light, const Nodes& view, std::vector<float> rgb, const std::string& part)
  {
    const std::string problem = table->SetValues(light, view, std::move(rgb));
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
    EXPECT_EQ(table->GetValues().size(), 3u); // as it was
  };
  expect({ {}, { 0.0f } }, one, {}, "at least one");
  expect({ { 0.0f }, {} }, one, {}, "at least one");
  expect(one, { { 10.0f, 10.0f }, { 0.0f } }, std::vector<float>(6), "ascending");
  expect(one, { { 0.0f, 90.5f }, { 0.0f } }, std::vector<float>(6), "from 0 to 90");
  expect(one, { { 0.0f }, { -1.0f } }, std::vector<float>(3), "azimuth 0");
  expect(one, { { 0.0f }, { 0.0f, 360.0f } }, std::vector<float>(6), "less than 360");
  expect(one, { { std::nanf("") }, { 0.0f } }, std::vector<float>(3), "ascending");
  expect(one, { { 0.0f }, std::vector<float>(16385) }, {}, "at most 16384");
  const Nodes many = { { 0.0f }, vtkAngularTableBRDF::GetEvenAzimuths(16384) };
  expect(many, many, {}, "at most 64 million");
  expect(one, one, std::vector<float>(4), "found 4, expected 3");
  expect(
    one, one, { 0.0f, std::numeric_limits<float>::infinity(), 0.0f }, "number 1 is not finite");
}
}
