// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkBRDFWriter: what is written reads back the same.
#include "EveryModel.h"
#include "TestIOHelpers.h"

#include "vtkBRDFExchange.h"
#include "vtkBRDFModels.h"
#include "vtkBasisBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>

#include <limits>

#if !defined(_WIN32)
#include <unistd.h>
#endif

using namespace testio;
using namespace std::string_literals;

namespace
{
const std::string Exr = "OpenEXR material";

/// Values over many magnitudes, with awkward last bits, one denormal, one negative zero.
std::vector<float> MakeValues(std::size_t count, float sign = 1.0f)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> exponent(-20.0f, 10.0f);
  std::vector<float> values(count);
  for (float& value : values)
  {
    value = sign * std::exp2(exponent(random));
  }
  values[0] = std::numeric_limits<float>::denorm_min();
  values[1] = -0.0f;
  return values;
}

vtkSmartPointer<vtkTabulatedBRDF> MakeTable(int parameterization, int range, bool invalid = true)
{
  const int size[3] = { 6, 5, 4 };
  std::vector<float> values = MakeValues(3 * 6 * 5 * 4);
  if (invalid)
  {
    values[3 * 17 + 1] = std::numeric_limits<float>::quiet_NaN();
  }
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  EXPECT_TRUE(table->SetVolume(parameterization, range, size, values));
  table->SetName("a \"name\" with \xc3\xa9");
  table->SetSource("line 1\nline 2");
  return table;
}

vtkSmartPointer<vtkTabulatedBRDF> MakeMerlTable()
{
  return MakeTable(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN);
}

// A subclass may hold what no setter takes.
class BrokenBRDF : public vtkLambertBRDF
{
public:
  static BrokenBRDF* New();
  vtkTypeMacro(BrokenBRDF, vtkLambertBRDF);
  std::string GetModelName() override { return "Broken"; }

protected:
  BrokenBRDF() { this->Albedo[1] = std::numeric_limits<double>::quiet_NaN(); }
};
vtkStandardNewMacro(BrokenBRDF);

// Forgets to name its parameters.
class SilentBRDF : public vtkLambertBRDF
{
public:
  static SilentBRDF* New();
  vtkTypeMacro(SilentBRDF, vtkLambertBRDF);
  std::string GetModelName() override { return "Silent"; }
  void ExchangeData(vtkBRDFExchange&) override {}
};
vtkStandardNewMacro(SilentBRDF);

void ExpectWriteRefused(
  vtkBRDF* brdf, const std::string& path, const std::vector<std::string>& words)
{
  vtkNew<vtkBRDFWriter> writer;
  vtkNew<ErrorCounter> errors;
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->SetBRDF(brdf);
  writer->SetFileName(path);
  EXPECT_FALSE(writer->Write());
  EXPECT_EQ(errors->Count, 1);
  const std::string message = writer->GetErrorMessage();
  EXPECT_NE(message.find(path), std::string::npos) << message;
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' in: " << message;
  }
}

// What is read of what is written has every option, number and table bit by bit, and is written the
// same.
void RoundTrip(vtkBRDF* material)
{
  SCOPED_TRACE(material->GetClassName());
  const Folder folder;
  Write(material, folder("m.exr"));
  const vtkSmartPointer<vtkBRDF> back = Read(folder("m.exr"));
  ASSERT_TRUE(back);
  EXPECT_STREQ(back->GetClassName(), material->GetClassName());
  EXPECT_EQ(back->GetName(), material->GetName());
  EXPECT_EQ(back->GetSource(), material->GetSource());
  EXPECT_NE(vtkBRDFModels::GetContentKey(back), "");
  EXPECT_EQ(vtkBRDFModels::GetContentKey(back), vtkBRDFModels::GetContentKey(material));
  Write(back, folder("n.exr"));
  EXPECT_TRUE(ReadBytes(folder("m.exr")) == ReadBytes(folder("n.exr")));
  ExpectSameValues(material, back);
}

// The header's JSON with another text, of any length. What follows it has moved.
std::string ReplaceInJson(const std::string& bytes, const std::string& old, const std::string& with)
{
  const std::string name("measuredBRDF\0string\0", 20);
  const std::size_t at = bytes.find(name) + name.size();
  std::int32_t size = 0;
  std::memcpy(&size, &bytes[at], sizeof(size));
  std::string changed = Replace(bytes, old, with);
  Overwrite(changed, at, std::int32_t(size + std::int32_t(with.size()) - std::int32_t(old.size())));
  return changed;
}

vtkSmartPointer<vtkBasisBRDF> MakeBasis(int basis, int order, int nPhi)
{
  const double incident[2] = { 9.1, 57.3 }, outgoing[2] = { 1.0 / 3.0, 80.7 };
  const std::size_t functions = static_cast<std::size_t>((order + 1) * (order + 1));
  std::vector<float> values = MakeValues(3 * functions * 3 * static_cast<std::size_t>(nPhi));
  values[5] = -values[5];
  auto material = vtkSmartPointer<vtkBasisBRDF>::New();
  EXPECT_EQ(material->SetCoefficients(basis, order, incident, outgoing, 3, nPhi, values), "");
  return material;
}
}

//------------------------------------------------------------------------------
TEST(IOMerlRoundTrip, IsExact)
{
  const Folder folder;
  const auto table = MakeMerlTable();
  Write(table, folder("t.binary"));
  EXPECT_EQ(std::filesystem::file_size(folder("t.binary")), 12u + 8u * 3 * 120);
  const vtkSmartPointer<vtkBRDF> brdf = Read(folder("t.binary"));
  auto* back = vtkTabulatedBRDF::SafeDownCast(brdf);
  ASSERT_TRUE(back);
  EXPECT_TRUE(std::equal(back->GetDimensions(), back->GetDimensions() + 3, table->GetDimensions()));
  EXPECT_EQ(back->GetNumberOfInvalidCells(), 1);
  const std::vector<float>& a = table->GetVolume();
  const std::vector<float>& b = back->GetVolume();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    EXPECT_TRUE(a[k] == b[k] || (std::isnan(a[k]) && std::isnan(b[k]))) << k;
  }
  ExpectSameValues(table, back);

  // The file itself comes back byte by byte.
  Write(back, folder("u.binary"));
  EXPECT_EQ(ReadBytes(folder("t.binary")), ReadBytes(folder("u.binary")));
  EXPECT_EQ(folder.CountFiles(), 2u); // nothing partial left
}

//------------------------------------------------------------------------------
TEST(IOMerlRoundTrip, RefusesOtherTables)
{
  const Folder folder;
  const std::string path = folder("t.binary");
  WriteBytes(path, "old");
  vtkNew<vtkLambertBRDF> lambert;
  ExpectWriteRefused(lambert, path, { "MERL", "vtkBRDFResampler" });
  ExpectWriteRefused(
    MakeTable(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::FULL_TURN), path, { "MERL" });
  ExpectWriteRefused(
    MakeTable(vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN), path, { "MERL" });
  const auto weighted = MakeMerlTable();
  weighted->CosineWeightedOn();
  ExpectWriteRefused(weighted, path, { "MERL", "cosine" });
  vtkNew<vtkTabulatedBRDF> negative;
  const int size[3] = { 1, 1, 2 };
  negative->SetVolume(0, 0, size, { 1, 2, 3, 4, -5, 6 });
  ExpectWriteRefused(negative, path, { "1 values", "negative" });
  EXPECT_EQ(ReadBytes(path), "old");
}

//------------------------------------------------------------------------------
TEST(IOWriter, RefusesBadPlaces)
{
  const Folder folder;
  vtkNew<vtkLambertBRDF> lambert;
  ExpectWriteRefused(lambert, "", { "no file name" });
  ExpectWriteRefused(lambert, folder("m.txt"), { ".txt", ".exr or .binary" });
  ExpectWriteRefused(nullptr, folder("m.exr"), { "no material" });
  ExpectWriteRefused(lambert, folder("missing/m.exr"), { "cannot be written" });
  std::filesystem::create_directory(folder("d.exr"));
  ExpectWriteRefused(lambert, folder("d.exr"), { "directory" });
  vtkNew<vtkBasisBRDF> empty;
  ExpectWriteRefused(empty, folder("m.exr"), { "Basis", "'coefficients' is empty" });
  // Nor is it stored as its superclass, which it is not.
  vtkNew<BrokenBRDF> broken;
  ExpectWriteRefused(broken, folder("m.exr"), { "BrokenBRDF has no form" });
  ASSERT_TRUE(vtkBRDFModels::Register(broken));
  ExpectWriteRefused(broken, folder("m.exr"), { "Broken: ", "'albedo'", "not finite" });
  vtkBRDFModels::Unregister(broken);
  vtkNew<SilentBRDF> silent;
  ASSERT_TRUE(vtkBRDFModels::Register(silent));
  ExpectWriteRefused(silent, folder("m.exr"), { "Silent: ", "names no parameters" });
  vtkBRDFModels::Unregister(silent);
  EXPECT_EQ(folder.CountFiles(), 0u);
#if !defined(_WIN32)
  if (geteuid() == 0)
  {
    GTEST_SKIP() << "root may write everywhere; the rest passed";
  }
  std::filesystem::permissions(folder("d.exr"), std::filesystem::perms::owner_read);
  lambert->SetAlbedo(0.5, 0.5, 0.5);
  ExpectWriteRefused(lambert, folder("d.exr/m.exr"), { "cannot be written" });
#endif
}

//------------------------------------------------------------------------------
TEST(IOExrRoundTrip, EveryModelComesBack)
{
  auto materials = MakeEveryModel([](std::size_t count) { return MakeValues(count); });
  ASSERT_FALSE(materials.empty());
  materials.front()->SetName("paper");
  materials.front()->SetResamplingTolerance(0.0123456789012345);
  vtkNew<vtkSumBRDF> empty, inner, sum;
  inner->SetName("inner");
  inner->AddTerm(MakeMerlTable());
  inner->AddTerm(MakeTable(vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::FULL_TURN));
  sum->SetName("outer");
  sum->AddTerm(materials.front());
  sum->AddTerm(inner);
  sum->AddTerm(empty);
  materials.push_back(sum.Get());
  for (const int range : { 0, 1 })
  {
    for (const int parameterization : { 0, 1 })
    {
      const auto table = MakeTable(parameterization, range);
      table->SetPrecision(vtkTabulatedBRDF::FLOAT32);
      table->SetResamplingError(0.1 + 0.2);
      table->SetCosineWeighted(range == 1);
      materials.push_back(table);
    }
    vtkNew<vtkTabulatedBRDF> anisotropic;
    const int size[4] = { 3, 2, 5, 4 };
    ASSERT_TRUE(anisotropic->SetVolume(range, size, MakeValues(3 * 3 * 2 * 5 * 4)));
    anisotropic->SetResamplingError(0.1 + 0.2);
    anisotropic->SetCosineWeighted(range == 1);
    materials.push_back(anisotropic.Get());
  }
  for (const int basis : { 0, 1, 2, 3 })
  {
    const auto material = MakeBasis(basis, basis == 3 ? 20 : basis, basis == 0 ? 1 : 2);
    material->SetIncidentCosine((basis & 1) != 0);
    material->SetOutgoingCosine((basis & 2) != 0);
    material->SetResamplingTolerance(0.3); // small tables: only the file matters
    materials.push_back(material);
  }
  for (vtkBRDF* material : materials)
  {
    RoundTrip(material);
  }
}

//------------------------------------------------------------------------------
// Other programs find red in channel R: writer and reader do not just agree with each other.
TEST(IOExr, ChannelsAreNamedForTheirColors)
{
  const Folder folder;
  const int size[3] = { 2, 1, 1 };
  vtkNew<vtkTabulatedBRDF> table;
  ASSERT_TRUE(table->SetVolume(vtkTabulatedBRDF::HALF_DIFFERENCE, vtkTabulatedBRDF::HALF_TURN, size,
    { 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f }));
  Write(table, folder("table.exr"));
  Imf::MultiPartInputFile file(folder("table.exr").c_str());
  ASSERT_EQ(file.parts(), 1);
  Imf::InputPart part(file, 0);
  for (int channel = 0; channel < 3; ++channel)
  {
    float values[2] = {};
    Imf::FrameBuffer buffer;
    buffer.insert(std::string(1, "RGB"[channel]).c_str(),
      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values), sizeof(float), 2 * sizeof(float)));
    part.setFrameBuffer(buffer);
    part.readPixels(0, 0);
    EXPECT_EQ(values[0], table->GetVolume()[static_cast<std::size_t>(channel)]);
    EXPECT_EQ(values[1], table->GetVolume()[static_cast<std::size_t>(3 + channel)]);
  }
}

//------------------------------------------------------------------------------
TEST(IOExr, CountsValues)
{
  const Folder folder;
  vtkNew<vtkTabulatedBRDF> table;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int size[3] = { 1, 1, 2 };
  ASSERT_TRUE(table->SetVolume(0, 0, size, { 1, -2, 3, 4, nan, 6 }));
  Write(table, folder("t.exr"));
  const auto reader = ReadFile(folder("t.exr"));
  EXPECT_EQ(reader->GetFormatName(), Exr);
  EXPECT_EQ(reader->GetNumberOfNegativeValues(), 1);
  EXPECT_EQ(reader->GetNumberOfInvalidValues(), 3); // the table makes the whole cell NaN
}

//------------------------------------------------------------------------------
TEST(IOExr, RefusesBadFiles)
{
  const Folder folder;
  Write(MakeMerlTable(), folder("t.exr"));
  const std::string good = ReadBytes(folder("t.exr"));
  ExpectTruncationsRefused(folder, good, 1, 5, Exr);

  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(MakeMerlTable());
  sum->AddTerm(MakeMerlTable());
  Write(sum, folder("s.exr"));
  ExpectTruncationsRefused(folder, ReadBytes(folder("s.exr")), 1, 17, Exr);

  const auto change = [&good](const std::string& from, const std::string& to)
  { return Replace(good, from, to); };
  ExpectAllRefused(folder, Exr,
    { { change("measuredBRDF", "measuredBRDX"), { "'measuredBRDF' is missing" } },
      { change("\"measured-brdf\"", "\"measured-bsdf\""),
        { "measured-bsdf", "expected 'measured-brdf'" } },
      { change("\"version\":1", "\"version\":7"), { "version 7" } },
      { change("\"version\":1", "\"version\";1"), { "parse error" } },
      { change("\"Tabulated\"", "\"Tabulatex\""), { "unknown model 'Tabulatex'" } },
      { change("\"half-turn\"", "\"half-torn\""), { "Tabulated", "'azimuthRange'" } },
      { change("\"azimuthRange\"", "\"azimuthRangx\""), { "Tabulated", "'azimuthRange'" } },
      { change("Tolerance\":[0.01]", "Tolerance\":[7.01]"),
        { "'resamplingTolerance' is out of range" } },
      { change("Tolerance\":[0.01]", "Tolerance\":[null]"), { "measuredBRDF" } },
      { change("[4,5,6]", "[4,5,7]"), {} }, { change("[4,5,6]", "[5,5,6]"), {} },
      { change("[4,5,6]", "[0,5,6]"), {} }, { change("[4,5,6]", "[4,5,0]"), {} },
      { change("[4,5,6]", "[-4,5,6]"), {} }, { change("[4,5,6]", "[4,9,9]"), {} },
      { change("\"channels\":3", "\"channels\":1"), { "'volume'", "3 channels" } },
      { change("\"channels\":3", "\"channels\":9"), { "1 or 3 channels" } },
      { change("{\"volume\":", "{\"volvme\":"), { "part 'volvme' is missing" } } });
}

//------------------------------------------------------------------------------
TEST(IOExr, RefusesBadBases)
{
  const Folder folder;
  Write(MakeBasis(2, 3, 2), folder("b.exr"));
  const std::string good = ReadBytes(folder("b.exr"));
  ExpectTruncationsRefused(folder, good, 1, 13, Exr);
  const std::string order = "\"order\":[3.0]";
  const std::string error = "\"resamplingError\":[0.0]";
  const std::string changes[][3] = {
    { order, "\"order\":[2.0]", "'order' is 2, expected that of 16 functions" },
    { order, "\"order\":[3.5]", "'order' is 3.5," },
    { order, "\"order\":[1e9]", "'order' is 1e+09," },
    { order, "\"odder\":[3.0]", "'order' is missing" },
    { "\"incidentEnd\":[57.3]", "\"incidentEnd\":[ 8.3]", "zone 9.1 to 8.3 degrees, expected" },
    { "\"zonal\"", "\"tonal\"", "'basis'" },
    { "\"incidentCosine\":\"off\"", "\"incidentCosine\":\"odd\"", "'incidentCosine'" },
    { error, "\"resamplingError\":[-5 ]", "'resamplingError' is out of range: -5" },
    { error, "\"resamplingError\":[NaN]", "measuredBRDF" },
  };
  for (const auto& [from, to, word] : changes)
  {
    ExpectBytesRefused(folder, Replace(good, from, to), { Exr, word });
  }
  // A claim is refused before the values are read: the message is not that of the part's window.
  ExpectBytesRefused(folder, ReplaceInJson(good, "[16,3,2]", "[441,9999,9999]"),
    { Exr, "Basis", "1.32274e+11", "at most 67108864" });
}

//------------------------------------------------------------------------------
TEST(IOExr, RefusesSizesThatLie)
{
  const Folder folder;
  Write(MakeMerlTable(), folder("t.exr"));
  const std::string good = ReadBytes(folder("t.exr"));
  const std::string name("dataWindow\0box2i\0", 17);
  const std::size_t window = good.find(name) + name.size() + 4;
  for (const std::int32_t lie : { -1, 1 << 20, 1 << 30, std::numeric_limits<std::int32_t>::max(),
         std::numeric_limits<std::int32_t>::min() })
  {
    for (const std::size_t corner : { 0, 4, 8, 12 })
    {
      std::string bytes = good;
      Overwrite(bytes, window + corner, lie);
      ExpectBytesRefused(folder, bytes, { Exr });
    }
  }
  // Window and JSON agree on far more than so short a file can hold.
  std::string bytes = ReplaceInJson(good, "[4,5,6]", "[4,5,99999999]");
  Overwrite(bytes, bytes.find(name) + name.size() + 4 + 8, std::int32_t(99999998));
  ExpectBytesRefused(folder, bytes, { Exr, "'volume'", "more than a file of this length" });
}

//------------------------------------------------------------------------------
// OpenEXR allocates what an attribute claims before it reads it.
TEST(IOExr, RefusesAttributesThatLie)
{
  const Folder folder;
  vtkNew<vtkSumBRDF> sum;
  sum->AddTerm(MakeMerlTable());
  sum->AddTerm(MakeMerlTable());
  const double before = GetPeakMemory();
  const auto table = MakeMerlTable();
  for (vtkBRDF* material : std::initializer_list<vtkBRDF*>{ table, sum })
  {
    Write(material, folder("t.exr"));
    const std::string good = ReadBytes(folder("t.exr"));
    // The last header's attributes are looked at too.
    for (const std::string type :
      { "measuredBRDF\0string\0"s, "name\0string\0"s, "channels\0chlist\0"s })
    {
      SCOPED_TRACE(type);
      const std::size_t size = good.rfind(type) + type.size();
      for (const std::uint32_t lie : { 0x7fffffffu, 0xffffffffu, std::uint32_t(good.size()) })
      {
        std::string bytes = good;
        Overwrite(bytes, size, lie);
        ExpectBytesRefused(folder, bytes,
          { Exr + ", attribute '" + type.substr(0, type.find('\0')) + "' at byte " +
            std::to_string(size + 4) + ": needs " + std::to_string(lie) + " bytes" });
      }
    }
    // Values that hold sizes: put in as the first attribute.
    const auto insert = [&](const std::string& type, const std::vector<std::uint32_t>& value)
    {
      std::string attribute = "lie" + std::string(1, '\0') + type + std::string(1, '\0');
      Append(attribute, std::uint32_t(4 * value.size()));
      for (const std::uint32_t number : value)
      {
        Append(attribute, number);
      }
      std::string bytes = good;
      return bytes.insert(8, attribute);
    };
    ExpectBytesRefused(folder, insert("preview", { 20000, 20000, 0 }),
      { Exr, "attribute 'lie' at byte ", "20000 x 20000", "after 1 texels" });
    ExpectBytesRefused(folder, insert("preview", { 20000 }), { Exr, "'lie'" });
    ExpectBytesRefused(folder, insert("stringvector", { 0x7fffffff, 0 }),
      { Exr, "attribute 'lie' at byte ", "needs 2147483647 bytes" });
    // Whatever the size claims, OpenEXR takes what follows an int's four bytes, or a list's last
    // channel, for the next attribute.
    ExpectBytesRefused(folder, insert("int", { 1, 2, 3 }),
      { Exr, "attribute 'lie' at byte ", "found 12 bytes of type 'int', expected 4" });
    ExpectBytesRefused(folder, insert("chlist", { 0, 0 }),
      { Exr, "attribute 'lie' at byte ", "found 8 bytes of type 'chlist', expected 1" });
  }
  EXPECT_LT(GetPeakMemory() - before, 2e8);
}
