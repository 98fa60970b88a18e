// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// ASTM E1392 text: written here of formulas, because no measured file was at hand.

#include "AngleFormula.h"
#include "HalfVector.h"
#include "NumberText.h"
#include "SpectraForTests.h"
#include "TestIOHelpers.h"

#include <sstream>

namespace
{
using namespace testio;

const std::string AstmFormat = "ASTM E1392 text";

// A row for each reading of a grid; write: the numbers of (thetaI, phiI, thetaO, phiO), degrees.
std::string MakeRows(const std::vector<double>& phiI, const std::vector<double>& phi,
  const std::function<void(std::ostream&, double, double, double, double)>& write,
  const char* end = "\n")
{
  measuredbrdf::TextStream rows;
  rows.precision(9);
  for (const double thetaI : { 0.0, 40.0, 90.0 })
  {
    for (const double p : phiI)
    {
      for (const double thetaO : { 0.0, 25.0, 90.0 })
      {
        for (const double q : phi)
        {
          write(rows, thetaI, p, thetaO, q);
          rows << end;
        }
      }
    }
  }
  return rows.str();
}

const std::vector<double> HalfTurn = { 0.0, 50.0, 100.0, 180.0 };

// A file in degrees of the values under these names.
std::string MakeAstm(const std::string& names,
  const std::function<std::vector<double>(double, double, double, double)>& getValues,
  const std::vector<double>& phiI = { 0.0 }, const std::vector<double>& phi = HalfTurn)
{
  return "VARS theta_i,phi_i,theta_s,phi_s," + names + "\n" +
         MakeRows(phiI, phi,
           [&](std::ostream& os, double i, double p, double o, double q)
           {
             os << i << "," << p << "," << o << "," << q;
             for (const double value : getValues(i, p, o, q))
             {
               os << "," << value;
             }
           });
}

//------------------------------------------------------------------------------
// Cornell's: radians, azimuths from -pi to pi, R,G,B.
TEST(IOAstm, InterpolatesOnAGrid)
{
  const Folder folder;
  const std::string rows = MakeRows({ 30.0 }, { -150.0, -100.0, -50.0, 0.0, 30.0, 100.0, 180.0 },
    [](std::ostream& os, double i, double p, double o, double q)
    {
      const double f = Shape(i, o, q - p);
      os << measuredbrdf::ToRadians(i) << "," << measuredbrdf::ToRadians(p) << ","
         << measuredbrdf::ToRadians(o) << "," << measuredbrdf::ToRadians(q) << "," << f << ","
         << 2.0 * f << "," << 3.0 * f;
    });
  WriteBytes(folder("paint.astm"),
    "SAMPLE a painted plate\nNUM_POINTS 63\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n" + rows);
  const auto reader = ReadFile(folder("paint.astm"));
  EXPECT_EQ(reader->GetFormatName(), AstmFormat);
  EXPECT_EQ(reader->GetBRDF()->GetName(), "paint");
  EXPECT_TRUE(reader->GetBRDF()->IsIsotropic());
  for (const char* part : { "SAMPLE a painted plate", "radians" })
  {
    ExpectNote(reader, part);
  }
  const double color[3] = { 1.0, 2.0, 3.0 };
  ExpectFormula(reader->GetBRDF(), color, 1e-5);
}

//------------------------------------------------------------------------------
// Degrees, one side of the plane of incidence, columns in another order, an editor's traces.
TEST(IOAstm, TakesOtherWaysOfWritingIt)
{
  const Folder folder;
  const std::string rows = MakeRows(
    { 0.0 }, HalfTurn,
    [](std::ostream& os, double i, double, double o, double q)
    { os << "+" << q << " , " << Shape(i, o, q) << "," << o << "," << i; },
    "\r\n\r\n");
  const auto reader =
    ReadFile(WriteBytes(folder("a.txt"), "\xef\xbb\xbf"
                                         " VARS\tphi_s, Integrated, theta_s, theta_i\r\n" +
                                           rows + std::string("\x1a")));
  for (const char* part : { "degrees", "mirrored", "column 'Integrated'" })
  {
    ExpectNote(reader, part);
  }
  const double gray[3] = { 1.0, 1.0, 1.0 };
  ExpectFormula(reader->GetBRDF(), gray, 1e-6);
}

//------------------------------------------------------------------------------
// In the plane of incidence, with a view that swings through the normal.
TEST(IOAstm, NegativePolarAnglesAreOnTheOtherSide)
{
  const Folder folder;
  std::string rows;
  for (const double i : { 0.0, 40.0, 90.0 })
  {
    for (const double o : { -90.0, -25.0, 0.0, 25.0, 90.0 })
    {
      const double phi = o < 0.0 ? 0.0 : 180.0; // from the light's
      rows += measuredbrdf::FixedText(i, 6) + ",0," + measuredbrdf::FixedText(o, 6) + ",180," +
              measuredbrdf::FixedText(Shape(i, std::abs(o), o == 0.0 ? 0.0 : phi), 6) + "\n";
    }
  }
  const auto brdf =
    Read(WriteBytes(folder("a.astm"), "VARS theta_i,phi_i,theta_s,phi_s,BRDF\n" + rows));
  const double gray[3] = { 1.0, 1.0, 1.0 };
  ExpectFormula(brdf, gray, 2e-6); // between the two half planes linear, as the formula
}

//------------------------------------------------------------------------------
TEST(IOAstm, SpectraAndXYZBecomeColors)
{
  const Folder folder;
  for (const TestSpectrum& spectrum : TestSpectra)
  {
    SCOPED_TRACE(spectrum.Name);
    const double color[3] = { std::max(spectrum.RGB[0], 0.0), std::max(spectrum.RGB[1], 0.0),
      std::max(spectrum.RGB[2], 0.0) };
    std::string names = "905nm";        // infrared, which does not count
    for (int l = 780; l >= 380; l -= 2) // in descending order
    {
      names += "," + std::to_string(l) + "nm";
    }
    WriteBytes(folder("a.astm"), MakeAstm(names,
                                   [&](double i, double p, double o, double q)
                                   {
                                     std::vector<double> values = { 1e3 };
                                     for (int l = 780; l >= 380; l -= 2)
                                     {
                                       values.push_back(spectrum.Value(l) * Shape(i, o, q - p));
                                     }
                                     return values;
                                   }));
    ExpectFormula(Read(folder("a.astm")), color, 0.25 * SpectrumTolerance);
    const auto infrared = Read(folder("a.astm#905nm"));
    ASSERT_TRUE(infrared);
    const double up[3] = { 0.0, 0.0, 1.0 };
    double f[3];
    infrared->Evaluate(up, up, f);
    EXPECT_NEAR(f[1], 1e3, 1e-3);
  }
  ExpectRefused(folder, folder("a.astm#906nm"), { AstmFormat, "'906nm'", "380nm, 382nm" });

  // D65's own XYZ (IEC 61966-2-1) is gray.
  WriteBytes(folder("b.astm"), MakeAstm("X,Y,Z",
                                 [](double i, double p, double o, double q)
                                 {
                                   const double f = Shape(i, o, q - p);
                                   return std::vector<double>{ 0.9505 * f, f, 1.0890 * f };
                                 }));
  const double gray[3] = { 1.0, 1.0, 1.0 };
  ExpectFormula(Read(folder("b.astm")), gray, 1e-4);
}

//------------------------------------------------------------------------------
TEST(IOAstm, LightsOfSeveralAzimuthsAreAnisotropic)
{
  const Folder folder;
  // Linear in the azimuths, too; along the normals one value.
  const auto formula = [](double i, double p, double o, double q)
  {
    const auto tent = [](double phi) { return std::abs(std::remainder(phi, 360.0)) / 180.0; };
    return (0.1 + 0.001 * i * tent(p)) * (1.0 + 0.002 * o * tent(q - 90.0));
  };
  WriteBytes(folder("a.astm"), MakeAstm("R,G,B",
                                 [&](double i, double p, double o, double q)
                                 { return std::vector<double>(3, formula(i, p, o, q)); },
                                 { 0.0, 70.0, 180.0, 300.0 }, { 0.0, 90.0, 200.0, 270.0 }));
  const auto brdf = Read(folder("a.astm"));
  ASSERT_TRUE(brdf);
  EXPECT_FALSE(brdf->IsIsotropic());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  for (int k = 0; k < 1000; ++k)
  {
    const double angles[4] = { 89.0 * number(random), 360.0 * number(random), 89.0 * number(random),
      360.0 * number(random) };
    const glm::dvec3 f = EvaluateAt(brdf, angles[0], angles[1], angles[2], angles[3]);
    ASSERT_NEAR(f[0], formula(angles[0], angles[1], angles[2], angles[3]), 2e-6);
  }
}

//------------------------------------------------------------------------------
TEST(IOAstm, RefusesBadFiles)
{
  const Folder folder;
  const auto expect = [&folder](const std::string& bytes, std::vector<std::string> words)
  {
    words.push_back(AstmFormat);
    ExpectRefused(folder, WriteBytes(folder("a.astm"), bytes), words);
  };
  const std::string vars = "VARS theta_i,phi_i,theta_s,phi_s,R,G,B\n";
  const std::string row = "0.1,0,0.2,0.3,1,2,3\n";
  expect("SAMPLE x\n", { "VARS", "no such line" });
  expect("VARS\n" + row, { "line 1, VARS", "no column" });
  expect("VARS theta_i,,theta_s\n", { "VARS", "with commas" });
  expect("VARS theta_i,theta_i,theta_s,phi_s,R\n0,0,0,0,1\n", { "'theta_i' twice" });
  expect("VARS theta_i,phi_i,theta_s,R,G,B\n0,0,0,1,1,1\n", { "names no phi_s" });
  expect("VARS theta_i,phi_i,theta_s,phi_s\n0,0,0,0\n", { "no column of values" });
  expect("VARS theta_i,phi_i,theta_s,phi_s,R,G\n0,0,0,0,1,1\n", { "'R,G'", "550nm" });
  expect("VARS theta_i,phi_i,theta_s,phi_s,550nm,550.0nm\n0,0,0,0,1,1\n", { "550nm twice" });
  expect(vars, { "found 0 rows" });
  expect("NUM_POINTS 2\n" + vars + row, { "found 1 rows, expected 2 (NUM_POINTS)" });
  expect("NUM_POINTS x\n" + vars + row, { "line 1, NUM_POINTS", "'x'" });
  expect("NUM_POINTS 1.5\n" + vars + row, { "NUM_POINTS", "'1.5'" });
  expect(vars + row + "\n0.1,0,0.2,0.3,1,2\n", { "line 4, row", "found 6", "expected the 7" });
  expect(vars + row + "0.1,0,0.2,0.3,1,2,3,4\n", { "line 3", "found 8" });
  for (const char* word : { "x", "nan", "inf", "1e999", "", "1 2", "0x1" })
  {
    expect(vars + row + "0.1,0," + word + ",0.3,1,2,3\n", { "line 3, number 3", "finite number" });
  }
  expect(vars + row + "0.1,0,0.2,0.3,1,2,1e39\n", { "line 3", "1e+39", "32 bits" });
  expect(vars + row + "91,0,0.2,0.3,1,2,3\n", { "line 3", "theta_i is 91 degrees" });
  expect(vars + row + "0.1,99,0.2,0.3,1,2,3\n", { "line 3", "phi_i is 5672" });
  WriteBytes(folder("a.astm"), vars + row);
  ExpectRefused(folder, folder("a.astm#550nm"), { AstmFormat, "no wavelengths" });
  // Each reading's angles are its own.
  std::string sparse = vars;
  for (int k = 0; k < 10000; ++k)
  {
    sparse += measuredbrdf::FixedText(0.00015 * k, 6) + "," +
              measuredbrdf::FixedText(0.0006 * (k * 7 % 10000), 6) + "," +
              measuredbrdf::FixedText(0.00015 * (k * 3 % 10000), 6) + "," +
              measuredbrdf::FixedText(0.0006 * k, 6) + ",1,1,1\n";
  }
  expect(sparse, { "expected a grid" });
}
}
