// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// What the library itself holds: a measured car paint and a photographed room; and 16-bit tables.
#include "ErrorCatcher.h"
#include "TestIOHelpers.h"

#include "vtkEmbeddedEnvironments.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkEnvironment.h"
#include "vtkStringOutputWindow.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

using namespace testio;

namespace
{
vtkSmartPointer<vtkTabulatedBRDF> MakeTable(std::vector<float> rgb)
{
  const int dimensions[3] = { 1, 1, static_cast<int>(rgb.size() / 3) };
  auto table = vtkSmartPointer<vtkTabulatedBRDF>::New();
  EXPECT_TRUE(table->SetVolume(
    vtkTabulatedBRDF::INCIDENT_OUTGOING, vtkTabulatedBRDF::HALF_TURN, dimensions, std::move(rgb)));
  return table;
}
}

//------------------------------------------------------------------------------
TEST(IOEmbedded, HoldsAMeasurement)
{
  const auto brdf = vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF("blue-car-paint"));
  auto* paint = vtkTabulatedBRDF::SafeDownCast(brdf);
  ASSERT_TRUE(paint);
  EXPECT_EQ(paint->GetName(), "blue-car-paint");
  for (const char* word : { "measured", "carpaint_blue.mbsdf", "NVIDIA", "CC0 1.0" })
  {
    EXPECT_NE(paint->GetSource().find(word), std::string::npos) << paint->GetSource();
  }
  const int last = vtkEmbeddedMaterials::GetNumberOfMaterials() - 1;
  EXPECT_EQ(vtkEmbeddedMaterials::GetName(last), "blue-car-paint");
  EXPECT_EQ(vtkEmbeddedMaterials::GetKind(last), "car paint");
  EXPECT_EQ(vtkEmbeddedMaterials::GetSource(last), paint->GetSource());
  EXPECT_EQ(paint->GetParameterization(), vtkTabulatedBRDF::INCIDENT_OUTGOING);
  const int* n = paint->GetDimensions();
  EXPECT_EQ(std::vector<int>(n, n + 3), (std::vector<int>{ 90, 45, 45 }));
  // It is blue, and shines in the mirror direction.
  paint->Prepare();
  const double o[3] = { 0.6, 0.0, 0.8 };
  const double mirror[3] = { -0.6, 0.0, 0.8 };
  const double aside[3] = { 0.0, 0.6, 0.8 };
  double albedo[3];
  double f[3];
  double floor[3];
  paint->GetDirectionalAlbedo(o, albedo);
  paint->Evaluate(mirror, o, f);
  paint->Evaluate(aside, o, floor);
  EXPECT_GT(albedo[2], 1.3 * albedo[0]);
  EXPECT_LT(albedo[2], 0.5);
  EXPECT_GT(f[1], 20.0 * floor[1]);
}

//------------------------------------------------------------------------------
TEST(IOEmbedded, HoldsARoom)
{
  const int count = vtkEmbeddedEnvironments::GetNumberOfEnvironments();
  std::vector<std::string> names;
  for (int k = 0; k < count; ++k)
  {
    names.push_back(vtkEmbeddedEnvironments::GetName(k));
    EXPECT_NE(vtkEmbeddedEnvironments::GetSource(k), "");
    const auto environment =
      vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment(names.back()));
    ASSERT_TRUE(environment) << names.back();
    EXPECT_EQ(environment->GetReferenceCount(), 1);
    EXPECT_EQ(environment->GetName(), "built-in " + names.back());
    EXPECT_GT(environment->GetWidth(), 0);
  }
  EXPECT_EQ(names, (std::vector<std::string>{ "room", "sky", "hall" }));
  EXPECT_NE(vtkEmbeddedEnvironments::GetSource(0).find("CC0"), std::string::npos);
  EXPECT_EQ(vtkEmbeddedEnvironments::NewEnvironment("no-such-room"), nullptr);
  EXPECT_EQ(vtkEmbeddedEnvironments::NewEnvironment(""), nullptr);
  EXPECT_EQ(vtkEmbeddedEnvironments::GetName(count), "");
  EXPECT_EQ(vtkEmbeddedEnvironments::GetSource(-1), "");

  const auto room =
    vtkSmartPointer<vtkEnvironment>::Take(vtkEmbeddedEnvironments::NewEnvironment("room"));
  EXPECT_EQ(room->GetWidth(), 512);
  EXPECT_EQ(room->GetHeight(), 256);
  EXPECT_EQ(room->GetNumberOfNegativeValues() + room->GetNumberOfNonFiniteValues(), 0);
  // Lamps are above and the floor is below: row 0 is the bottom.
  double above = 0.0;
  double below = 0.0;
  for (int y = 0; y < 256; ++y)
  {
    for (int x = 0; x < 512; ++x)
    {
      double rgb[3];
      room->GetPixel(x, y, rgb);
      (y < 128 ? below : above) += room->GetTexelSolidAngle(y) * rgb[1];
    }
  }
  EXPECT_GT(above, 2.0 * below);
}

//------------------------------------------------------------------------------
TEST(IOHalfFloats, RoundTrip)
{
  const Folder folder;
  const float invalid = std::numeric_limits<float>::quiet_NaN();
  const auto table =
    MakeTable({ 0.1f, -0.2f, 1e-4f, 3.0f, 60000.0f, 0.0f, invalid, invalid, invalid });
  vtkNew<vtkBRDFWriter> writer;
  writer->SetBRDF(table);
  EXPECT_FALSE(writer->GetHalfFloats());
  writer->SetFileName(folder("whole.exr"));
  ASSERT_TRUE(writer->Write());
  writer->HalfFloatsOn();
  writer->SetFileName(folder("half.exr"));
  ASSERT_TRUE(writer->Write());
  const auto whole = Read(folder("whole.exr"));
  const auto half = Read(folder("half.exr"));
  const auto& a = vtkTabulatedBRDF::SafeDownCast(whole)->GetVolume();
  const auto& b = vtkTabulatedBRDF::SafeDownCast(half)->GetVolume();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < 6; ++k)
  {
    EXPECT_EQ(a[k], table->GetVolume()[k]);
    EXPECT_NEAR(b[k], a[k], std::abs(a[k]) * 0x1p-11f);
  }
  EXPECT_NE(a[0], b[0]);
  EXPECT_TRUE(std::isnan(b[6]) && std::isnan(b[8]));
}

//------------------------------------------------------------------------------
TEST(IOHalfFloats, RefusesWhatIsTooLarge)
{
  const Folder folder;
  const auto table = MakeTable({ 0.1f, 70000.0f, 0.3f });
  vtkNew<vtkBRDFWriter> writer;
  writer->SetBRDF(table);
  writer->HalfFloatsOn();
  writer->SetFileName(folder("a.exr"));
  ErrorCatcher errors(writer);
  EXPECT_FALSE(writer->Write());
  EXPECT_EQ(errors.Take(), 1);
  EXPECT_NE(writer->GetErrorMessage().find("70000"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder("a.exr")));
}

//------------------------------------------------------------------------------
TEST(IOEmbedded, ATypoGetsTheNames)
{
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkNew<vtkStringOutputWindow> said;
  vtkOutputWindow::SetInstance(said);
  EXPECT_FALSE(vtkEmbeddedMaterials::NewBRDF("gold_paint"));
  EXPECT_FALSE(vtkEmbeddedMaterials::NewBRDF(std::string(1 << 20, '\x1b')));
  vtkOutputWindow::SetInstance(before);
  const std::string text = said->GetOutput();
  EXPECT_NE(text.find("no embedded material 'gold_paint'"), std::string::npos) << text;
  EXPECT_NE(text.find("'gold-paint', "), std::string::npos) << text;
  EXPECT_LT(text.size(), 3000u);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}
