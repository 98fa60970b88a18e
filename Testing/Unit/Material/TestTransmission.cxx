// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkBTDF, of values that can be integrated by hand.

#include "ErrorCatcher.h"

#include "HalfVector.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkBTDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace
{
using measuredbrdf::Pi;

vtkSmartPointer<vtkLambertBRDF> MakeDiffuse(double albedo)
{
  auto diffuse = vtkSmartPointer<vtkLambertBRDF>::New();
  diffuse->SetAlbedo(albedo, 0.5 * albedo, 0.0);
  return diffuse;
}

// Light's patches: one to 30 degrees, three beyond. The view's: two halves about +x and -x.
vtkSmartPointer<vtkAngleBasisBRDF> MakeMatrix(std::vector<float> values)
{
  std::vector<float> rgb;
  for (const float value : values)
  {
    rgb.insert(rgb.end(), 3, value);
  }
  auto matrix = vtkSmartPointer<vtkAngleBasisBRDF>::New();
  EXPECT_EQ(matrix->SetMatrix({ { 30.0f, 90.0f }, { 1, 3 } }, { { 90.0f }, { 2 } }, rgb), "");
  return matrix;
}
}

//------------------------------------------------------------------------------
TEST(Transmission, IsBetweenTheSides)
{
  vtkNew<vtkBTDF> btdf;
  const double up[3] = { 0.3, 0.0, 2.0 };
  const double down[3] = { -0.1, 0.4, -0.3 };
  const double level[3] = { 1.0, 0.0, 0.0 };
  const double bad[3] = { 0.0, std::numeric_limits<double>::quiet_NaN(), -1.0 };
  double f[3] = { 1.0, 1.0, 1.0 };
  btdf->Evaluate(up, down, f);
  EXPECT_EQ(f[0] + f[1] + f[2], 0.0) << "there is nothing yet";
  btdf->SetFolded(vtkBTDF::FRONT, MakeDiffuse(0.3));
  btdf->SetFolded(vtkBTDF::BACK, MakeDiffuse(0.2));
  btdf->Evaluate(up, down, f);
  EXPECT_NEAR(f[0], 0.3 / Pi, 1e-12);
  EXPECT_NEAR(f[1], 0.15 / Pi, 1e-12);
  btdf->Evaluate(down, up, f);
  EXPECT_NEAR(f[0], 0.2 / Pi, 1e-12);
  for (const auto& pair : { std::pair{ up, up }, { down, down }, { up, level }, { level, down },
         { up, bad }, { bad, up } })
  {
    btdf->Evaluate(pair.first, pair.second, f);
    EXPECT_EQ(f[0] + f[1] + f[2], 0.0);
  }
  EXPECT_TRUE(btdf->IsIsotropic());
  btdf->SetFolded(vtkBTDF::BACK, MakeMatrix({ 1, 2, 3, 4, 5, 6, 7, 8 }));
  EXPECT_FALSE(btdf->IsIsotropic());
}

//------------------------------------------------------------------------------
TEST(Transmission, TransmittanceOfDiffuseSheets)
{
  vtkNew<vtkBTDF> btdf;
  btdf->SetFolded(vtkBTDF::FRONT, MakeDiffuse(0.3));
  btdf->SetFolded(vtkBTDF::BACK, MakeDiffuse(0.2));
  for (const double z : { 1.0, 0.2, -0.2, -1.0 })
  {
    const double d[3] = { std::sqrt(1.0 - z * z), 0.0, z };
    double light[3];
    double sky[3];
    btdf->GetTransmittance(d, light);
    btdf->GetSkyTransmittance(d, sky);
    // A sky that is seen from the front lies behind.
    EXPECT_NEAR(light[0], z > 0.0 ? 0.3 : 0.2, 1e-9);
    EXPECT_NEAR(light[1], z > 0.0 ? 0.15 : 0.1, 1e-9);
    EXPECT_NEAR(sky[0], z > 0.0 ? 0.2 : 0.3, 1e-9);
  }
  const double level[3] = { 0.0, 1.0, 0.0 };
  double rgb[3] = { 1.0, 1.0, 1.0 };
  btdf->GetTransmittance(level, rgb);
  EXPECT_EQ(rgb[0], 0.0);
  EXPECT_NEAR(btdf->GetReciprocityError(), 1.0 / 3.0, 1e-9); // |0.3 - 0.2| / 0.3
}

//------------------------------------------------------------------------------
// By the patches' projected solid angles: pi sin^2 30 and a third of the rest; pi / 2.
TEST(Transmission, SumsMatricesExactly)
{
  vtkNew<vtkBTDF> btdf;
  btdf->SetFolded(vtkBTDF::FRONT, MakeMatrix({ 1, 2, 3, 4, 5, 6, 7, 8 }));
  const double inner = 0.25 * Pi;
  const double outer = 0.25 * Pi;
  const double light[3] = { 0.0, 0.0, 1.0 };
  double rgb[3];
  btdf->GetTransmittance(light, rgb);
  EXPECT_NEAR(rgb[1], (1.0 + 2.0) * 0.5 * Pi, 1e-6);
  // Seen from behind, at the side of +x: continued through the surface it goes to -x, patch 1.
  const double view[3] = { 0.6, 0.0, -0.8 };
  btdf->GetSkyTransmittance(view, rgb);
  EXPECT_NEAR(rgb[2], 2.0 * inner + (4.0 + 6.0 + 8.0) * outer, 1e-6);
  // By reciprocity the other side's light gives the same.
  btdf->GetTransmittance(view, rgb);
  EXPECT_NEAR(rgb[0], 2.0 * inner + (4.0 + 6.0 + 8.0) * outer, 1e-6);
  double f[3];
  btdf->Evaluate(view, light, f);
  EXPECT_EQ(f[0], 2.0);
  EXPECT_EQ(btdf->GetReciprocityError(), 0.0);
}

//------------------------------------------------------------------------------
TEST(Transmission, TellsChangesAndBadSides)
{
  vtkNew<vtkBTDF> btdf;
  const auto diffuse = MakeDiffuse(0.5);
  vtkMTimeType before = btdf->GetMTime();
  btdf->SetFolded(vtkBTDF::BACK, diffuse);
  EXPECT_GT(btdf->GetMTime(), before);
  before = btdf->GetMTime();
  btdf->SetFolded(vtkBTDF::BACK, diffuse);
  EXPECT_EQ(btdf->GetMTime(), before);
  diffuse->SetAlbedo(0.1, 0.1, 0.1);
  EXPECT_GT(btdf->GetMTime(), before);
  EXPECT_EQ(btdf->GetFolded(vtkBTDF::BACK), diffuse);
  EXPECT_EQ(btdf->GetFolded(vtkBTDF::FRONT), nullptr);
  EXPECT_EQ(btdf->GetFolded(2), nullptr);
  ErrorCatcher errors(btdf);
  btdf->SetFolded(2, diffuse);
  EXPECT_EQ(errors.Take(), 1);
  std::ostringstream printed;
  btdf->Print(printed);
  EXPECT_NE(printed.str().find("Front: 0"), std::string::npos) << printed.str();
  EXPECT_NE(printed.str().find("Back: 0x"), std::string::npos) << printed.str();
}
