// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// RGL's spectral files, written here from their published layout: no measured one was at hand.

#include "AnisotropicWarp.h"
#include "SpectraForTests.h"
#include "TestIOHelpers.h"

#include <limits>

namespace
{
using namespace testio;
using Tables = vtkAdaptiveWarpBRDF::Tables;

// As the database's files have them: 195, from 360 to 1000 nm.
std::vector<float> MakeWavelengths(int count = 195, double first = 360.0, double last = 1000.0)
{
  std::vector<float> wavelengths;
  for (int k = 0; k < count; ++k)
  {
    wavelengths.push_back(static_cast<float>(first + (last - first) * k / (count - 1)));
  }
  return wavelengths;
}

// The file whose spectra are the tables' green times a spectrum.
std::vector<TensorField> MakeSpectralFields(const Tables& tables,
  const std::vector<float>& wavelengths, const std::function<double(double)>& spectrum)
{
  const std::size_t plane = std::size_t(tables.Rgb.Shape[3]) * std::size_t(tables.Rgb.Shape[4]);
  std::string spectra;
  for (std::size_t at = 0; at < tables.Rgb.Values.size(); at += 3 * plane)
  {
    for (const float l : wavelengths)
    {
      for (std::size_t k = 0; k < plane; ++k)
      {
        Append<float>(spectra, static_cast<float>(spectrum(l) * tables.Rgb.Values[at + plane + k]));
      }
    }
  }
  std::string axis;
  for (const float l : wavelengths)
  {
    Append<float>(axis, l);
  }
  std::vector<TensorField> fields = MakeTensorFields(tables);
  fields[7].Name = "spectra";
  fields[7].Shape[2] = wavelengths.size();
  fields[7].Data = spectra;
  fields.push_back({ "wavelengths", 10, { wavelengths.size() }, axis });
  return fields;
}

// f cos(theta_o) = 0.3 for all directions.
Tables MakeEvenTables()
{
  Tables tables = MakeTables();
  tables.Jacobian = false;
  for (vtkAdaptiveWarpBRDF::Table* table :
    { &tables.Ndf, &tables.Sigma, &tables.Vndf, &tables.Luminance })
  {
    std::fill(table->Values.begin(), table->Values.end(), 1.0f);
  }
  std::fill(tables.Rgb.Values.begin(), tables.Rgb.Values.end(), 0.3f);
  return tables;
}

std::string MakeSpectral(const Tables& tables, const std::vector<float>& wavelengths,
  const std::function<double(double)>& spectrum)
{
  auto fields = MakeSpectralFields(tables, wavelengths, spectrum);
  const auto jacobian = std::find_if(fields.begin(), fields.end(),
    [](const TensorField& field) { return field.Name == "jacobian"; });
  jacobian->Data[0] = tables.Jacobian ? 1 : 0;
  return MakeTensor(fields);
}

TEST(IOSpectral, FlatSpectraAreGray)
{
  const Folder folder;
  WriteBytes(folder("gray.bsdf"),
    MakeSpectral(MakeEvenTables(), MakeWavelengths(), [](double) { return 0.5; }));
  const auto brdf = Read(folder("gray.bsdf"));
  ASSERT_TRUE(brdf);
  EXPECT_TRUE(brdf->IsIsotropic());
  ForPairs(200,
    [&](const double i[3], const double o[3])
    {
      double f[3];
      brdf->Evaluate(i, o, f);
      for (const double value : f)
      {
        ASSERT_NEAR(value * o[2], 0.15, 1e-6);
      }
    });
}

TEST(IOSpectral, AgreesWithAnotherProgramsSum)
{
  const Folder folder;
  // Fine, uneven, and cut off at both ends where the eye sees next to nothing.
  const std::vector<float> grids[] = { MakeWavelengths(), MakeWavelengths(471, 360.0, 830.0),
    MakeWavelengths(89, 392.5, 741.5) };
  for (const TestSpectrum& spectrum : TestSpectra)
  {
    for (const std::vector<float>& wavelengths : grids)
    {
      SCOPED_TRACE(spectrum.Name);
      WriteBytes(
        folder("a_spec.bsdf"), MakeSpectral(MakeEvenTables(), wavelengths, spectrum.Value));
      const auto reader = ReadFile(folder("a_spec.bsdf"));
      EXPECT_EQ(reader->GetBRDF()->GetName(), "a_spec");
      ExpectNote(reader, "D65");
      EXPECT_EQ(
        reader->GetNotes().find("Constant beyond") != std::string::npos, wavelengths[0] > 380.0f);
      const bool isOutside = spectrum.RGB[0] < 0.0 || spectrum.RGB[2] < 0.0;
      EXPECT_EQ(reader->GetNumberOfNegativeValues() > 0, isOutside);
      EXPECT_EQ(reader->GetNotes().find("outside sRGB") != std::string::npos, isOutside);
      const double i[3] = { 0.0, 0.6, 0.8 };
      const double o[3] = { 0.6, 0.0, 0.8 };
      double f[3];
      reader->GetBRDF()->Evaluate(i, o, f);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(f[c] * 0.8 / 0.3, std::max(spectrum.RGB[c], 0.0), SpectrumTolerance) << c;
      }
    }
  }
}

TEST(IOSpectral, AnisotropicOnesAreTheirSourceTimesTheColor)
{
  const Folder folder;
  const auto metal = NewBrushedMetal(0.2, 0.5);
  AnisotropicWarpSizes sizes;
  sizes.Thetas = 6;
  sizes.Phis = 9;
  sizes.Side = 17;
  const Tables tables = MakeAnisotropicTables(metal, sizes);
  const TestSpectrum& ramp = TestSpectra[0];
  WriteBytes(
    folder("a.bsdf"), MakeSpectral(tables, MakeWavelengths(65, 360.0, 1000.0), ramp.Value));
  const auto brdf = Read(folder("a.bsdf"));
  ASSERT_TRUE(brdf);
  EXPECT_FALSE(brdf->IsIsotropic());
  vtkNew<vtkAdaptiveWarpBRDF> gray;
  ASSERT_EQ(gray->SetTables(tables), "");
  double sum = 0.0;
  ForPairs(300,
    [&](const double i[3], const double o[3])
    {
      double f[3];
      double expected[3];
      brdf->Evaluate(i, o, f);
      gray->Evaluate(i, o, expected);
      for (int c = 0; c < 3; ++c)
      {
        ASSERT_NEAR(f[c], expected[1] * ramp.RGB[c], SpectrumTolerance * expected[1] + 1e-6);
      }
      sum += f[0];
    });
  EXPECT_GT(sum, 0.0);
}

TEST(IOSpectral, RefusesBadSpectra)
{
  const Folder folder;
  const std::string format = "RGL tensor file";
  const auto make = [](const std::vector<float>& wavelengths)
  { return MakeSpectralFields(MakeEvenTables(), wavelengths, [](double) { return 0.5; }); };
  const auto good = make({ 400.0f, 500.0f, 600.0f });
  ExpectBytesRefused(folder, MakeTensor(make({ 400.0f, 400.0f })),
    { format, "field 'wavelengths' at byte ", "number 1 is 400", "ascending" });
  ExpectBytesRefused(
    folder, MakeTensor(make({ -1.0f, 400.0f })), { format, "'wavelengths'", "number 0" });
  ExpectBytesRefused(folder, MakeTensor(make({ 400.0f, std::nanf("") })),
    { format, "'wavelengths'", "number 1 is nan" });
  ExpectBytesRefused(
    folder, MakeTensor(make({ 800.0f, 1000.0f })), { format, "found 800", "visible" });
  auto fields = good;
  fields.pop_back();
  ExpectBytesRefused(folder, MakeTensor(fields), { format, "'wavelengths'", "missing" });
  fields = good;
  fields.back().Shape = { 2 };
  ExpectBytesRefused(
    folder, MakeTensor(fields), { format, "'spectra'", "found 3 wavelengths, expected the 2" });
  fields = good;
  Overwrite(fields[7].Data, 8, std::numeric_limits<float>::infinity());
  ExpectBytesRefused(folder, MakeTensor(fields), { format, "'spectra'", "value 2 is not finite" });
  ExpectTruncationsRefused(folder, MakeTensor(good), 12, 211, format);
}
}
