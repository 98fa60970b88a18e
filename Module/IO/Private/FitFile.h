// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Published fits as text, one material per entry:
 *
 *     # comment
 *     name = Aggregate(Lambertian(albedo = [r, g, b]), Model(attribute = value, ...))
 *
 * Models: Lambertian(albedo); NganBlinnPhong(albedo, sharpness) and
 * NganAshikhminShirley(albedo, fresnelReflectance, sharpness) of Ngan et al. 2005, Schlick's
 * Fresnel term; LowAshikhminShirley(same attributes) of Low et al. 2012, whose fresnelReflectance
 * is an index of refraction for the exact dielectric Fresnel term.
 */

#ifndef FitFile_h
#define FitFile_h

#include "FileFormat.h"
#include "FitParser.h"

#include <string>
#include <string_view>
#include <vector>

namespace measuredbrdf
{
/**
 * The text taken apart. Strict: one wrong entry makes the whole text wrong.
 */
class FitFile
{
public:
  /// path: what errors call the text.
  FitFile(const std::string& path, std::string_view text);

  /// In the order of the text.
  std::vector<std::string> GetNames() const;

  /// The material of that name; empty: the only one. Throws where there is no such one.
  MaterialFile GetMaterial(const std::string& name) const;

private:
  struct Entry
  {
    std::string Name;
    FitCall Expression;
  };
  const Entry& Find(const std::string& name) const;

  std::string Path;
  std::string Comments;
  std::vector<Entry> Entries;
};

/// The format, for vtkBRDFFormats.
class FitFormat : public FileFormat
{
public:
  static FitFormat* New();
  vtkTypeMacro(FitFormat, FileFormat);

  std::string GetName() override { return FitFormatName; }
  std::string GetDescription() override
  {
    return "published fits in .fit (FITS.fit#NAME for one of several)";
  }
  std::vector<std::string> GetExtensions() override { return { ".fit" }; }
  bool CanRead(const File& file) override;
  std::vector<std::string> GetMaterialNames(const File& file) override;

protected:
  MaterialFile DoRead(const FileBytes& file, const std::string& material) override;
  bool HoldsSeveral() override { return true; }
};
} // namespace measuredbrdf

#endif
