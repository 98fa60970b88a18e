// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEmbeddedMaterials
 * @brief   acquired materials that need no download: a measured car paint, and published fits to
 *          MERL measurements
 *
 * The car paint is a measurement, 45 x 45 x 90 directions, by NVIDIA (MDL SDK, CC0 1.0), its values
 * rounded to 16-bit floats; NOTICE says where it is from. The others are fits: figures from Ngan,
 * Durand and Matusik 2005 ("Experimental Analysis of BRDF Models", supplemental material) and Low,
 * Kronander, Ynnerman and Unger 2012 ("BRDF Models for Accurate and Efficient Rendering of Glossy
 * Surfaces"). Ngan's were fitted to MERL data without its color scale, so their RGB is multiplied
 * by 1.00, 1.15, 1.66 here.
 */

#ifndef vtkEmbeddedMaterials_h
#define vtkEmbeddedMaterials_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <string> // for names

class vtkBRDF;

class VTKMEASUREDBRDF_EXPORT vtkEmbeddedMaterials : public vtkObject
{
public:
  static vtkEmbeddedMaterials* New();
  vtkTypeMacro(vtkEmbeddedMaterials, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The materials by index: a name for the command line ("gold-paint"), a kind ("fabric"), and the
   * source (paper, model, MERL's name of the sample).
   */
  static int GetNumberOfMaterials();
  static std::string GetName(int index);
  static std::string GetKind(int index);
  static std::string GetSource(int index);
  ///@}

  /**
   * A new BRDF the caller owns, or null, with an error message that gives the names, where there is
   * none of that name.
   */
  VTK_NEWINSTANCE static vtkBRDF* NewBRDF(const std::string& name);

protected:
  vtkEmbeddedMaterials() = default;
  ~vtkEmbeddedMaterials() override = default;

private:
  vtkEmbeddedMaterials(const vtkEmbeddedMaterials&) = delete;
  void operator=(const vtkEmbeddedMaterials&) = delete;
};

#endif
