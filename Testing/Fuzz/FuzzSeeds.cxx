// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzSeeds.h"

#include "EveryModel.h"
#include "FileBytes.h"
#include "FuzzTarget.h"
#include "MaterialFormat.h"
#include "SmallBsdfXml.h"
#include "SmallFiles.h"
#include "SmallOpenMaterial.h"
#include "vtkBRDFModels.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkJPEGWriter.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkTIFFWriter.h"

#include <utility>

namespace fuzz
{
namespace
{
using namespace testio;
using Seeds = std::vector<std::string>;

// A literal with the zeros in it.
template <std::size_t N>
std::string Bytes(const char (&literal)[N])
{
  return std::string(literal, N - 1);
}

//------------------------------------------------------------------------------
std::vector<vtkSmartPointer<vtkBRDF>> MakeMaterials()
{
  auto materials =
    MakeEveryModel([](std::size_t count) { return std::vector<float>(count, 0.25f); });
  Require(!materials.empty());
  return materials;
}

//------------------------------------------------------------------------------
Seeds MakeExrMaterials()
{
  const ScratchFolder folder;
  const std::string path = folder("seed.exr");
  Seeds seeds;
  for (const auto& material : MakeMaterials())
  {
    measuredbrdf::ExrMaterialFormat.Write(material, path, seeds.size() % 2 == 1);
    seeds.emplace_back(measuredbrdf::FileBytes(path).GetView());
  }
  return seeds;
}

//------------------------------------------------------------------------------
Seeds MakeExrHeaders()
{
  Seeds seeds;
  for (const std::string& file : MakeExrMaterials())
  {
    seeds.push_back(file.substr(4, 600));
  }
  const std::string preview = Bytes("\2\0\0\0preview\0preview\0\x0c\0\0\0\1\0\0\0\1\0\0\0abcd\0");
  const std::string texts = Bytes("\2\0\0\0list\0stringvector\0\x0b\0\0\0\3\0\0\0abc\0\0\0\0\0");
  seeds.push_back(preview);
  seeds.push_back(texts);
  return seeds;
}

//------------------------------------------------------------------------------
Seeds MakeEnvironments()
{
  Seeds seeds;
  const std::string texels = Bytes("\x80\x40\x20\x81\xff\xff\xff\xff\0\0\0\0\2\2\2\2");
  const std::string sizes[] = { Bytes("\2\0\1\0"), Bytes("\x20\0\x18\0"), Bytes("\x30\0\x08\0"),
    Bytes("\x08\0\x08\0"), Bytes("\xff\xff\1\0") };
  for (char projection = 0; projection < 9; ++projection)
  {
    for (std::size_t k = 0; k < 5; ++k)
    {
      const char kind = k == 4 ? 0 : 3;
      seeds.push_back(std::string{ projection, kind } + sizes[k] + texels);
    }
  }
  seeds.push_back(Bytes("\0\1") + sizes[1] + texels);
  for (const char* lines : { "EXPOSURE=2\nCOLORCORR=1 2 3\n",
         "FORMAT=32-bit_rle_xyze\n\n+X 2 -Y 4\n", "PRIMARIES=.7 .3 .2 .8 .1 .04 .32 .34\n" })
  {
    seeds.push_back(Bytes("\0\2") + sizes[0] + lines + texels);
  }
  return seeds;
}

//------------------------------------------------------------------------------
Seeds MakeImages()
{
  const std::string texels = Bytes("\x80\x40\x20\x81\xff\xff\xff\xff\0\0\0\0\2\2\2\2");
  Seeds seeds = { "#?RADIANCE\n\n-Y 1 +X 4\n" + texels,
    "#?RADIANCE\n\n-Y 1 +X 9\n" + Bytes("\2\2\0\x09\x89\1\x88\2\1\3\x89\4\x89\x80") };
  for (const std::string& file : MakeExrMaterials())
  {
    seeds.push_back(file);
  }
  const ScratchFolder folder;
  for (const auto& [type, channels] : { std::pair<int, int>{ VTK_UNSIGNED_CHAR, 1 },
         { VTK_UNSIGNED_CHAR, 3 }, { VTK_UNSIGNED_SHORT, 4 }, { VTK_FLOAT, 3 } })
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(5, 3, 1);
    image->AllocateScalars(type, channels);
    image->GetPointData()->GetScalars()->Fill(0.5);
    const vtkSmartPointer<vtkImageWriter> writers[] = { vtkSmartPointer<vtkTIFFWriter>::New(),
      vtkSmartPointer<vtkPNGWriter>::New(), vtkSmartPointer<vtkJPEGWriter>::New() };
    const int count = type == VTK_FLOAT ? 1 : type == VTK_UNSIGNED_SHORT ? 2 : 3;
    for (int k = 0; k < count; ++k)
    {
      writers[k]->SetInputData(image);
      writers[k]->SetFileName(folder("image").c_str());
      writers[k]->Write();
      seeds.emplace_back(measuredbrdf::FileBytes(folder("image")).GetView());
    }
  }
  return seeds;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<vtkBRDFData> MakeData()
{
  std::vector<vtkBRDFData> all;
  for (const auto& material : MakeMaterials())
  {
    vtkBRDFModels::Save(material, all.emplace_back());
  }
  return all;
}

//------------------------------------------------------------------------------
Seeds MakeSeeds(const std::string& target)
{
  if (target == "Merl")
  {
    return { MakeMerl(2, 2, 3), MakeMerl(1, 1, 1), MakeMerl(1, 2, 2) + std::string(16, '\0') };
  }
  if (target == "Tensor")
  {
    auto spectral = MakeTensorFields(MakeTables()); // whose three channels are wavelengths
    spectral[7].Name = "spectra";
    std::string wavelengths;
    for (const float wavelength : { 400.0f, 550.0f, 700.0f })
    {
      Append<float>(wavelengths, wavelength);
    }
    spectral.push_back({ "wavelengths", 10, { 3 }, wavelengths });
    return { MakeTensor(MakeTensorFields(MakeTables())), MakeTensor(spectral) };
  }
  if (target == "Mbsdf")
  {
    return { MakeMbsdf(true, 2, 3), MakeMbsdf(false, 2, 2), MakeMbsdf(true, 1, 2, true) };
  }
  if (target == "Utia") // FuzzUtia.cxx repeats them
  {
    const std::string numbers = Bytes("\x9a\x99\x99\x99\x99\x99\xb9\x3f\0\0\0\0\0\0\xf0\x3f");
    return { "\1" + numbers, "\x09" + numbers + numbers, Bytes("\0") + numbers };
  }
  if (target == "Astm")
  {
    return { "SAMPLE paint\nNUM_POINTS 2\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n"
             "0.5,0,0.5,3.1,0.1,0.2,0.3\n0.5,0,0.1,-3.1,0.1,0.2,0.3\n",
      "VARS theta_i,phi_i,theta_s,phi_s,450nm,550nm,650nm\r\n10,90,-20,0,.1,.2,.3\r\n"
      "60,180,30,45,+1e-1,0,-1\r\n",
      "VARS theta_s,phi_s,theta_i,X,Y,Z\n0.1,0.2,0.3,1,1,1\n",
      "VARS theta_i,theta_s,phi_s,Integrated 300-700nm\n0.3,0.1,0.2,1\n0,1,2,3\n" };
  }
  if (target == "BsdfXml")
  {
    return { MakeBsdfXmlTree(3, "{{1}{2}{3}{4}{5}{6}{7}{1 2 3 4 5 6 7 8}}"),
      MakeBsdfXmlTree(4, "{0.5}", MakeBsdfXmlTreeBlock("Transmission Back", "{0.25}")),
      MakeBsdfXmlTree(3, "{1}", MakeBsdfXmlTreeBlock("Transmission Front", "{1 -2 3 4 5 6 7 8}")),
      MakeBsdfXml(), MakeBsdfXml("Rows"),
      MakeBsdfXml("Columns", MakeBsdfXmlBlock("CIE-X", "Reflection Back", 0.1) +
                               MakeBsdfXmlBlock("CIE-Z", "Reflection Back", 0.1)) };
  }
  if (target == "OpenMaterial")
  {
    const auto value = [](double l, double i, double o, double p)
    { return 1e-4 * l + 0.001 * (i + o) + 1e-4 * p; };
    return { MakeOpenMaterial({ 905.0 }, { 0.0, 45.0 }, { 0.0, 60.0 }, { 0.0, 180.0 }, value),
      MakeOpenMaterial(
        { 400.0, 550.0, 700.0 }, { 0.0 }, { 0.0, 30.0 }, { 0.0, 90.0, 270.0 }, value),
      MakeOpenMaterialFile("5e-7", "[5e-7, 1, 0, 0, null], [5e-7, 0.5, 0.5, 0.5, -0.1]") };
  }
  if (target == "Fit")
  {
    return { SmallFit,
      "a = Aggregate(Lambertian(albedo = [+1e-1, .2, 0]), # inside\n"
      " NganBlinnPhong(albedo = 0.5, sharpness = 1e3))\n"
      "b = NganAshikhminShirley(albedo = [1, 1, 1], fresnelReflectance = 0.04, sharpness = 8)\n"
      "c = Aggregate(Aggregate(Lambertian(albedo = [0, 0, 0])))\n" };
  }
  if (target == "PhotographList")
  {
    return { R"({"irradiance": 2, "transfer": "srgb", "levels_for_floats": true, "photographs": [
{"file": "a.png", "light": {"theta": 15, "phi": 30}, "view": [0.5, 0, 1], "exposure": 0.5}]})",
      "00001 tl015 pl030 tv045 pv-60.jpg" };
  }
  if (target == "ExrHeader")
  {
    return MakeExrHeaders();
  }
  if (target == "ExrMaterial")
  {
    return MakeExrMaterials();
  }
  if (target == "MaterialData")
  {
    Seeds seeds;
    for (char representation = 0; representation < 12; ++representation)
    {
      seeds.emplace_back(1, representation);
      seeds.push_back(representation + Bytes("\6\2\0\0\1\0\0\0\0\0\0\xf0\x3f"));
    }
    return seeds;
  }
  if (target == "Image")
  {
    return MakeImages();
  }
  if (target == "Environment")
  {
    return MakeEnvironments();
  }
  if (target == "DirectionsCsv")
  {
    return { "# pairs\nix,iy,iz,ox,oy,oz\n0,0,1,0,0,1\n0.6,0,0.8,0,0.6,0.8\n",
      "\xEF\xBB\xBFname,\"ix\",iy,iz,ox,oy,oz\r\n\"a, b\",+1e-3,0,1,-.5,0,1e0\r\n" };
  }
  return {};
}
} // namespace fuzz
