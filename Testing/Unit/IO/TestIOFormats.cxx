// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkBRDFReader's binary formats: what is read, and what bad files get.
#include "TestIOHelpers.h"

#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <limits>

using namespace testio;

namespace
{
const std::string Merl = "MERL binary";
const std::string Tensor = "RGL tensor file";
const std::string Mbsdf = "NVIDIA MBSDF";
}

//------------------------------------------------------------------------------
TEST(IOReader, RefusesWhatIsNoMaterialFile)
{
  const Folder folder;
  ExpectRefused(folder, folder("missing.binary"), { "no such file" });
  ExpectRefused(folder, folder(""), { "directory" });
  ExpectBytesRefused(folder, "", { "empty" });
  ExpectAllRefused(folder, "no known format",
    { { std::string("\x01\x02", 2), {} }, { std::string(64, '\xff'), { "-1, -1, -1" } },
      { std::string(64, '\0'), { "bytes are 0" } },
      { "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n", { "pointer of Git LFS" } },
      { "<!DOCTYPE html>\n<html lang=en>\n<body>404</body></html>\n", { "web page" } },
      { "# BRDF\nScatterType  BRDF\nSampleRotation  1\n0\n", { "Zemax", "ScatterType" } },
      { "<?xml version=\"1.0\"?>\n<other/>\n", { "XML without", "WindowElement", "<?xml" } },
      { std::string("PK\x03\x04\0\0", 6), { "ZIP archive" } },
      { "just some words\n", { "published fits", "text that begins 'just some words'" } } });

  vtkNew<vtkBRDFReader> reader;
  vtkNew<ErrorCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_FALSE(reader->Read()); // no name
  EXPECT_EQ(errors->Count, 1);
  EXPECT_EQ(reader->GetBRDF(), nullptr);
}

//------------------------------------------------------------------------------
TEST(IOReader, ReportsProgress)
{
  const Folder folder;
  WriteBytes(folder("a.binary"), MakeMerl(2, 3, 4));
  vtkNew<vtkBRDFReader> reader;
  vtkNew<ErrorCounter> progress;
  reader->AddObserver(vtkCommand::ProgressEvent, progress);
  reader->SetFileName(folder("a.binary"));
  ASSERT_TRUE(reader->Read());
  EXPECT_GE(progress->Count, 2);
}

//------------------------------------------------------------------------------
TEST(IOMerl, Reads)
{
  const Folder folder;
  const auto reader = ReadFile(WriteBytes(folder("sample.binary"), MakeMerl(2, 3, 4)));
  EXPECT_EQ(reader->GetFormatName(), Merl);
  EXPECT_EQ(reader->GetNumberOfNegativeValues(), 3);
  EXPECT_EQ(reader->GetNumberOfInvalidValues(), 0);
  auto* table = vtkTabulatedBRDF::SafeDownCast(reader->GetBRDF());
  ASSERT_TRUE(table);
  EXPECT_EQ(table->GetName(), "sample");
  EXPECT_NE(table->GetSource().find("sample.binary"), std::string::npos);
  EXPECT_EQ(table->GetParameterization(), vtkTabulatedBRDF::HALF_DIFFERENCE);
  EXPECT_EQ(table->GetAzimuthRange(), vtkTabulatedBRDF::HALF_TURN);
  const int* size = table->GetDimensions();
  EXPECT_EQ(size[0], 4); // phi_d
  EXPECT_EQ(size[1], 3); // theta_d
  EXPECT_EQ(size[2], 2); // theta_h
  // Cell (phi_d 1, theta_d 2, theta_h 1) is number 1 + 4 (2 + 3 * 1) = 21.
  const double scale[3] = { 1.0 / 1500, 1.15 / 1500, 1.66 / 1500 };
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_FLOAT_EQ(table->GetVolume()[3 * 21 + k], float((100.0 + 21 + 1000.0 * k) * scale[k]));
  }
  EXPECT_EQ(table->GetNumberOfInvalidCells(), 1);
  EXPECT_TRUE(std::isnan(table->GetVolume()[3 * 23]));
}

//------------------------------------------------------------------------------
TEST(IOMerl, CountsWhatIsNotFinite)
{
  const Folder folder;
  std::string bytes = MakeMerl(2, 2, 2);
  Overwrite(bytes, 12, std::numeric_limits<double>::quiet_NaN());
  Overwrite(bytes, 12 + 8, std::numeric_limits<double>::infinity());
  Overwrite(bytes, 12 + 16, -std::numeric_limits<double>::infinity());
  Overwrite(bytes, 12 + 24, 1e300); // beyond float
  const auto reader = ReadFile(WriteBytes(folder("a.binary"), bytes));
  EXPECT_EQ(reader->GetNumberOfInvalidValues(), 4);
  EXPECT_EQ(reader->GetNumberOfNegativeValues(), 3);
  EXPECT_EQ(vtkTabulatedBRDF::SafeDownCast(reader->GetBRDF())->GetNumberOfInvalidCells(), 5);
  ForPairs(100,
    [&](const double i[3], const double o[3])
    {
      double f[3];
      reader->GetBRDF()->Evaluate(i, o, f);
      EXPECT_TRUE(std::isfinite(f[0]) && f[0] >= 0.0);
    });
}

//------------------------------------------------------------------------------
TEST(IOMerl, RefusesBadSizes)
{
  const Folder folder;
  const std::string good = MakeMerl(2, 3, 4);
  ExpectTruncationsRefused(folder, good, 12, 1, Merl);
  ExpectTruncationsRefused(folder, good, 1, 1, "bytes");
  ExpectBytesRefused(folder, good + "x", { Merl, "values" });
  for (const std::int32_t lie :
    { 5, 90, 2048, -1, 0, std::numeric_limits<std::int32_t>::min(), 2049 })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      std::string bytes = good;
      Overwrite(bytes, 4 * axis, lie);
      ExpectBytesRefused(folder, bytes,
        lie > 0 && lie <= 2048 ? std::vector<std::string>{ Merl, "values", "found 576" }
                               : std::vector<std::string>{ std::to_string(lie), "1 to 2048" });
    }
  }
  // 2048^3 cells: the product fits 64 bits and is compared before anything is allocated.
  std::string bytes = good;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    Overwrite(bytes, 4 * axis, std::int32_t(2048));
  }
  ExpectBytesRefused(folder, bytes, { Merl, "206158430208" });
}

//------------------------------------------------------------------------------
TEST(IOTensor, Reads)
{
  const Folder folder;
  const vtkAdaptiveWarpBRDF::Tables tables = MakeTables();
  const auto reader =
    ReadFile(WriteBytes(folder("stuff.bsdf"), MakeTensor(MakeTensorFields(tables))));
  EXPECT_EQ(reader->GetFormatName(), Tensor);
  EXPECT_EQ(
    reader->GetNumberOfNegativeValues(), std::count_if(tables.Rgb.Values.begin(),
                                           tables.Rgb.Values.end(), [](float v) { return v < 0; }));
  EXPECT_GT(reader->GetNumberOfNegativeValues(), 0);
  EXPECT_EQ(reader->GetBRDF()->GetName(), "stuff");
  EXPECT_EQ(reader->GetBRDF()->GetSource().find("sample;"), 0u);
  vtkNew<vtkAdaptiveWarpBRDF> expected;
  ASSERT_EQ(expected->SetTables(tables), "");
  ExpectSameValues(expected, reader->GetBRDF());
}

//------------------------------------------------------------------------------
TEST(IOTensor, RefusesBadFiles)
{
  const Folder folder;
  const auto fields = MakeTensorFields(MakeTables());
  const std::string good = MakeTensor(fields);
  const std::size_t headerEnd = good.size() - [&]
  {
    std::size_t sum = 0;
    for (const TensorField& field : fields)
    {
      sum += field.Data.size();
    }
    return sum;
  }();
  ExpectTruncationsRefused(folder, good.substr(0, headerEnd), 12, 1, Tensor);
  ExpectTruncationsRefused(folder, good, headerEnd, 61, Tensor);

  // The first field: name length at 18, name, then dimensions, type, offset, shape.
  const std::size_t rank = 18 + 2 + fields[0].Name.size();
  const auto put = [&good](std::size_t at, auto value)
  {
    std::string bytes = good;
    Overwrite(bytes, at, value);
    return bytes;
  };
  ExpectBytesRefused(folder, put(3, 'X'), { "no known format" });
  ExpectAllRefused(folder, Tensor,
    { { put(12, '\2'), { "version", "2.0" } }, { put(13, '\1'), { "version", "1.1" } },
      { put(14, std::numeric_limits<std::uint32_t>::max()), { "field 10 of 4294967295" } },
      { put(rank, std::uint16_t(65535)), { "description", "65535" } },
      { put(rank + 2, '\x0c'), { "description", "type" } } });
  for (const std::uint64_t lie :
    { std::uint64_t(1) << 31, ~std::uint64_t(0), std::uint64_t(1) << 63 })
  {
    ExpectBytesRefused(folder, put(rank + 3, lie), { Tensor, "description", "data" });
    ExpectBytesRefused(folder, put(rank + 11, lie), { Tensor, "description" });
  }
}

//------------------------------------------------------------------------------
TEST(IOTensor, RefusesBadFields)
{
  const Folder folder;
  const auto good = MakeTensorFields(MakeTables());
  for (const std::string name : { "phi_i", "theta_i", "sigma", "ndf", "vndf", "luminance", "rgb" })
  {
    SCOPED_TRACE(name);
    auto fields = good;
    FieldOf(fields, name).Name = "other";
    ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, name, "missing" });
    fields = good;
    FieldOf(fields, name).Type = 6;
    ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, name, "type 6" });
    fields = good;
    FieldOf(fields, name).Shape.push_back(1);
    ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, name, "dimensions" });
    fields = good;
    FieldOf(fields, name).Shape[0] = 0;
    ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, name, "size 0" });
    for (const float wrong :
      { std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity() })
    {
      fields = good;
      std::memcpy(&FieldOf(fields, name).Data[0], &wrong, sizeof(wrong));
      ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, name });
    }
  }
  // Sizes whose product overflows 64 bits to something small.
  auto fields = good;
  FieldOf(fields, "rgb").Shape = { 1, std::uint64_t(1) << 32, 3, std::uint64_t(1) << 32, 4 };
  ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, "rgb", "overflows" });
  fields = good;
  fields.push_back(good.back());
  ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, "jacobian", "twice" });
  for (const char wrong : { '\x02', '\xff' })
  {
    fields = good;
    FieldOf(fields, "jacobian").Data[0] = wrong;
    ExpectBytesRefused(
      folder, MakeTensor(fields), { Tensor, "field 'jacobian' at byte ", "0 or 1" });
  }
  // Fields whose data are all in the same place.
  fields = good;
  const auto rgb = static_cast<std::ptrdiff_t>(&FieldOf(fields, "rgb") - fields.data());
  for (int k = 0; k < 20; ++k)
  {
    TensorField same = good[static_cast<std::size_t>(rgb)];
    same.Name = "more" + std::to_string(k);
    same.Data.clear();
    fields.insert(fields.begin() + rgb, same);
  }
  ExpectBytesRefused(folder, MakeTensor(fields), { Tensor, "overlap" });
}

//------------------------------------------------------------------------------
TEST(IOTensor, NamesTheFieldAndItsByte)
{
  const Folder folder;
  const auto good = MakeTensorFields(MakeTables());
  const auto refused = [&](const std::string& name, float value, const std::string& what)
  {
    SCOPED_TRACE(name);
    auto fields = good;
    std::string& data = FieldOf(fields, name).Data;
    for (std::size_t k = 0; k < data.size(); k += sizeof(value))
    {
      std::memcpy(&data[k], &value, sizeof(value));
    }
    std::size_t place = MakeTensor(fields).size();
    for (auto field = fields.rbegin(); field == fields.rbegin() || (field - 1)->Name != name;
         ++field)
    {
      place -= field->Data.size();
    }
    ExpectBytesRefused(folder, MakeTensor(fields),
      { Tensor + ", field '" + name + "' at byte " + std::to_string(place) + ": " + what });
  };
  refused("theta_i", 0.5f, "expected ascending finite angles");
  refused("sigma", std::numeric_limits<float>::infinity(), "expected finite values");
  refused("rgb", std::numeric_limits<float>::quiet_NaN(), "expected finite values");
  refused("vndf", -1.0f, "a density cannot be negative");
  refused("luminance", 0.0f, "a density cannot be 0 everywhere");
}

//------------------------------------------------------------------------------
TEST(IOTensor, TakesTheJacobianFlag)
{
  const Folder folder;
  for (const bool flag : { false, true })
  {
    vtkAdaptiveWarpBRDF::Tables tables = MakeTables();
    auto fields = MakeTensorFields(tables);
    FieldOf(fields, "jacobian").Data[0] = flag ? 1 : 0;
    WriteBytes(folder("a.bsdf"), MakeTensor(fields));
    const vtkSmartPointer<vtkBRDF> brdf = Read(folder("a.bsdf"));
    ASSERT_TRUE(vtkAdaptiveWarpBRDF::SafeDownCast(brdf));
    EXPECT_EQ(vtkAdaptiveWarpBRDF::SafeDownCast(brdf)->GetTables().Jacobian, flag);
    tables.Jacobian = flag;
    vtkNew<vtkAdaptiveWarpBRDF> expected;
    ASSERT_EQ(expected->SetTables(tables), "");
    ExpectSameValues(expected, brdf);
  }
}

//------------------------------------------------------------------------------
TEST(IOTensor, AgreesWithTheAuthorsCode)
{
  const std::filesystem::path materials = SharedData + "/materials/rgl";
  if (!std::filesystem::is_directory(materials))
  {
    GTEST_SKIP() << "no RGL files at " << materials;
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(materials))
  {
    SCOPED_TRACE(entry.path().filename().string());
    const vtkSmartPointer<vtkBRDF> brdf = Read(entry.path().string());
    ASSERT_TRUE(brdf);
    std::string name = entry.path().stem().string();
    name = name.substr(0, name.rfind("_rgb"));
    const auto rows = ReadCsv(SharedData + "/expected/" + name + ".pairs.csv");
    ASSERT_EQ(rows.size(), 400u);
    double maximum = 0.0;
    for (const std::vector<double>& row : rows)
    {
      maximum = std::max({ maximum, row[6], row[7], row[8] });
    }
    for (const std::vector<double>& row : rows)
    {
      double f[3];
      brdf->Evaluate(row.data(), row.data() + 3, f);
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double expected = row[6 + k];
        ASSERT_LE(std::abs(f[k] - expected),
          std::min(1e-3 * maximum, expected > 0.01 * maximum ? 1e-2 * expected : maximum));
      }
    }
    ++files;
  }
  EXPECT_EQ(files, 12);
}

//------------------------------------------------------------------------------
TEST(IOMbsdf, Reads)
{
  const Folder folder;
  for (const bool color : { false, true })
  {
    for (const bool transmission : { false, true })
    {
      const auto reader =
        ReadFile(WriteBytes(folder("paint.mbsdf"), MakeMbsdf(color, 3, 4, transmission)));
      EXPECT_EQ(reader->GetFormatName(), Mbsdf);
      EXPECT_EQ(reader->GetNumberOfNegativeValues(), 1);
      EXPECT_EQ(reader->GetNotes().find("transmission") != std::string::npos, transmission);
      ExpectNote(reader, "centers");
      ExpectNote(reader, "made by a test");
      auto* table = vtkTabulatedBRDF::SafeDownCast(reader->GetBRDF());
      ASSERT_TRUE(table);
      EXPECT_EQ(table->GetParameterization(), vtkTabulatedBRDF::INCIDENT_OUTGOING);
      EXPECT_EQ(table->GetDimensions()[0], 4);
      EXPECT_EQ(table->GetDimensions()[1], 3);
      EXPECT_EQ(table->GetDimensions()[2], 3);
      // Value 1 is negative and kept; cell 7 is the file's value 7 (scalar) or 21, 22, 23.
      EXPECT_EQ(table->GetVolume()[color ? 1 : 3], -0.5f);
      EXPECT_EQ(table->GetVolume()[21], color ? 0.25f + 0.01f * 21 : 0.25f + 0.01f * 7);
      EXPECT_EQ(table->GetVolume()[23], color ? 0.25f + 0.01f * 23 : 0.25f + 0.01f * 7);
    }
  }
}

//------------------------------------------------------------------------------
TEST(IOMbsdf, RefusesBadFiles)
{
  const Folder folder;
  const std::string good = MakeMbsdf(true, 3, 4);
  const std::string both = MakeMbsdf(true, 2, 2, true);
  const std::size_t block = good.find("REFLECTION=\n") + 12;
  ExpectTruncationsRefused(folder, good, 1, 1, Mbsdf);
  // A cut right behind the reflection block leaves a whole file without transmission.
  const std::size_t transmission = both.find("MBSDF_DATA_TRANSMISSION");
  ExpectTruncationsRefused(folder, both, transmission + 1, 1, Mbsdf);
  ExpectBytesRefused(folder, good + "x", { Mbsdf });
  ExpectBytesRefused(folder, both + "x", { Mbsdf, "1 bytes follow" });

  const auto put = [&good, block](std::size_t at, std::uint32_t value)
  {
    std::string bytes = good;
    Overwrite(bytes, block + at, value);
    return bytes;
  };
  ExpectBytesRefused(folder, Replace(good, "V1", "V2"), { "published fits" });
  for (const std::size_t field : { 4, 8 })
  {
    for (const std::uint32_t lie : { 0u, 2049u, 1u << 31, ~0u })
    {
      ExpectBytesRefused(
        folder, put(field, lie), { Mbsdf, field == 4 ? "theta" : "phi", std::to_string(lie) });
    }
    ExpectBytesRefused(folder, put(field, 2048u), { Mbsdf, "values", "needs" });
  }
  ExpectBytesRefused(folder, put(0, 2u), { Mbsdf, "type", "found 2" });
  std::string bytes = both;
  bytes.erase(bytes.find("MBSDF_DATA_REFLECTION"), transmission - both.find("MBSDF_DATA_REF"));
  ExpectBytesRefused(folder, bytes, { Mbsdf, "transmission only" });
}

//------------------------------------------------------------------------------
TEST(IOMbsdf, CountsWhatIsNotFinite)
{
  const Folder folder;
  std::string bytes = MakeMbsdf(true, 3, 4);
  Overwrite(bytes, bytes.size() - 4, std::numeric_limits<float>::quiet_NaN());
  Overwrite(bytes, bytes.size() - 8, std::numeric_limits<float>::infinity());
  const auto reader = ReadFile(WriteBytes(folder("a.mbsdf"), bytes));
  EXPECT_EQ(reader->GetNumberOfInvalidValues(), 2);
  EXPECT_EQ(vtkTabulatedBRDF::SafeDownCast(reader->GetBRDF())->GetNumberOfInvalidCells(), 1);
}
