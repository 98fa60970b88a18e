// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Published fits as text, and those that are embedded.
#include "TestIOHelpers.h"

#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkEmbeddedMaterials.h"
#include "vtkLambertBRDF.h"
#include "vtkSumBRDF.h"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <set>
#include <sstream>

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
  EXPECT_NE(reader->GetNotes().find("1.66"), std::string::npos);
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
namespace
{
// Reflectance of a dielectric from Snell's law and the amplitudes of both polarizations.
double Dielectric(double eta, double cosine)
{
  const double cosT = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
  const double rs = (cosine - eta * cosT) / (cosine + eta * cosT);
  const double rp = (eta * cosine - cosT) / (eta * cosine + cosT);
  return 0.5 * (rs * rs + rp * rp);
}

double Schlick(double reflectance, double cosine)
{
  return reflectance + (1.0 - reflectance) * std::pow(1.0 - cosine, 5.0);
}
}

// Figures as they are printed, through the reader, against the formulas as they are printed.
TEST(IOFits, PublishedFiguresGiveThePapersValues)
{
  const Folder folder;
  WriteBytes(folder("published.fit"),
    "bronze = Aggregate(Lambertian(albedo = [0.0877, 0.0598, 0.0297]), NganAshikhminShirley("
    "albedo = [0.108, 0.0637, 0.0337], fresnelReflectance = 0.249, sharpness = 1350.0))\n"
    "phong = Aggregate(Lambertian(albedo = [0.0864, 0.0597, 0.0302]), NganBlinnPhong("
    "albedo = [0.015, 0.00818, 0.00381], sharpness = 1290.0))\n"
    "rubber = Aggregate(Lambertian(albedo = [0.0387, 0.0774, 0.1578]), LowAshikhminShirley("
    "albedo = [0.42416, 0.41635, 0.4052], sharpness = 27.514711, fresnelReflectance = 1.36647))\n");
  const auto bronze = Read(folder("published.fit#bronze"));
  const auto phong = Read(folder("published.fit#phong"));
  const auto rubber = Read(folder("published.fit#rubber"));
  constexpr double pi = 3.14159265358979323846;
  const double merl[3] = { 1.0, 1.15, 1.66 };
  // Mirror directions, a little off them, at grazing, and far off.
  const double angles[][3] = { { 0.5, 0.5, pi }, { 0.5, 0.52, pi - 0.02 }, { 1.4, 1.38, pi },
    { 0.1, 1.2, 1.0 } };
  for (const auto& angle : angles)
  {
    const double i[3] = { std::sin(angle[0]), 0.0, std::cos(angle[0]) };
    const double o[3] = { std::sin(angle[1]) * std::cos(angle[2]),
      std::sin(angle[1]) * std::sin(angle[2]), std::cos(angle[1]) };
    const double sum[3] = { i[0] + o[0], i[1] + o[1], i[2] + o[2] };
    const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    const double nh = sum[2] / length;
    const double hd = 0.5 * length; // h.i = h.o
    const auto ashikhmin = [&](double n)
    { return (n + 1.0) / (8.0 * pi) * std::pow(nh, n) / (hd * std::max(i[2], o[2])); };
    const double bronzeDiffuse[3] = { 0.0877, 0.0598, 0.0297 };
    const double bronzeScale[3] = { 0.108, 0.0637, 0.0337 };
    const double phongDiffuse[3] = { 0.0864, 0.0597, 0.0302 };
    const double phongScale[3] = { 0.015, 0.00818, 0.00381 };
    const double rubberDiffuse[3] = { 0.0387, 0.0774, 0.1578 };
    const double rubberScale[3] = { 0.42416, 0.41635, 0.4052 };
    double a[3], b[3], c[3];
    bronze->Evaluate(i, o, a);
    phong->Evaluate(i, o, b);
    rubber->Evaluate(i, o, c);
    for (int k = 0; k < 3; ++k)
    {
      const double expected[3] = {
        merl[k] * (bronzeDiffuse[k] / pi + bronzeScale[k] * ashikhmin(1350.0) * Schlick(0.249, hd)),
        merl[k] * (phongDiffuse[k] / pi +
                    phongScale[k] * (1290.0 + 2.0) / (2.0 * pi) * std::pow(nh, 1290.0)),
        rubberDiffuse[k] / pi + rubberScale[k] * ashikhmin(27.514711) * Dielectric(1.36647, hd)
      };
      EXPECT_NEAR(a[k] / expected[0], 1.0, 1e-9) << "Ngan's Ashikhmin-Shirley";
      EXPECT_NEAR(b[k] / expected[1], 1.0, 1e-9) << "Ngan's Blinn-Phong";
      EXPECT_NEAR(c[k] / expected[2], 1.0, 1e-9) << "Low's Ashikhmin-Shirley";
    }
  }
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

  struct Case
  {
    const char* From;
    const char* To;
    std::vector<std::string> Words;
  };
  const std::vector<Case> cases = {
    { "0.2", "nan", { "line 2", "albedo", "finite" } },
    { "0.2", "inf", { "line 2", "albedo", "finite" } },
    { "0.2", "1e999", { "line 2", "albedo", "finite" } },
    { "0.2", "x", { "line 2", "albedo", "'x" } },
    { "0.2", "-0.2", { "line 2", "albedo", "negative" } },
    { "0.1, ", "", { "plain", "albedo", "2 numbers", "expected 3" } },
    { "Lambertian", "Lambert", { "line 2", "Lambert", "unknown model" } },
    { "sharpness", "roughness", { "line 3", "unknown attribute 'roughness'" } },
    { "sharpness = 20, ", "", { "line 3", "'sharpness' is missing" } },
    { "20", "-1", { "line 3", "'sharpness'" } },
    { "1.5", "0.5", { "line 3", "'fresnelReflectance'" } },
    { "1.5", "[1, 2]", { "line 3", "'fresnelReflectance'", "expected 1" } },
    { "1.5", "1.5, sharpness = 3", { "line 3", "'sharpness' appears twice" } },
    { "plain =", "plain", { "line 2", "'='" } },
    { "plain", "", { "line 2", "material's name" } },
  };
  for (const Case& bad : cases)
  {
    SCOPED_TRACE(std::string(bad.From) + " -> " + bad.To);
    std::string text = good;
    text.replace(text.find(bad.From), std::strlen(bad.From), bad.To);
    std::vector<std::string> words = bad.Words;
    words.push_back(Fits);
    ExpectBytesRefused(folder, text, words);
  }
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
  WriteBytes(folder("four.fit"), text);
  ExpectRefused(folder, folder("four.fit"), { "4 materials", "one, two, three, ..." });
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
  const char* locale = nullptr;
  for (const char* name : { "de_DE.UTF-8", "fr_FR.UTF-8", "de_DE" })
  {
    locale = locale ? locale : std::setlocale(LC_ALL, name);
  }
  if (!locale)
  {
    GTEST_SKIP() << "no locale with a decimal comma is installed";
  }
  const Folder folder;
  WriteBytes(folder("a.fit"), SmallFit);
  const auto sum = ReadSum(folder("a.fit"));
  std::setlocale(LC_ALL, "C");
  ExpectColor(vtkLambertBRDF::SafeDownCast(sum->GetTerm(0))->GetAlbedo(), 0.1, 0.2, 0.3);
}

//------------------------------------------------------------------------------
TEST(IOFits, ReadsThePublishedOnes)
{
  if (!std::filesystem::is_directory(SharedData + "/fits"))
  {
    GTEST_SKIP() << "no fits at " << SharedData << "/fits";
  }
  const std::vector<std::pair<std::string, std::size_t>> files = {
    { "low_ashikhminshirley_E1", 100 }, { "ngan_ashikhminshirley", 86 }, { "ngan_blinnphong", 86 }
  };
  for (const auto& file : files)
  {
    const std::string path = SharedData + "/fits/" + file.first + ".fit";
    vtkNew<vtkBRDFReader> reader;
    reader->SetFileName(path);
    const std::vector<std::string> names = reader->GetMaterialNames();
    ASSERT_EQ(names.size(), file.second) << path;
    for (const std::string& name : names)
    {
      reader->SetFileName(path + "#" + name);
      ASSERT_TRUE(reader->Read()) << reader->GetErrorMessage();
      EXPECT_EQ(reader->GetNotes().find("1.66") != std::string::npos, file.first.find("ngan") == 0);
    }
  }
  // The embedded figures are the published ones.
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    const std::string source = vtkEmbeddedMaterials::GetSource(k);
    if (source.find("MERL sample") != 0)
    {
      continue; // a measurement: TestIOEmbedded
    }
    const auto& file = source.find("Low") != std::string::npos         ? files[0]
                       : source.find("NganBlinn") != std::string::npos ? files[2]
                                                                       : files[1];
    const auto published = Read(SharedData + "/fits/" + file.first + ".fit#" + name);
    vtkSmartPointer<vtkBRDF> embedded =
      vtkSmartPointer<vtkBRDF>::Take(vtkEmbeddedMaterials::NewBRDF(name));
    SCOPED_TRACE(name);
    ExpectSameValues(published, embedded);
  }
}

//------------------------------------------------------------------------------
TEST(IOEmbedded, Prints)
{
  vtkNew<vtkEmbeddedMaterials> materials;
  std::ostringstream text;
  materials->Print(text);
  EXPECT_NE(text.str().find("NumberOfMaterials: " +
                            std::to_string(vtkEmbeddedMaterials::GetNumberOfMaterials()) + "\n"),
    std::string::npos)
    << text.str();
}

//------------------------------------------------------------------------------
TEST(IOEmbedded, KindsFollowNames)
{
  // The first part of a MERL name that says what the sample is.
  const std::vector<std::pair<std::string, std::string>> parts = { { "fabric", "fabric" },
    { "felt", "felt" }, { "metallic-paint", "metallic paint" }, { "car-paint", "car paint" },
    { "paint", "paint" }, { "rubber", "rubber" }, { "plastic", "plastic" },
    { "acrylic", "plastic" }, { "delrin", "plastic" }, { "pvc", "plastic" }, { "nickel", "metal" },
    { "chrome", "metal" }, { "brass", "metal" }, { "bronze", "metal" }, { "marble", "stone" },
    { "hematite", "stone" }, { "cherry", "wood" } };
  for (int k = 0; k < vtkEmbeddedMaterials::GetNumberOfMaterials(); ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    const auto part = std::find_if(parts.begin(), parts.end(),
      [&name](const auto& pair) { return name.find(pair.first) != std::string::npos; });
    ASSERT_NE(part, parts.end()) << name;
    EXPECT_EQ(vtkEmbeddedMaterials::GetKind(k), part->second) << name;
  }
}

//------------------------------------------------------------------------------
TEST(IOEmbedded, HoldsFitsWithSources)
{
  std::set<std::string> names;
  const int count = vtkEmbeddedMaterials::GetNumberOfMaterials();
  EXPECT_GE(count, 16);
  for (int k = 0; k < count; ++k)
  {
    const std::string name = vtkEmbeddedMaterials::GetName(k);
    SCOPED_TRACE(name);
    EXPECT_TRUE(names.insert(name).second);
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
    // Bright enough to be seen, and not brighter than its light.
    brdf->Prepare();
    const double o[3] = { 0.6, 0.0, 0.8 };
    double albedo[3];
    brdf->GetDirectionalAlbedo(o, albedo);
    std::cout << name << ": albedo at 37 degrees " << albedo[0] << " " << albedo[1] << " "
              << albedo[2] << "\n";
    EXPECT_GT(std::max({ albedo[0], albedo[1], albedo[2] }), 0.03);
    EXPECT_LT(std::max({ albedo[0], albedo[1], albedo[2] }), 1.0);
  }
  EXPECT_EQ(vtkEmbeddedMaterials::NewBRDF("no-such-material"), nullptr);
  EXPECT_EQ(vtkEmbeddedMaterials::GetName(-1), "");
  EXPECT_EQ(vtkEmbeddedMaterials::GetKind(count), "");
  EXPECT_EQ(vtkEmbeddedMaterials::GetSource(count), "");
}
