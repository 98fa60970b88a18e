// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What BSDF XML files of Radiance and WINDOW say of transmission.

#include "HalfVector.h"
#include "SmallBsdfXml.h"
#include "TestDirections.h"
#include "TestIOHelpers.h"

#include "vtkBRDFReader.h"
#include "vtkBTDF.h"
#include "vtkNew.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
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
  std::string only = MakeBothSides();
  for (const char* block : { ">Reflection Back", ">Reflection Front", ">Reflection Back" })
  {
    only = Replace(only, block, ">Refraction");
  }
  WriteBytes(folder("only.xml"), only);
  WriteBytes(folder("both.xml"), MakeBothSides());
  WriteBytes(folder("none.xml"), MakeBsdfXmlTree(3, "{1}"));
  WriteBytes(folder("bad.xml"), "<WindowElement>");
  vtkNew<vtkBRDFReader> reader;
  EXPECT_EQ(reader->GetTransmission(), nullptr);
  vtkObject::GlobalWarningDisplayOff();
  for (const char* side : { "", "#front", "#back" })
  {
    reader->SetFileName(folder("only.xml") + side);
    EXPECT_FALSE(reader->Read());
    EXPECT_NE(reader->GetErrorMessage().find("transmission only"), std::string::npos)
      << reader->GetErrorMessage();
    EXPECT_EQ(reader->GetBRDF(), nullptr);
    ASSERT_TRUE(reader->GetTransmission());
    EXPECT_NEAR(Evaluate(reader->GetTransmission(), { 0, 0, 1 }, { 0, 0, -1 }),
      side[0] != 0 && side[1] == 'b' ? 7.0 : 0.02, 1e-6);
  }
  reader->SetFileName(folder("only.xml") + "#left");
  EXPECT_FALSE(reader->Read());
  EXPECT_NE(reader->GetErrorMessage().find("'#left'"), std::string::npos);
  reader->SetFileName(folder("both.xml"));
  EXPECT_TRUE(reader->Read());
  vtkBTDF* both = reader->GetTransmission();
  EXPECT_TRUE(both);
  EXPECT_TRUE(reader->GetBRDF());
  reader->SetFileName(folder("bad.xml"));
  EXPECT_FALSE(reader->Read());
  EXPECT_EQ(reader->GetTransmission(), both) << "what was read before stays";
  vtkBRDF* reflection = reader->GetBRDF();
  reader->SetFileName(folder("only.xml"));
  EXPECT_FALSE(reader->Read());
  EXPECT_EQ(reader->GetBRDF(), reflection);
  EXPECT_NE(reader->GetTransmission(), both);
  ExpectNote(reader, "Transmission");
  vtkObject::GlobalWarningDisplayOn();
  reader->SetFileName(folder("none.xml"));
  EXPECT_TRUE(reader->Read());
  EXPECT_EQ(reader->GetTransmission(), nullptr);
  ExpectNote(reader, "Transmission", false);
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
