// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The formats of materials, each a target.
#include "FuzzTarget.h"
#include "ImageFile.h"

#include "vtkLambertBRDF.h"
#include "vtkMeasuredBRDFConfigure.h"

namespace
{
// One file in sixteen is asked for a wavelength.
std::string ChooseWavelength(const std::uint8_t* data, std::size_t size, const char* wavelength)
{
  return size > 0 && data[size - 1] % 16 == 0 ? wavelength : "";
}
}

// A target that reads the material `name` of a format's file.
#define FUZZ_FORMAT(format, name)                                              \
  int Fuzz##format(const std::uint8_t* data, std::size_t size)                 \
  {                                                                            \
    return fuzz::ReadFormat(measuredbrdf::format##Format, data, size, (name)); \
  }
FUZZ_FORMAT(Astm, ChooseWavelength(data, size, "550nm"))
FUZZ_FORMAT(Mbsdf, "")
FUZZ_FORMAT(Merl, "")
FUZZ_FORMAT(OpenMaterial, ChooseWavelength(data, size, "905nm"))
FUZZ_FORMAT(Tensor, "")
FUZZ_FORMAT(ExrMaterial, "")

int FuzzBsdfXml(const std::uint8_t* data, std::size_t size)
{
  fuzz::ReadMaterial(data, size,
    [](const measuredbrdf::FileBytes& file)
    {
      measuredbrdf::MaterialFile read = measuredbrdf::BsdfXmlFormat.Read(file, "");
      fuzz::Require(read.BRDF || read.Transmission);
      if (read.Transmission)
      {
        fuzz::RequireValues(read.Transmission.Get());
      }
      if (!read.BRDF) // of transmission only
      {
        read.BRDF = vtkSmartPointer<vtkLambertBRDF>::New();
      }
      return read;
    });
  return 0;
}

// Behind the magic, which the caller has seen.
int FuzzExrHeader(const std::uint8_t* data, std::size_t size)
{
  const std::string bytes = measuredbrdf::ExrMagic + std::string(fuzz::ToView(data, size));
  try
  {
    measuredbrdf::CheckExrHeader(measuredbrdf::FileBytes::View("file", bytes), "OpenEXR image");
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  return 0;
}

// Of any format.
int FuzzImage(const std::uint8_t* data, std::size_t size)
{
  static const fuzz::ScratchFolder folder;
  const fuzz::Silence silence;
  try
  {
    const measuredbrdf::ImageFile image =
      measuredbrdf::ReadImageFile(folder.Write("image", fuzz::ToView(data, size)), size % 2 == 0);
    fuzz::Require(image.Width >= 1 && image.Height >= 1 &&
                  image.Pixels.size() == std::size_t(image.Width) * std::size_t(image.Height) *
                                           std::size_t(image.ValuesPerTexel));
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  return 0;
}

int FuzzFit(const std::uint8_t* data, std::size_t size)
{
  const auto file = measuredbrdf::FileBytes::View("file", fuzz::ToView(data, size));
  try
  {
    for (const std::string& name : measuredbrdf::FitFormat.ListMaterials(file))
    {
      fuzz::ReadFormat(measuredbrdf::FitFormat, data, size, name);
    }
  }
  catch (const measuredbrdf::FileError&)
  {
  }
  return 0;
}

int FuzzUtia(const std::uint8_t* data, std::size_t size)
{
  // The first byte says how; a file is large, and one in eight is made of the others again and
  // again.
  if (size < 2)
  {
    return 0;
  }
  // These take long, and are alike.
  const bool whole = std::accumulate(data, data + size, 0u) % 8 == 0;
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  while (whole && bytes.size() < measuredbrdf::UtiaBytes)
  {
    bytes += bytes.substr(0, measuredbrdf::UtiaBytes - bytes.size());
  }
  const std::string name = data[0] % 3 == 0 ? "display" : "";
  return fuzz::ReadFormat(measuredbrdf::UtiaFormat,
    reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), name);
}
