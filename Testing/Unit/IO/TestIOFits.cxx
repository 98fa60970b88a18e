// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Published fits as text, and those that are embedded.
#include "CommaLocale.h"
#include "TestIOHelpers.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkSumBRDF.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

using namespace testio;

namespace
{
const std::string Fits = "published fits";

void ExpectColor(const double* color, double r, double g, double b)
{
  EXPECT_DOUBLE_EQ(color[0], r);
  EXPECT_DOUBLE_EQ(color[1], g);
  EXPECT_DOUBLE_EQ(color[2], b);
}

vtkSmartPointer<vtkSumBRDF> ReadSum(const std::string& path)
{
  return vtkSumBRDF::SafeDownCast(Read(path));
}
}

//------------------------------------------------------------------------------
TEST(IOFits, ReadsLow)
{
  const Folder folder;
  WriteBytes(folder("a.fit"), SmallFit);
  const auto sum = ReadSum(folder("a.fit"));
  ASSERT_TRUE(sum);
  ASSERT_EQ(sum->GetNumberOfTerms(), 2);
  EXPECT_EQ(sum->GetName(), "plain");
  EXPECT_NE(sum->GetSource().find("Low et al. 2012"), std::string::npos);
  auto* lambert = vtkLambertBRDF::SafeDownCast(sum->GetTerm(0));
  auto* lobe = vtkAshikhminShirleyBRDF::SafeDownCast(sum->GetTerm(1));
  ASSERT_TRUE(lambert && lobe);
  ExpectColor(lambert->GetAlbedo(), 0.1, 0.2, 0.3);
  ExpectColor(lobe->GetSpecularScale(), 0.4, 0.5, 0.6);
  EXPECT_EQ(lobe->GetExponentU(), 20.0);
  EXPECT_EQ(lobe->GetExponentV(), 20.0);
  EXPECT_EQ(lobe->GetIndexOfRefraction(), 1.5);
  EXPECT_EQ(lobe->GetFresnelModel(), vtkAshikhminShirleyBRDF::DIELECTRIC);
}

//------------------------------------------------------------------------------
TEST(IOFits, ScalesNgan)
{
  const Folder folder;
  WriteBytes(folder("n.fit"),
    "as = Aggregate(Lambertian(albedo = [0.1, 0.1, 0.1]), NganAshikhminShirley("
    "albedo = [0.2, 0.2, 0.2], fresnelReflectance = 0.25, sharpness = 7e1)) # end\r\n"
    "bp = Aggregate(Lambertian(albedo=[0,0,0]),NganBlinnPhong(sharpness=5,albedo=[1,1,1]))\r\n"
    "low = LowAshikhminShirley(albedo = [1, 1, 1], fresnelReflectance = 2, sharpness = 3)\n");
  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(folder("n.fit#as"));
  EXPECT_EQ(reader->GetMaterialNames(), (std::vector<std::string>{ "as", "bp", "low" }));
  ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
  ExpectNote(reader, "1.66");
  auto* sum = vtkSumBRDF::SafeDownCast(reader->GetBRDF());
  ASSERT_TRUE(sum);
  ExpectColor(
    vtkLambertBRDF::SafeDownCast(sum->GetTerm(0))->GetAlbedo(), 0.1, 0.1 * 1.15, 0.1 * 1.66);
  auto* lobe = vtkAshikhminShirleyBRDF::SafeDownCast(sum->GetTerm(1));
  ExpectColor(lobe->GetSpecularScale(), 0.2, 0.2 * 1.15, 0.2 * 1.66);
  ExpectColor(lobe->GetReflectance(), 0.25, 0.25, 0.25);
  EXPECT_EQ(lobe->GetFresnelModel(), vtkAshikhminShirleyBRDF::SCHLICK);
  EXPECT_EQ(lobe->GetExponentU(), 70.0);

  const auto phong = ReadSum(folder("n.fit#bp"));
  auto* blinn = vtkBlinnPhongBRDF::SafeDownCast(phong->GetTerm(1));
  ASSERT_TRUE(blinn);
  ExpectColor(blinn->GetSpecular(), 1.0, 1.15, 1.66);
  EXPECT_EQ(blinn->GetExponent(), 5.0);
  // At h = n: (n+2)/(2 pi) = 7/(2 pi).
  const double up[3] = { 0, 0, 1 };
  double f[3];
  phong->Evaluate(up, up, f);
  EXPECT_NEAR(f[0], 7.0 / 6.283185307179586, 1e-12);

  reader->SetFileName(folder("n.fit#low"));
  ASSERT_TRUE(reader->Read());
  EXPECT_EQ(reader->GetNotes(), "");
  sum = vtkSumBRDF::SafeDownCast(reader->GetBRDF());
  ExpectColor(vtkAshikhminShirleyBRDF::SafeDownCast(sum->GetTerm(0))->GetSpecularScale(), 1, 1, 1);

  // A material whose models tell nothing follows the header comments.
  WriteBytes(folder("c.fit"), "# fits of Ngan et al.\nd = Lambertian(albedo = [1, 1, 1])\n");
  const auto diffuse = ReadSum(folder("c.fit"));
  ExpectColor(vtkLambertBRDF::SafeDownCast(diffuse->GetTerm(0))->GetAlbedo(), 1.0, 1.15, 1.66);
}

//------------------------------------------------------------------------------
TEST(IOFits, RefusesBadText)
{
  const Folder folder;
  const std::string good = SmallFit;
  const std::size_t first = good.find("plain");
  const std::size_t last = good.rfind(')'); // all before the last bracket is incomplete
  ExpectTruncationsRefused(folder, good.substr(0, last), 1, 1, Fits);
  EXPECT_GT(first, 0u);

  const auto change = [&good](const std::string& from, const std::string& to)
  { return Replace(good, from, to); };
  ExpectAllRefused(folder, Fits,
    { { change("0.2", "nan"), { "line 2", "albedo", "finite" } },
      { change("0.2", "inf"), { "line 2", "albedo", "finite" } },
      { change("0.2", "1e999"), { "line 2", "albedo", "finite" } },
      { change("0.2", "x"), { "line 2", "albedo", "'x" } },
      { change("0.2", "-0.2"), { "line 2", "albedo", "negative" } },
      { change("0.1, ", ""), { "plain", "albedo", "2 numbers", "expected 3" } },
      { change("Lambertian", "Lambert"), { "line 2", "Lambert", "unknown model" } },
      { change("sharpness", "roughness"), { "line 3", "unknown attribute 'roughness'" } },
      { change("sharpness = 20, ", ""), { "line 3", "'sharpness' is missing" } },
      { change("20", "-1"), { "line 3", "'sharpness'" } },
      { change("1.5", "0.5"), { "line 3", "'fresnelReflectance'" } },
      { change("1.5", "[1, 2]"), { "line 3", "'fresnelReflectance'", "expected 1" } },
      { change("1.5", "1.5, sharpness = 3"), { "line 3", "'sharpness' appears twice" } },
      { change("plain =", "plain"), { "line 2", "'='" } },
      { change("plain", ""), { "line 2", "material's name" } } });
  for (const std::string empty : { "Aggregate()", "Aggregate(Aggregate())" })
  {
    ExpectBytesRefused(
      folder, "x = " + empty, { Fits, "line 1", "'x'", "Aggregate: holds no model" });
  }
  ExpectBytesRefused(folder, "# nothing but a comment\n", { Fits, "no known format" });
  ExpectBytesRefused(
    folder, good + good, { Fits, "line 5", "'plain' was already given in line 2" });
  std::string nested = "a = ";
  for (int k = 0; k < 100000; ++k)
  {
    nested += "Aggregate(";
  }
  ExpectBytesRefused(folder, nested, { Fits, "nested" });
}

//------------------------------------------------------------------------------
TEST(IOFits, AsksForOneOfSeveral)
{
  const Folder folder;
  std::string text;
  for (const std::string name : { "one", "two", "three", "four" })
  {
    text += name + " = Lambertian(albedo = [0.5, 0.5, 0.5])\n";
  }
  ExpectRefused(
    folder, WriteBytes(folder("four.fit"), text), { "4 materials", "one, two, three, ..." });
  ExpectRefused(folder, folder("four.fit#five"), { "no material 'five'", "4 materials" });
  EXPECT_EQ(Read(folder("four.fit#three"))->GetName(), "three");

  // A name in a file of one material, and a file whose own name holds '#'.
  WriteBytes(folder("m.binary"), MakeMerl(2, 2, 2));
  ExpectRefused(folder, folder("m.binary#x"), { "MERL binary", "'#x'" });
  WriteBytes(folder("m#1.binary"), MakeMerl(2, 2, 2));
  EXPECT_TRUE(Read(folder("m#1.binary")));

  vtkNew<vtkBRDFReader> reader;
  reader->SetFileName(folder("m.binary"));
  EXPECT_TRUE(reader->GetMaterialNames().empty());
  reader->SetFileName(folder("absent"));
  EXPECT_TRUE(reader->GetMaterialNames().empty());
}

//------------------------------------------------------------------------------
TEST(IOFits, NumbersDoNotFollowTheLocale)
{
  const Folder folder;
  WriteBytes(folder("a.fit"), SmallFit);
  vtkSmartPointer<vtkSumBRDF> sum;
  {
    const CommaLocale commas;
    sum = ReadSum(folder("a.fit"));
  }
  ExpectColor(vtkLambertBRDF::SafeDownCast(sum->GetTerm(0))->GetAlbedo(), 0.1, 0.2, 0.3);
}

//------------------------------------------------------------------------------
TEST(IOEmbedded, HoldsFitsWithSources)
{
  const bool hasFits = std::filesystem::is_directory(SharedData + "/fits");
  std::set<std::string> names;
  const int count = vtkEmbeddedMaterials::GetNumberOfMaterials();
  EXPECT_GE(count, 16);
  for (int k = 0; k < count; ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    SCOPED_TRACE(name);
    EXPECT_TRUE(names.insert(name).second);
    const std::string kind = vtkEmbeddedMaterials::GetKind(k);
    EXPECT_NE(kind, "");
    for (const std::string part : { "fabric", "felt", "paint", "rubber", "plastic" })
    {
      EXPECT_TRUE(name.find(part) == std::string::npos || kind.find(part) != std::string::npos);
    }
    const std::string source = vtkEmbeddedMaterials::GetSource(k);
    if (vtkEmbeddedMaterials::GetKind(k) != "car paint") // a measurement
    {
      EXPECT_NE(source.find("MERL sample " + name), std::string::npos) << source;
      EXPECT_TRUE(source.find("Ngan et al. 2005") != std::string::npos ||
                  source.find("Low et al. 2012") != std::string::npos)
        << source;
    }
    vtkSmartPointer<vtkBRDF> brdf =
      vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    ASSERT_TRUE(brdf);
    EXPECT_EQ(brdf->GetReferenceCount(), 1);
    EXPECT_EQ(brdf->GetName(), name);
    EXPECT_EQ(brdf->GetSource(), source);
    if (hasFits && source.find("MERL sample") == 0) // the figures are the published ones
    {
      const std::string file = source.find("Low") != std::string::npos ? "low_ashikhminshirley_E1"
                               : source.find("NganBlinn") != std::string::npos
                                 ? "ngan_blinnphong"
                                 : "ngan_ashikhminshirley";
      ExpectSameValues(Read(SharedData + "/fits/" + file + ".fit#" + name), brdf);
    }
    // Bright enough to be seen, and not brighter than its light.
    brdf->Prepare();
    const double o[3] = { 0.6, 0.0, 0.8 };
    double albedo[3];
    brdf->GetDirectionalAlbedo(o, albedo);
    EXPECT_GT(std::max({ albedo[0], albedo[1], albedo[2] }), 0.03);
    EXPECT_LT(std::max({ albedo[0], albedo[1], albedo[2] }), 1.0);
  }
  EXPECT_EQ(vtkEmbeddedMaterials::NewBRDF("no-such-material"), nullptr);
  EXPECT_EQ(vtkEmbeddedMaterials::GetName(-1), "");
  EXPECT_EQ(vtkEmbeddedMaterials::GetKind(count), "");
  EXPECT_EQ(vtkEmbeddedMaterials::GetSource(count), "");
  if (!hasFits)
  {
    GTEST_SKIP() << "no fits at " << SharedData << "/fits; the rest passed";
  }
}
