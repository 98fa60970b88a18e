// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEmbeddedEnvironments
 * @brief   environments that need no download: a real room and two computed ones
 *
 * "room": a photographed hotel room, 512 x 256 (Poly Haven, CC0 1.0; NOTICE says where it is from
 * and what was done to it). "sky", "hall": procedural.
 */

#ifndef vtkEmbeddedEnvironments_h
#define vtkEmbeddedEnvironments_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <string> // for names

class vtkEnvironment;

class VTKMEASUREDBRDF_EXPORT vtkEmbeddedEnvironments : public vtkObject
{
public:
  static vtkEmbeddedEnvironments* New();
  vtkTypeMacro(vtkEmbeddedEnvironments, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The environments by index: a name for the command line, and the source.
   */
  static int GetNumberOfEnvironments();
  static std::string GetName(int index);
  static std::string GetSource(int index);
  ///@}

  /**
   * A new environment the caller owns, or null where there is no such name.
   */
  VTK_NEWINSTANCE static vtkEnvironment* NewEnvironment(const std::string& name);

protected:
  vtkEmbeddedEnvironments() = default;
  ~vtkEmbeddedEnvironments() override = default;

private:
  vtkEmbeddedEnvironments(const vtkEmbeddedEnvironments&) = delete;
  void operator=(const vtkEmbeddedEnvironments&) = delete;
};

#endif
