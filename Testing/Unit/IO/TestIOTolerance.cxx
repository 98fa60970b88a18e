// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What instruments, converters and editors really write: taken and reported where it is harmless.
// And what hostile files hold: never in a message as it is.
#include "TestIOHelpers.h"

#include "Printable.h"
#include "vtkDistributionBRDF.h"
#include "vtkEnvironmentReader.h"
#include "vtkLambertBRDF.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <sstream>

using namespace testio;
using measuredbrdf::Quote;
using measuredbrdf::ToPrintable;

namespace
{
vtkSmartPointer<vtkBRDFReader> ReadFile(const Folder& folder, const std::string& bytes)
{
  return testio::ReadFile(WriteBytes(folder("file"), bytes));
}

// As DOS's editors write it.
std::string ToDos(const std::string& text)
{
  std::string dos;
  for (const char c : text)
  {
    dos += c == '\n' ? "\r\n" : std::string(1, c);
  }
  return dos;
}

// Nothing that a terminal obeys, and no broken UTF-8.
void ExpectPrintable(const std::string& text)
{
  EXPECT_EQ(ToPrintable(text, std::string::npos, true), text);
  EXPECT_LE(text.size(), 20000u);
}

const std::string Evil = "\x1b]0;owned\x07\x1b[2J\xc2\x9b"
                         "31m\x7f\r\xff\n";
}

//------------------------------------------------------------------------------
TEST(IOTolerance, TensorDensitiesWithRoundingNoise)
{
  const Folder folder;
  for (const std::string name : { "luminance", "vndf" })
  {
    SCOPED_TRACE(name);
    auto tables = MakeTables();
    auto& values = name == "vndf" ? tables.Vndf.Values : tables.Luminance.Values;
    std::fill(values.begin(), values.end(), 0.5f);
    for (float& value : tables.Rgb.Values)
    {
      value = std::abs(value);
    }
    tables.Rgb.Values[3] = 0.0f; // black is not negative
    tables.Rgb.Values[4] = -0.0f;
    auto clean = tables;
    auto& cleanValues = name == "vndf" ? clean.Vndf.Values : clean.Luminance.Values;
    values[2] = -4e-10f;
    values[5] = -3e-7f;
    cleanValues[2] = cleanValues[5] = 0.0f;
    const auto reader = ReadFile(folder, MakeTensor(MakeTensorFields(tables)));
    EXPECT_EQ(reader->GetNumberOfNegativeValues(), 2);
    ExpectNote(reader, "2 of ");
    ExpectNote(reader, name + " are negative by rounding");
    const auto noiseless = ReadFile(folder, MakeTensor(MakeTensorFields(clean)));
    EXPECT_EQ(noiseless->GetNumberOfNegativeValues(), 0);
    ExpectNote(noiseless, "negative", false);
    ExpectSameValues(reader->GetBRDF(), noiseless->GetBRDF());
    // Truly negative.
    for (const float value : { -1e-4f, -0.1f, -1.0f })
    {
      values[7] = value;
      ExpectBytesRefused(folder, MakeTensor(MakeTensorFields(tables)),
        { "field '" + name + "'", "a density cannot be negative" });
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOTolerance, TensorFilesOfConverters)
{
  const Folder folder;
  const auto tables = MakeTables();
  const vtkSmartPointer<vtkBRDF> same(
    ReadFile(folder, MakeTensor(MakeTensorFields(tables)))->GetBRDF());
  // NumPy's 64-bit numbers, padded text, bytes behind the data, a flag that is signed.
  auto fields = MakeTensorFields(tables);
  TensorField& rgb = FieldOf(fields, "rgb");
  rgb.Type = 11;
  rgb.Data.clear();
  for (const float value : tables.Rgb.Values)
  {
    Append<double>(rgb.Data, value);
  }
  fields[0].Data = std::string("stuff\0", 6);
  FieldOf(fields, "jacobian").Type = 2;
  auto reader = ReadFile(folder, MakeTensor(fields) + "whatever follows");
  ExpectSameValues(reader->GetBRDF(), same);
  ExpectNote(reader, "field 'rgb' holds 64-bit values");
  EXPECT_EQ(reader->GetBRDF()->GetSource().find("stuff; RGL"), 0u);
  // Angles rounded onto each other.
  auto rounded = tables;
  rounded.ThetaI = { 0.0f, 0.7f, std::nextafter(0.7f, 0.0f) };
  reader = ReadFile(folder, MakeTensor(MakeTensorFields(rounded)));
  ExpectNote(reader, "theta_i were rounded onto each other");
  for (const auto& axis : { std::vector<float>{ 0.0f, 0.7f, 0.6f },
         std::vector<float>{ 0.7f, 0.7f, 0.7f }, std::vector<float>{ 1.0f, 0.5f, 0.0f } })
  {
    rounded.ThetaI = axis;
    ExpectBytesRefused(
      folder, MakeTensor(MakeTensorFields(rounded)), { "theta_i", "ascending finite angles" });
  }
  // Where ndf or sigma are no densities, the material is black, and the notes say so.
  auto black = tables;
  black.Sigma.Values[1] = 0.0f;
  black.Ndf.Values[2] = -1.0f;
  reader = ReadFile(folder, MakeTensor(MakeTensorFields(black)));
  ExpectNote(reader, "2 values of ndf are negative or of sigma not positive");
}

//------------------------------------------------------------------------------
TEST(IOTolerance, MerlNoiseAndPadding)
{
  const Folder folder;
  std::string bytes = MakeMerl(2, 3, 4);
  Overwrite(bytes, 12, -4e-10);
  Overwrite(bytes, 12 + 8, -0.0);
  Overwrite(bytes, 12 + 16, -0.5);
  auto reader = ReadFile(folder, bytes + std::string("\n\0\0\0", 4));
  auto* table = vtkTabulatedBRDF::SafeDownCast(reader->GetBRDF());
  ASSERT_TRUE(table);
  EXPECT_EQ(table->GetVolume()[0], 0.0f);
  EXPECT_EQ(table->GetVolume()[3], 0.0f);
  EXPECT_TRUE(std::isnan(table->GetVolume()[6])); // not measured
  EXPECT_EQ(table->GetNumberOfInvalidCells(), 2);
  EXPECT_EQ(reader->GetNumberOfNegativeValues(), 5); // -4e-10, -0.5, and the last cell's three
  ExpectNote(reader, "1 values are negative by rounding");
  ExpectNote(reader, "4 bytes of padding");
  ExpectBytesRefused(folder, bytes + std::string(4097, '\0'), { "MERL binary", "values" });
  ExpectBytesRefused(folder, bytes + std::string("\0\0more", 6), { "MERL binary", "values" });
}

//------------------------------------------------------------------------------
TEST(IOTolerance, MbsdfOfDosAndPadding)
{
  const Folder folder;
  for (const bool transmission : { false, true })
  {
    std::string bytes = MakeMbsdf(true, 3, 4, transmission);
    const auto expected = vtkSmartPointer<vtkBRDF>(ReadFile(folder, bytes)->GetBRDF());
    const std::size_t header = bytes.find("MBSDF_DATA_REFLECTION=\n") + 23;
    std::string dos = ToDos(bytes.substr(0, header));
    dos.insert(dos.find("comment="), "\r\n"); // an empty line
    const auto reader = ReadFile(folder, dos + bytes.substr(header) + std::string("\n\0\x1a", 3));
    ExpectSameValues(reader->GetBRDF(), expected);
    ExpectNote(reader, "3 bytes of padding");
    ExpectNote(reader, "made by a test\"\n");
  }
}

//------------------------------------------------------------------------------
TEST(IOTolerance, FitsFromEditors)
{
  const Folder folder;
  const auto expected = vtkSmartPointer<vtkBRDF>(ReadFile(folder, SmallFit)->GetBRDF());
  std::string dos = "\xef\xbb\xbf" + ToDos(SmallFit);
  dos.replace(dos.find("= 20"), 4, "= +20");
  ExpectSameValues(ReadFile(folder, dos)->GetBRDF(), expected);

  const auto lambert = [](const std::string& albedo)
  { return "a = Aggregate(Lambertian(albedo = [" + albedo + "]))\n"; };
  const auto reader = ReadFile(folder, lambert("-4e-10, -0.0, 0.5"));
  EXPECT_EQ(reader->GetNumberOfNegativeValues(), 1);
  ExpectNote(reader, "albedo' is -4e-10, beyond 0 by rounding");
  auto* sum = vtkSumBRDF::SafeDownCast(reader->GetBRDF());
  ASSERT_TRUE(sum);
  EXPECT_EQ(vtkLambertBRDF::SafeDownCast(sum->GetTerm(0))->GetAlbedo()[0], 0.0);
  ReadFile(folder,
    "a = NganAshikhminShirley(albedo = [1, 1, 1], fresnelReflectance = 1.0000001, sharpness = 9)");
  ExpectBytesRefused(folder, lambert("-0.001, 0.1, 0.5"), { "albedo", "-0.001", "0 or more" });
  ExpectBytesRefused(folder, lambert("0,1, 0,2, 0,3"), { "6 numbers", "point, not a comma" });
  ExpectBytesRefused(folder, "a = NganBlinnPhong(albedo = [1, 1, 1], sharpness = 12,5)",
    { "'5'", "point, not a comma" });
  ExpectBytesRefused(folder,
    std::string("\xff\xfe"
                "a\0 \0",
      6),
    { "UTF-16" });
}

//------------------------------------------------------------------------------
TEST(IOTolerance, DistributionsWithRoundingNoise)
{
  vtkNew<vtkDistributionBRDF> brdf;
  EXPECT_TRUE(brdf->SetDistribution(2, 1, { 0.5f, 0.5f, 0.5f, -4e-10f, 0.0f, -0.0f }));
  for (std::size_t k = 3; k < 6; ++k)
  {
    EXPECT_EQ(brdf->GetDistribution()[k], 0.0f);
    EXPECT_FALSE(std::signbit(brdf->GetDistribution()[k]));
  }
  EXPECT_TRUE(brdf->SetFresnel(2, { 0.5f, 0.5f, 0.5f, -4e-10f, 0.0f, 1.0f }));
  EXPECT_EQ(brdf->GetFresnel()[3], 0.0f);
  vtkNew<ErrorCounter> errors;
  brdf->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_FALSE(brdf->SetFresnel(2, { 0.5f, 0.5f, 0.5f, -1e-4f, 0.0f, 1.0f }));
  EXPECT_FALSE(brdf->SetFresnel(1, { -1e-9f, -1e-9f, -1e-9f }));
  EXPECT_EQ(errors->Count, 2);
  EXPECT_EQ(brdf->GetFresnel()[3], 0.0f);
}

//------------------------------------------------------------------------------
TEST(IOMessages, PrintableText)
{
  EXPECT_EQ(ToPrintable("plain ASCII, \\ and 'quotes'"), "plain ASCII, \\ and 'quotes'");
  const std::string letters = "\xc3\xa9 \xe6\x9d\x90\xe6\x96\x99 \xf0\x9f\x8e\xa8"; // of UTF-8
  EXPECT_EQ(ToPrintable(letters), letters);
  EXPECT_EQ(ToPrintable("\x1b[31m\a\r\n\t\x7f"), "\\x1b[31m\\x07\\x0d\\x0a\\x09\\x7f");
  EXPECT_EQ(ToPrintable("a\n\tb\r", 100, true), "a\n\tb\\x0d");
  EXPECT_EQ(ToPrintable(std::string("\0", 1)), "\\x00");
  EXPECT_EQ(ToPrintable("\xc2\x9b"
                        "31m"),
    "\\xc2\\x9b31m");                                               // CSI as one character
  EXPECT_EQ(ToPrintable("\xe2\x80\xae"), "\\xe2\\x80\\xae");        // writes right to left
  EXPECT_EQ(ToPrintable("\xff\xc3\xc3\xa9"), "\\xff\\xc3\xc3\xa9"); // no UTF-8
  EXPECT_EQ(ToPrintable("\xc0\x9b\xe0\x80\x9b\xed\xa0\x80\xf4\x90\x80\x80"),
    "\\xc0\\x9b\\xe0\\x80\\x9b\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80"); // overlong, surrogate, beyond
  EXPECT_EQ(ToPrintable("\xe6\x9d"), "\\xe6\\x9d");                  // cut short
  EXPECT_LE(Quote(std::string(1 << 20, 'x')).size(), 210u);
  EXPECT_LE(Quote(std::string(1 << 20, '\x1b')).size(), 210u);
  EXPECT_EQ(Quote("name"), "'name'");
}

//------------------------------------------------------------------------------
// Names and values that a file chooses, in every message that quotes them.
TEST(IOMessages, NothingOfAFileReachesTheTerminalAsItIs)
{
  const Folder folder;
  const auto expectClean = [&](const std::string& bytes, const std::string& quoted)
  {
    WriteBytes(folder("bad.file"), bytes);
    vtkNew<vtkBRDFReader> reader;
    vtkNew<ErrorCounter> errors;
    reader->AddObserver(vtkCommand::ErrorEvent, errors);
    reader->SetFileName(folder("bad.file"));
    const bool read = reader->Read();
    EXPECT_EQ(errors->Count, read ? 0 : 1);
    const std::string said = read ? reader->GetNotes() : reader->GetErrorMessage();
    EXPECT_NE(said.find(quoted), std::string::npos) << ToPrintable(said);
    ExpectPrintable(said);
  };
  auto fields = MakeTensorFields(MakeTables());
  fields.push_back({ Evil, 99, { 1 }, "x" }); // an unknown type
  expectClean(MakeTensor(fields), "\\x1b]0;owned\\x07");
  fields.back() = { std::string(60000, '\x1b'), 99, { 1 }, "x" };
  expectClean(MakeTensor(fields), "...");
  std::string mbsdf = MakeMbsdf(true, 3, 4);
  std::string evil = Evil;
  evil.pop_back(); // its end of line
  mbsdf.replace(mbsdf.find("made by"), 7, evil + std::string(100000, '\x1b'));
  expectClean(mbsdf, "\\x1b]0;owned\\x07"); // a note
  expectClean("a = Aggregate(Lambertian(albedo = [\xc2\x9b"
              "31m])",
    "\\xc2\\x9b31m");
  expectClean("a\n" + std::string(5000, 'b') + " = " + std::string(100000, 'c') + "(d = 1)", "'='");
  expectClean(std::string(100000, 'a') + " = " + std::string(100000, 'c') + "(d = 1)", "...");

  vtkNew<vtkLambertBRDF> lambert;
  Write(lambert, folder("a.exr"));
  std::string exr = ReadBytes(folder("a.exr"));
  const std::size_t at = exr.find("Lambert");
  ASSERT_NE(at, std::string::npos);
  exr.replace(at, 7,
    "\xc2\x9b"
    "31mxx"); // as long
  expectClean(exr, "\\xc2\\x9b31m");

  // Names of files.
  const std::string path = folder(evil);
  vtkNew<ErrorCounter> errors;
  const auto expectRefused = [&](auto* reader, const std::string& name, const std::string& quoted)
  {
    reader->AddObserver(vtkCommand::ErrorEvent, errors);
    reader->SetFileName(name);
    EXPECT_FALSE(reader->Read());
    EXPECT_NE(reader->GetErrorMessage().find(quoted), std::string::npos)
      << ToPrintable(reader->GetErrorMessage());
    ExpectPrintable(reader->GetErrorMessage());
  };
  vtkNew<vtkBRDFReader> reader;
  vtkNew<vtkEnvironmentReader> environment;
  expectRefused(reader.Get(), path, "\\x1b]0;owned");
  WriteBytes(path, SmallFit);
  expectRefused(reader.Get(), path + "#" + evil, "\\x1b]0;owned");
  expectRefused(environment.Get(), path, "\\x1b]0;owned");
  reader->SetFileName(path);
  EXPECT_TRUE(reader->Read());
  std::ostringstream printed;
  reader->GetBRDF()->SetName(evil);
  reader->GetBRDF()->SetSource(evil);
  reader->GetBRDF()->Print(printed);
  ExpectPrintable(printed.str());
  // The environment reader looks at an image's attributes first.
  std::string image = Replace(exr, "chan", "\x1b[2J");
  image.resize(image.find("\x1b[2J") + 30);
  expectRefused(environment.Get(), WriteBytes(folder("bad.exr"), image), "\\x1b[2J");
}
