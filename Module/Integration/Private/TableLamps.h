// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lamps beside a table of radiance, which holds what they show outside of a window about the lobe's
 * axis.
 */

#ifndef TableLamps_h
#define TableLamps_h

#include "LampWindow.h"
#include "LocalFrame.h"
#include "vtkBRDFShaderInputs.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <vector>

class vtkBRDF;
class vtkLightSet;

namespace measuredbrdf
{
class TableLamps
{
public:
  /// shaded: what the graphics card evaluates; prepared. A LampBRDF sees the parts of a LampSet.
  TableLamps(vtkLightSet* lights, vtkBRDF* shaded);
  ~TableLamps();

  const LampWindow& GetWindow() const { return this->Window; }

  /// Sum of w (f - lambert) cos(theta_i) E, of either sign: the Lambert part of all light is the
  /// table's. view: in the frame; axis: of the lobe, in the environment's.
  glm::dvec3 Sum(const Frame& frame, const glm::dvec3& view, const glm::dvec3& axis,
    const glm::dvec3& lambert) const;

  /// The same as GLSL, which the table's text calls.
  void AddTo(vtkBRDFShaderInputs::Term& table) const;

private:
  vtkBRDFShaderInputs::Texture MakeTexture() const;

  struct Part
  {
    glm::dvec3 Direction;
    glm::dvec3 Irradiance;
  };

  vtkSmartPointer<vtkLightSet> Lights;
  vtkSmartPointer<vtkBRDF> Shaded;
  std::vector<std::vector<Part>> Parts; // of each light; none: they are seen whole
  LampWindow Window;
};
} // namespace measuredbrdf

#endif
