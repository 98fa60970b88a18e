// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFFormat
 * @brief   one file format of materials: superclass of those that are built in and of yours
 *
 * Subclass it, implement GetName, GetDescription, GetExtensions, CanRead and Read (and Write where
 * the format can be written), and hand an instance to vtkBRDFFormats::Register: vtkBRDFReader,
 * vtkBRDFWriter and every program that uses them then know the format. Examples/Cxx/CustomFormat
 * is one.
 *
 * Formats keep nothing of a file: two threads may read by one instance at a time.
 */

#ifndef vtkBRDFFormat_h
#define vtkBRDFFormat_h

#include "vtkBRDF.h"               // for Content
#include "vtkBTDF.h"               // for Content
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Content

#include <string>      // for names
#include <string_view> // for bytes
#include <vector>      // for names

class VTKMEASUREDBRDF_EXPORT vtkBRDFFormat : public vtkObject
{
public:
  vtkTypeMacro(vtkBRDFFormat, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// A file that is read: its whole contents are in memory.
  struct File
  {
    std::string Path;       // what errors call it
    std::string Material;   // what stands after '#' in `path#name`; empty: nothing
    std::string_view Bytes; // at least one
  };

  /// What a file gives.
  struct VTKMEASUREDBRDF_EXPORT Content
  {
    vtkSmartPointer<vtkBRDF> BRDF;
    vtkSmartPointer<vtkBTDF> Transmission; // null: none. Alone it is offered, and an error
    std::string Notes; // for people: what was converted, scaled, clamped, repaired
    vtkIdType NumberOfNegativeValues = 0;
    vtkIdType NumberOfInvalidValues = 0; // NaN or infinite

    /// Add a line to Notes, which may quote the file: it is made fit for a terminal, and bounded.
    void AddNote(const std::string& note);
  };

  /// "MERL binary": what messages call the format. Unique among the formats.
  virtual std::string GetName() = 0;

  /// "MERL .binary (Matusik et al. 2003)": for a program's help, in a list.
  virtual std::string GetDescription() = 0;

  /// Lower case, with the dot, the usual one first. Writers choose formats by them, readers don't.
  virtual std::vector<std::string> GetExtensions() = 0;

  /// Whether the bytes begin as this format's do; a damaged file of the format is still one of it.
  virtual bool CanRead(const File& file) = 0;

  /**
   * Read the material: f in 1/sr, linear RGB, without cosine. Returns whether it worked; if not,
   * error says what is wrong: the file, the byte or field, and what was expected. Exceptions are
   * errors, too. Check sizes against the number of bytes before anything is allocated.
   */
  virtual bool Read(const File& file, Content& content, std::string& error) = 0;

  /// Names of the materials in a file that holds several, for `path#name`; default: none.
  virtual std::vector<std::string> GetMaterialNames(const File& file);

  /// Whether Write does anything; default: no.
  virtual bool CanWrite() { return false; }

  /**
   * What the format can hold of the material: default and best the material itself; a format of
   * tables resamples it. Null, and error says why, where it can't hold anything like it.
   */
  virtual vtkSmartPointer<vtkBRDF> Convert(vtkBRDF* brdf, std::string& error);

  /**
   * Write a material as Convert gives them: the whole file or none. halfFloats: tables as 16-bit
   * floats where the format has them. Returns whether it worked; if not, error says why.
   */
  virtual bool Write(vtkBRDF* brdf, const std::string& path, bool halfFloats, std::string& error);

protected:
  vtkBRDFFormat() = default;
  ~vtkBRDFFormat() override = default;

private:
  vtkBRDFFormat(const vtkBRDFFormat&) = delete;
  void operator=(const vtkBRDFFormat&) = delete;
};

#endif
