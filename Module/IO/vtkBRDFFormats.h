// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFFormats
 * @brief   the file formats of materials that this program knows
 *
 * Formats that the program registered come first, the last one foremost; then those of the module:
 * RGL tensor files, NVIDIA MBSDF, OpenEXR materials, BSDF XML, OpenMATERIAL 3D, ASTM E1392,
 * published fits, UTIA, MERL binary. A file is of the
 * first format that can read it. Registering takes effect at once, in every reader and writer; any
 * thread may call these methods.
 */

#ifndef vtkBRDFFormats_h
#define vtkBRDFFormats_h

#include "vtkBRDFFormat.h"         // for Find
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for formats

#include <string> // for names
#include <vector> // for formats

class VTKMEASUREDBRDF_EXPORT vtkBRDFFormats : public vtkObject
{
public:
  static vtkBRDFFormats* New();
  vtkTypeMacro(vtkBRDFFormats, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add a format, or take one away that was added. Returns whether it worked: Register refuses
   * null and a name that is taken, by an error event; the module's own formats stay.
   */
  static bool Register(vtkBRDFFormat* format);
  static bool Unregister(vtkBRDFFormat* format);
  ///@}

  /// All of them, in the order in which they are asked.
  static std::vector<vtkSmartPointer<vtkBRDFFormat>> GetFormats();

  /// The first that can read the file; null where there is none.
  static vtkSmartPointer<vtkBRDFFormat> FindForReading(const vtkBRDFFormat::File& file);

  /// The first that can write and has the extension (lower case, with the dot); null: none.
  static vtkSmartPointer<vtkBRDFFormat> FindForWriting(const std::string& extension);

  ///@{
  /**
   * For messages and help: the names, descriptions or extensions of the formats in one line,
   * "A, B or C"; of those only that can be written where writable is true.
   */
  static std::string GetNames(bool writable = false);
  static std::string GetDescriptions(bool writable = false);
  static std::string GetExtensions(bool writable = false);
  ///@}

protected:
  vtkBRDFFormats() = default;
  ~vtkBRDFFormats() override = default;

private:
  vtkBRDFFormats(const vtkBRDFFormats&) = delete;
  void operator=(const vtkBRDFFormats&) = delete;
};

#endif
