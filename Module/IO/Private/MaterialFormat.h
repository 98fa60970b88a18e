// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The module's own formats of materials: each is a row of functions, in the file that its name says
 * (MerlFormat in MerlFile.cxx). They throw FileError, or any std::exception; BuiltInFormat, which
 * vtkBRDFFormats lists, makes error texts of these. Private to the component IO.
 */

#ifndef MaterialFormat_h
#define MaterialFormat_h

#include "FileBytes.h"
#include "vtkBRDFFormat.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace measuredbrdf
{
using MaterialFile = vtkBRDFFormat::Content;

/// What vtkBRDFFormat's methods of the same names say and do.
struct MaterialFormat
{
  const char* Name;
  const char* Description;
  const char* Extension;
  bool (*CanRead)(const vtkBRDFFormat::File& file);
  /// material: what stands after '#' in `path#name`; empty where ListMaterials is null.
  MaterialFile (*Read)(const FileBytes& file, const std::string& material);
  /// Null: a file holds one material. May throw: then the file has no names.
  std::vector<std::string> (*ListMaterials)(const FileBytes& file) = nullptr;
  /// Null: read only.
  void (*Write)(vtkBRDF* brdf, const std::string& path, bool halfFloats) = nullptr;
  /// Null: writes any material as it is.
  vtkSmartPointer<vtkBRDF> (*Convert)(vtkBRDF* brdf, std::string& error) = nullptr;
};

extern const MaterialFormat AstmFormat;
extern const MaterialFormat BsdfXmlFormat;
extern const MaterialFormat ExrMaterialFormat; // of builds with OpenEXR
extern const MaterialFormat FitFormat;
extern const MaterialFormat MbsdfFormat;
extern const MaterialFormat MerlFormat;
extern const MaterialFormat OpenMaterialFormat;
extern const MaterialFormat TensorFormat;
extern const MaterialFormat UtiaFormat;

/// Bytes that an UTIA file has, exactly.
constexpr std::size_t UtiaBytes = 3u * 288u * 288u * 8u;

/// A format of the table as vtkBRDFFormats registers it.
class BuiltInFormat : public vtkBRDFFormat
{
public:
  static BuiltInFormat* New();
  vtkTypeMacro(BuiltInFormat, vtkBRDFFormat);

  static vtkSmartPointer<vtkBRDFFormat> Make(const MaterialFormat& format);

  std::string GetName() override { return this->Format->Name; }
  std::string GetDescription() override { return this->Format->Description; }
  std::vector<std::string> GetExtensions() override { return { this->Format->Extension }; }
  bool CanRead(const File& file) override { return this->Format->CanRead(file); }
  bool Read(const File& file, Content& content, std::string& error) override;
  std::vector<std::string> GetMaterialNames(const File& file) override;
  bool CanWrite() override { return this->Format->Write != nullptr; }
  vtkSmartPointer<vtkBRDF> Convert(vtkBRDF* brdf, std::string& error) override;
  bool Write(vtkBRDF* brdf, const std::string& path, bool halfFloats, std::string& error) override;

protected:
  BuiltInFormat();
  ~BuiltInFormat() override = default;

private:
  BuiltInFormat(const BuiltInFormat&) = delete;
  void operator=(const BuiltInFormat&) = delete;

  const MaterialFormat* Format; // one that reads nothing, but in what Make makes
};

/// Whether a file begins with the magic, or is too short for it but begins like it.
bool HasMagic(const vtkBRDFFormat::File& file, std::string_view magic);

/// Whether a path ends so, whatever the case; extension: lower case, with the dot.
bool HasExtension(const std::string& path, std::string_view extension);

/// The material's name is the file's; its source: "KIND file FILE" and what more there is to say.
void NameAfterFile(MaterialFile& result, const FileBytes& file, const std::string& kind,
  const std::string& more = "");

/// A note "COUNT what", where there are any.
void NoteCount(std::int64_t count, const std::string& what, MaterialFile& result);

/// What the material reflects toward a view at 30 degrees, as a note, where that is more than all
/// light or less than darkest. hint: what the values may be instead.
void NoteStrangeAlbedo(
  vtkBRDF* brdf, double darkest, const std::string& hint, MaterialFile& result);

/// Bytes of padding that a reader left out, as a note; nothing where there are none.
void NotePadding(const ByteReader& reader, MaterialFile& result);

/// R, G and B of an OpenEXR image, the top row first. Of builds with OpenEXR; throws what that
/// throws.
std::vector<float> ReadExrImage(const FileBytes& file, int& width, int& height);

//------------------------------------------------------------------------------
// Spectra (SpectralColor.cxx).

constexpr double FirstVisible = 380.0; // nm
constexpr double LastVisible = 780.0;

/// RGB = sum over k of weights[k] f(wavelengths[k]); wavelengths: nm, ascending, at least one. The
/// weights of each component add up to 1.
std::vector<glm::dvec3> GetSpectralWeights(const std::vector<double>& wavelengths);

///@{
/// "905nm", as in `path#905nm`.
std::string GetWavelengthName(double nanometers);
std::vector<std::string> GetWavelengthNames(const std::vector<double>& wavelengths);
///@}

/// Which of a file's wavelengths become RGB, and how.
struct SpectralChannels
{
  std::vector<std::size_t> Chosen;
  std::vector<glm::dvec3> Weights; // RGB = sum of weights * value, of each chosen one
  std::string Note;
};

/**
 * The visible wavelengths, as GetSpectralWeights sums them; fewer than two of them: the first
 * wavelength alone, gray. name: empty, or which wavelength, gray. Throws FileError, "WHERE, name:
 * ...", where there is no such one. wavelengths: nm, ascending, at least one.
 */
SpectralChannels ChooseChannels(
  const std::vector<double>& wavelengths, const std::string& name, const std::string& where);

//------------------------------------------------------------------------------
// Readings of a goniometer, listed in any order, as a material: vtkAngularTableBRDF
// (GonioTable.cxx).

/// What was read under one light from one view. Angles are in degrees, polar ones in [0, 90].
struct GonioReading
{
  float ThetaI;
  float PhiI;
  float ThetaO;
  float PhiO;
  glm::dvec3 Color; // f, linear RGB
};

/**
 * Readings on a grid become the table's nodes, as they are. Holes in the grid are filled linearly
 * around the circle of the same polar angle, empty circles from their neighbors; what is not so
 * much as a quarter full is no grid. Then each light's views are interpolated onto even nodes,
 * 2 degrees apart, or more where there are many lights.
 *
 * Where PhiI is the same in all, the material is taken to be isotropic. One whose azimuths are all
 * in [0, 180] is mirrored. Its value for light or view along the normal is the mean over azimuths.
 * Angles less than 0.01 degrees apart are one; readings of the same directions are averaged. Beyond
 * the last polar angle the value is constant. Notes say where the readings are and what was filled.
 *
 * Throws FileError, "WHERE: what is wrong with the readings".
 */
void MakeGonioTable(
  std::vector<GonioReading> readings, const std::string& where, MaterialFile& result);
} // namespace measuredbrdf

#endif
