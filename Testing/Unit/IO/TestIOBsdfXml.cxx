// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// BSDF XML files of Radiance and WINDOW: reflection and transmission.

#include "HalfVector.h"
#include "NumberText.h"
#include "SmallBsdfXml.h"
#include "TestDirections.h"
#include "TestIOHelpers.h"

#include "vtkAngleBasisBRDF.h"
#include "vtkBRDFReader.h"
#include "vtkBTDF.h"
#include "vtkNew.h"
#include "vtkTensorTreeBRDF.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

using namespace testio;

namespace
{
const std::filesystem::path Traced = MEASUREDBRDF_TEST_DATA "/Transmission";
using measuredbrdf::Pi;

double Evaluate(vtkBTDF* btdf, const glm::dvec3& i, const glm::dvec3& o)
{
  glm::dvec3 f;
  btdf->Evaluate(&i.x, &o.x, &f.x);
  EXPECT_EQ(f.x, f.y);
  EXPECT_EQ(f.x, f.z);
  return f.x;
}

double GetTransmittance(vtkBTDF* btdf, const glm::dvec3& i)
{
  glm::dvec3 rgb;
  btdf->GetTransmittance(&i.x, &rgb.x);
  return rgb.y;
}

double GetSkyTransmittance(vtkBTDF* btdf, const glm::dvec3& o)
{
  glm::dvec3 rgb;
  btdf->GetSkyTransmittance(&o.x, &rgb.x);
  return rgb.y;
}

// Of a file that holds reflection, too.
vtkSmartPointer<vtkBTDF> ReadTransmission(const std::string& path)
{
  return ReadFile(path)->GetTransmission();
}

// "Transmission Back" is 7 + 0.01 k there already.
std::string MakeBothSides(const std::string& structure = "Columns")
{
  return MakeBsdfXml(structure, MakeBsdfXmlBlock("Visible", "Transmission Front", 0.02, 0.001));
}

// The directions of the five patches: as they are, and as the view's that are continued through the
// surface.
glm::dvec3 GetLight(int patch, bool below)
{
  const double theta = patch == 0 ? 20.0 : 50.0;
  return FromDegrees(below ? 180.0 - theta : theta, 90.0 * (patch - 1) + 40.0);
}

glm::dvec3 GetView(int patch, bool below)
{
  const double theta = patch == 0 ? 25.0 : 80.0;
  return FromDegrees(below ? 180.0 - theta : theta, 90.0 * (patch - 1) + 180.0 - 40.0);
}

// The three blocks of reflection under another name.
std::string HideReflection(std::string text)
{
  for (const char* block : { ">Reflection Back", ">Reflection Front", ">Reflection Back" })
  {
    text = Replace(text, block, ">Refraction");
  }
  return text;
}
}

//------------------------------------------------------------------------------
// Patch 0 is about the normal; 1 to 4 at 0, 90, 180 and 270 degrees. Columns are of the view turned
// by half a turn: mirror directions lie on the diagonal.
TEST(IOBsdfXml, Reads)
{
  const Folder folder;
  for (const char* structure : { "Columns", "Rows" })
  {
    const auto reader = ReadFile(WriteBytes(folder("a.xml"), MakeBsdfXml(structure)));
    EXPECT_EQ(reader->GetFormatName(), BsdfXmlFormat);
    auto* brdf = vtkAngleBasisBRDF::SafeDownCast(reader->GetBRDF());
    ASSERT_TRUE(brdf);
    EXPECT_EQ(brdf->GetName(), "Grate & shade");
    const bool turned = structure[0] == 'R';
    const auto value = [&](int row, int column)
    { return 0.1 + 0.01 * (turned ? 5 * column + row : 5 * row + column); };
    for (int row = 0; row < 5; ++row)
    {
      for (int column = 0; column < 5; ++column)
      {
        EXPECT_NEAR(
          Evaluate(brdf, GetLight(row, false), GetView(column, false)).x, value(row, column), 1e-6)
          << row << " " << column;
      }
    }
    ExpectNote(reader, "no color");
    ExpectNote(reader, "Transmission is read, too");
  }
  EXPECT_EQ(vtkNew<vtkBRDFReader>()->GetMaterialNames(), std::vector<std::string>());
}

//------------------------------------------------------------------------------
TEST(IOBsdfXml, ReadsEitherSide)
{
  const Folder folder;
  WriteBytes(folder("a.xml"), MakeBsdfXml());
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(folder("a.xml"));
  EXPECT_EQ(reader->GetMaterialNames(), (std::vector<std::string>{ "front", "back" }));
  const glm::dvec3 up(0.0, 0.0, 1.0);
  for (const auto& [name, value] :
    { std::pair<std::string, double>{ "", 0.1 }, { "#front", 0.1 }, { "#back", 0.5 } })
  {
    reader->SetFileName(folder("a.xml") + name);
    ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
    EXPECT_NEAR(Evaluate(reader->GetBRDF(), up, up).y, value, 1e-6) << name;
  }
  reader->SetFileName(folder("a.xml") + "#left");
  EXPECT_FALSE(reader->Read());
  EXPECT_NE(
    reader->GetErrorMessage().find("'#left', only of '#front' and '#back'"), std::string::npos)
    << reader->GetErrorMessage();
}

//------------------------------------------------------------------------------
// What reflects X, Y and Z alike is gray, as in Radiance. And a color, by another program (numpy).
TEST(IOBsdfXml, ReadsColor)
{
  const Folder folder;
  const glm::dvec3 expected[2] = { glm::dvec3(0.16),
    0.8 * glm::dvec3(0.5626379, 0.0964693, 0.0912599) };
  for (const bool gray : { true, false })
  {
    std::string more =
      MakeBsdfXmlBlock("cie-x", "reflection back", gray ? 0.1 : 0.24, gray ? 0.01 : 0.0);
    more += MakeBsdfXmlBlock("CIE-Z", "Reflection Back", gray ? 0.1 : 0.08, gray ? 0.01 : 0.0);
    const auto reader = ReadFile(WriteBytes(folder("a.xml"), MakeBsdfXml("Columns", more)));
    ExpectNote(reader, "no color", false);
    const glm::dvec3 f = Evaluate(reader->GetBRDF(), FromDegrees(50, 0), FromDegrees(50, 180));
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(f[c], expected[gray ? 0 : 1][c], 1e-6) << c;
    }
  }
}

//------------------------------------------------------------------------------
// Radiance's genBSDF may leave a line of its own there; its readers skip it.
TEST(IOBsdfXml, SkipsChatterBeforeTheDeclaration)
{
  const Folder folder;
  for (const std::string& chatter :
    { std::string("Recover using: genBSDF -recover folder\n"), std::string("\n") })
  {
    const auto reader = ReadFile(WriteBytes(folder("a.xml"), chatter + MakeBsdfXml()));
    ExpectNote(reader, std::to_string(chatter.size()) + " bytes before the XML");
  }
}

//------------------------------------------------------------------------------
TEST(IOBsdfXml, AsksForDecimalCommas)
{
  const Folder folder;
  ExpectBytesRefused(folder, MakeBsdfXmlTree(3, "{ 0,3183 }"),
    { BsdfXmlFormat, "a leaf has 2 values", "decimal commas", "line 1, column " });
}

//------------------------------------------------------------------------------
TEST(IOBsdfXml, RefusesBadFiles)
{
  const Folder folder;
  const std::string good = MakeBsdfXml();
  const std::size_t root = good.find("<WindowElement") + 14;
  ExpectTruncationsRefused(folder, good.substr(0, good.size() - 1), root, 97, BsdfXmlFormat);
  const auto change = [&good](const std::string& from, const std::string& to)
  { return Replace(good, from, to); };
  ExpectAllRefused(folder, BsdfXmlFormat,
    { { change("<Optical>", "<Optical"), { "well-formed" } },
      { change("<Optical>", "<Optical>\n <Name>Smith < Sons</Name>"),
        { "line 4, column 15", "well-formed", "' Sons</Name>" } },
      { change("<Optical>", "<Optical>\n <Name>Smith & Sons</Name>"),
        { "line 4, column 14", "well-formed", "'& Sons</Name>", "&amp;" } },
      { good + "<a/>", { "well-formed", "second root", "'<a/>" } },
      { change("0.110000,", "0,11, "), { "more than the 25" } }, // others have points
      { change("0.110000", "0.11x"), { "Reflection Back", "value 1", "0.11x", "a number" } },
      { change("0.110000", "nan"), { "value 1", "nan" } },
      { change("0.110000,", ""), { "found 24 values, expected 25" } },
      { change("0.110000", "0.1 0.2"), { "more than the 25" } },
      { change("7.010000", "nan"), { "ScatteringData of 'Transmission Back'", "value 1" } },
      { change("Columns", "TensorTree5"), { "IncidentDataStructure", "TensorTree5" } },
      { change("<AngleBasisName>Five", "<AngleBasisName>Six"),
        { "AngleBasis", "does not define", "Five" } },
      { change("<LowerTheta>30", "<LowerTheta>31"), { "ring 1", "LowerTheta", "31" } },
      { change("<UpperTheta>90", "<UpperTheta>80"), { "80", "expected 90" } } });
  for (const char* count : { "0", "-4", "2.5", "1e9", "many", "" })
  {
    ExpectBytesRefused(folder, Replace(good, "<nPhis>4", std::string("<nPhis>") + count),
      { BsdfXmlFormat, "ring 1", "nPhis" });
  }
  std::string rings;
  for (int k = 0; k < 5000; ++k)
  {
    rings += "<AngleBasisBlock><nPhis>4096</nPhis><ThetaBounds><LowerTheta>" +
             measuredbrdf::FixedText(0.001 * k, 6) + "</LowerTheta><UpperTheta>" +
             measuredbrdf::FixedText(0.001 * (k + 1), 6) +
             "</UpperTheta></ThetaBounds></AngleBasisBlock>";
  }
  ExpectBytesRefused(folder,
    Replace(good, "<AngleBasisBlock><Theta>0", rings + "<AngleBasisBlock><Theta>0"),
    { BsdfXmlFormat, "AngleBasis", "at most 4096 patches" });
  ExpectBytesRefused(folder, Replace(HideReflection(good), ">Transmission Back", ">Refraction"),
    { BsdfXmlFormat, "found 4 blocks, none of them of visible light" });
  // Texts that grow without bound, and towers of elements.
  ExpectBytesRefused(folder,
    Replace(
      good, "<!-- made by a test -->", "<!DOCTYPE a [<!ENTITY b \"cc\"><!ENTITY d \"&b;&b;\">]>"),
    { BsdfXmlFormat, "document type" });
  ExpectBytesRefused(folder, good + std::string(1, '\0'), { BsdfXmlFormat, "zero byte" });
  std::string tower, closed;
  for (int k = 0; k < 100000; ++k)
  {
    tower += "<a>";
    closed += "</a>";
  }
  ExpectBytesRefused(folder, Replace(good, "<Optical>", "<Optical>" + tower + closed),
    { BsdfXmlFormat, "deeply", "line 3, " });
}

//------------------------------------------------------------------------------
// The first axis of three is the view's: child 0, bit 0 not set, is where |v| is near 1. The other
// two are the light's, turned so that the mirror direction is towards +x.
TEST(IOBsdfXml, ReadsTensorTrees)
{
  const Folder folder;
  const std::string eighths = "{ 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 }";
  WriteBytes(
    folder("a.xml"), MakeBsdfXmlTree(3, "{" + eighths + "{1}" + eighths + "{3}{4},{5} {6} {7}}"));
  const auto reader = ReadFile(folder("a.xml"));
  auto* brdf = vtkTensorTreeBRDF::SafeDownCast(reader->GetBRDF());
  ASSERT_TRUE(brdf);
  EXPECT_TRUE(brdf->IsIsotropic());
  // The view's coordinate is 0.33, in the lower half. The light's radius is 0.64.
  const glm::dvec3 o = FromDegrees(20.0, 70.0);
  const auto at = [&](double phi)
  { return Evaluate(brdf, FromDegrees(40.0, 70.0 + 180.0 + phi), o).x; };
  EXPECT_NEAR(at(1.0), 6.0, 1e-6);    // x and y in the upper halves
  EXPECT_NEAR(at(-1.0), 0.8, 1e-6);   // x in the upper half: child 2, its last cell
  EXPECT_NEAR(at(179.0), 4.0, 1e-6);  // y in the upper half
  EXPECT_NEAR(at(-179.0), 0.6, 1e-6); // child 0, cell (1, 0, 1)
  // Along the normal, where the coordinate ends: nothing lies in the upper half.
  EXPECT_NEAR(Evaluate(brdf, FromDegrees(40.0, 1.0), { 0.0, 0.0, 1.0 }).x, 6.0, 1e-6);
  ExpectNote(reader, "visible light");

  // Four axes: a single cell, and two halves along the last one, the light's y.
  std::string cells = "{";
  for (int k = 0; k < 16; ++k)
  {
    cells += "{" + std::to_string(k) + "}";
  }
  WriteBytes(folder("b.xml"), MakeBsdfXmlTree(4, cells + "}"));
  reader->SetFileName(folder("b.xml"));
  ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
  EXPECT_FALSE(reader->GetBRDF()->IsIsotropic());
  for (int k = 0; k < 16; ++k)
  {
    const auto sign = [k](int bit) { return (k >> bit & 1) != 0 ? 0.4 : -0.4; };
    const glm::dvec3 o(-sign(0), -sign(1), std::sqrt(0.68));
    const glm::dvec3 i(sign(2), sign(3), std::sqrt(0.68));
    EXPECT_NEAR(Evaluate(reader->GetBRDF(), i, o).x, k, 1e-6);
  }
}

//------------------------------------------------------------------------------
TEST(IOBsdfXml, RefusesBadTrees)
{
  const Folder folder;
  const auto refuse = [&](const std::string& tree, const std::string& what)
  {
    ExpectBytesRefused(folder, MakeBsdfXmlTree(3, tree),
      { BsdfXmlFormat, "ScatteringData of 'Reflection Back'", what });
  };
  refuse("", "0 braces open");
  refuse("1", "found '1'");
  refuse("{1", "1 braces open");
  refuse("{1}{1}", "more follows");
  refuse("{1 2}", "2 values");
  refuse("{}", "0 values");
  refuse("{{1}{2}}", "2 children");
  refuse("{{1}{2}{3}{4}{5}{6}{7}{8} 9}", "1 values");
  refuse("{x}", "found 'x'");
  refuse("{1e99}", "1e99");
  refuse(std::string(100000, '{'), "too deeply");
}

//------------------------------------------------------------------------------
// Against Radiance's own rtrace.
TEST(IOBsdfXml, AgreesWithRadiance)
{
  const std::filesystem::path folder = SharedData;
  if (!std::filesystem::is_directory(folder / "materials/radiance"))
  {
    GTEST_SKIP() << "no shared data";
  }
  for (const char* name : { "2011-SA1", "metalGrate", "t3" })
  {
    const auto reader = ReadFile((folder / "materials/radiance" / name).string() + ".xml");
    const auto rows = ReadCsv((folder / "expected" / (std::string(name) + ".pairs.csv")).string());
    double largest = 0.0;
    for (const std::vector<double>& row : rows)
    {
      const glm::dvec3 f(row[6], row[7], row[8]);
      const glm::dvec3 found =
        Evaluate(reader->GetBRDF(), { row[0], row[1], row[2] }, { row[3], row[4], row[5] });
      const glm::dvec3 differences = glm::abs(found - f) / f;
      largest = std::max({ largest, differences.x, differences.y, differences.z });
    }
    std::printf("%s: %zu pairs, largest relative difference %.2g\n", name, rows.size(), largest);
    EXPECT_GT(rows.size(), 300u);
    EXPECT_LT(largest, 1e-3);
  }
}

//------------------------------------------------------------------------------
// Radiance takes the view for the direction of incidence: light on its front is in the file's
// "Front", which is Radiance's back, by row.
TEST(IOTransmission, ReadsMatrices)
{
  const Folder folder;
  for (const std::string& structure : { std::string("Columns"), std::string("Rows") })
  {
    WriteBytes(folder("a.xml"), MakeBothSides(structure));
    for (const std::string& side : { std::string("#front"), std::string("#back") })
    {
      const auto btdf = ReadTransmission(folder("a.xml") + side);
      ASSERT_TRUE(btdf);
      EXPECT_FALSE(btdf->IsIsotropic());
      for (int row = 0; row < 5; ++row)
      {
        for (int column = 0; column < 5; ++column)
        {
          const int k = structure == "Rows" ? 5 * column + row : 5 * row + column;
          const bool below = side == "#back"; // where the file's "Front" has its light
          EXPECT_NEAR(
            Evaluate(btdf, GetLight(row, below), GetView(column, !below)), 0.02 + 0.001 * k, 1e-6);
          EXPECT_NEAR(
            Evaluate(btdf, GetLight(row, !below), GetView(column, below)), 7.0 + 0.01 * k, 1e-6);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Sums over rows and columns with the patches' projected solid angles.
TEST(IOTransmission, TransmittanceIsTheMatrixSum)
{
  const Folder folder;
  WriteBytes(folder("a.xml"), MakeBothSides());
  const auto btdf = ReadTransmission(folder("a.xml"));
  ASSERT_TRUE(btdf);
  const double solid[5] = { Pi / 4.0, 3.0 * Pi / 16.0, 3.0 * Pi / 16.0, 3.0 * Pi / 16.0,
    3.0 * Pi / 16.0 };
  for (int patch = 0; patch < 5; ++patch)
  {
    double row = 0.0;
    double column = 0.0;
    for (int k = 0; k < 5; ++k)
    {
      row += (0.02 + 0.001 * (5 * patch + k)) * solid[k];
      column += (7.0 + 0.01 * (5 * k + patch)) * solid[k];
    }
    EXPECT_NEAR(GetTransmittance(btdf, GetLight(patch, false)), row, 1e-6);
    EXPECT_NEAR(GetSkyTransmittance(btdf, GetView(patch, false)), column, 1e-5);
  }
}

//------------------------------------------------------------------------------
// One block stands for light on both sides.
TEST(IOTransmission, UsesReciprocityForTheMissingSide)
{
  const Folder folder;
  WriteBytes(folder("a.xml"), MakeBsdfXml());
  const auto btdf = ReadTransmission(folder("a.xml"));
  ASSERT_TRUE(btdf);
  EXPECT_EQ(btdf->GetFolded(vtkBTDF::FRONT), nullptr);
  ASSERT_TRUE(btdf->GetFolded(vtkBTDF::BACK));
  EXPECT_NEAR(Evaluate(btdf, GetView(2, false), GetLight(4, true)), 7.0 + 0.01 * 22, 1e-6);
  EXPECT_NEAR(Evaluate(btdf, GetLight(4, true), GetView(2, false)), 7.0 + 0.01 * 22, 1e-6);
}

//------------------------------------------------------------------------------
TEST(IOTransmission, ReadsTensorTrees)
{
  const Folder folder;
  std::string cells = "{";
  for (int k = 0; k < 16; ++k)
  {
    cells += "{" + std::to_string(k) + "}";
  }
  cells += "}";
  WriteBytes(
    folder("a.xml"), MakeBsdfXmlTree(4, "{1}", MakeBsdfXmlTreeBlock("transmission front", cells)));
  const auto btdf = ReadTransmission(folder("a.xml"));
  ASSERT_TRUE(btdf);
  EXPECT_FALSE(btdf->IsIsotropic());
  for (int k = 0; k < 16; ++k)
  {
    const auto sign = [k](int bit) { return (k >> bit & 1) != 0 ? 0.4 : -0.4; };
    const glm::dvec3 o(-sign(0), -sign(1), -std::sqrt(0.68));
    const glm::dvec3 i(sign(2), sign(3), std::sqrt(0.68));
    EXPECT_NEAR(Evaluate(btdf, i, o), k, 1e-6);
    EXPECT_NEAR(Evaluate(btdf, o, i), k, 1e-6);
    // The other four values have the same two bits of the light, each over a quarter of pi.
    EXPECT_NEAR(GetTransmittance(btdf, i), Pi / 4.0 * (4 * (k & 12) + 6), 1e-4);
    EXPECT_NEAR(GetSkyTransmittance(btdf, o), Pi / 4.0 * (4 * (k & 3) + 24), 1e-4); // the light's
  }
}

//------------------------------------------------------------------------------
TEST(IOTransmission, NegativeValuesCountAsZero)
{
  const Folder folder;
  WriteBytes(
    folder("a.xml"), Replace(Replace(MakeBothSides(), "0.020000", "-0.5"), "0.021000", "-0.5"));
  const auto reader = ReadFile(folder("a.xml"));
  ExpectNote(reader, "Negative values of 'Transmission Front', which count as 0: 2");
  EXPECT_EQ(reader->GetNumberOfNegativeValues(), 0) << "those of reflection";
  EXPECT_EQ(Evaluate(reader->GetTransmission(), { 0, 0, 1 }, { 0, 0, -1 }), 0.0);
  EXPECT_NEAR(
    GetTransmittance(reader->GetTransmission(), { 0, 0, 1 }), 0.069 * 3.0 * Pi / 16.0, 1e-6);
}

//------------------------------------------------------------------------------
// Transmission belongs to the file that was read last; of transmission only there is no material.
TEST(IOTransmission, IsOfferedBesideReflection)
{
  const Folder folder;
  WriteBytes(folder("only.xml"), HideReflection(MakeBothSides()));
  WriteBytes(folder("both.xml"), MakeBothSides());
  WriteBytes(folder("none.xml"), MakeBsdfXmlTree(3, "{1}"));
  WriteBytes(folder("bad.xml"), "<WindowElement>");
  vtkNew<vtkBRDFReader> reader;
  EXPECT_EQ(reader->GetTransmission(), nullptr);
  vtkNew<ErrorCounter> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto read = [&](const std::string& name, const std::string& error)
  {
    reader->SetFileName(folder(name));
    EXPECT_EQ(reader->Read(), error.empty());
    EXPECT_NE(reader->GetErrorMessage().find(error), std::string::npos)
      << reader->GetErrorMessage();
  };
  for (const auto& [side, value] :
    { std::pair<std::string, double>{ "", 0.02 }, { "#front", 0.02 }, { "#back", 7.0 } })
  {
    read("only.xml" + side, "transmission only");
    EXPECT_EQ(reader->GetBRDF(), nullptr);
    ASSERT_TRUE(reader->GetTransmission());
    EXPECT_NEAR(Evaluate(reader->GetTransmission(), { 0, 0, 1 }, { 0, 0, -1 }), value, 1e-6);
  }
  read("only.xml#left", "'#left'");
  read("both.xml", "");
  vtkBTDF* both = reader->GetTransmission();
  vtkBRDF* reflection = reader->GetBRDF();
  EXPECT_TRUE(both && reflection);
  read("bad.xml", "bad.xml");
  EXPECT_EQ(reader->GetTransmission(), both) << "what was read before stays";
  read("only.xml", "transmission only");
  EXPECT_EQ(reader->GetBRDF(), reflection);
  EXPECT_NE(reader->GetTransmission(), both);
  ExpectNote(reader, "Transmission");
  read("none.xml", "");
  EXPECT_EQ(reader->GetTransmission(), nullptr);
  ExpectNote(reader, "Transmission", false);
  EXPECT_EQ(errors->Count, 6);
}

//------------------------------------------------------------------------------
// Against Radiance's own rtrace (trace_transmission.py).
TEST(IOTransmission, AgreesWithRadiance)
{
  if (!std::filesystem::is_directory(std::filesystem::path(SharedData) / "materials/radiance"))
  {
    GTEST_SKIP() << "no shared data";
  }
  for (const char* name : { "2011-SA1", "metalGrate", "t3" })
  {
    const auto btdf = ReadTransmission(
      (std::filesystem::path(SharedData) / "materials/radiance" / name).string() + ".xml");
    ASSERT_TRUE(btdf) << name;
    double largest = 0.0;
    int pairs[2] = { 0, 0 };
    for (const auto& row : ReadCsv((Traced / (std::string(name) + ".csv")).string()))
    {
      const glm::dvec3 i(row[0], row[1], row[2]);
      const double f = Evaluate(btdf, i, { row[3], row[4], row[5] });
      largest = std::max(largest, std::abs(f - row[6]) / row[6]);
      ++pairs[i.z > 0.0 ? 0 : 1];
    }
    std::printf("%s: largest relative difference %.2g\n", name, largest);
    EXPECT_EQ(pairs[0], 20);
    EXPECT_EQ(pairs[1], 20);
    EXPECT_LT(largest, 1e-3);
  }
}
