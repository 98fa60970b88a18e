// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPVSurfaceVisibilityFilter
 * @brief   ParaView's filter "Surface Visibility": vtkSurfaceVisibilityFilter for surfaces that
 *          several processes share
 *
 * Each process traces the points of its own part, and the parts of all others hide them: every
 * process holds the points and polygons of the whole surface while it traces. The arrays are those
 * of the surface in one piece. What the parts of others hide is black with Bounce, too.
 *
 * Surfaces without point normals get those that the representation "Measured Material" would give
 * them (vtkMissingNormalsFilter), so that the arrays fit what it draws.
 */

#ifndef vtkPVSurfaceVisibilityFilter_h
#define vtkPVSurfaceVisibilityFilter_h

#include "vtkNew.h"                       // for Tracer
#include "vtkPVMeasuredMaterialsModule.h" // for export macro
#include "vtkPassInputTypeAlgorithm.h"

class vtkSurfaceVisibilityFilter;

class VTKPVMEASUREDMATERIALS_EXPORT vtkPVSurfaceVisibilityFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkPVSurfaceVisibilityFilter* New();
  vtkTypeMacro(vtkPVSurfaceVisibilityFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * As vtkSurfaceVisibilityFilter has them.
   */
  vtkSetClampMacro(NumberOfRays, int, 64, 4096);
  vtkGetMacro(NumberOfRays, int);
  vtkSetClampMacro(MaximumDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumDistance, double);
  vtkSetMacro(BothSides, bool);
  vtkGetMacro(BothSides, bool);
  vtkSetMacro(Bounce, bool);
  vtkGetMacro(Bounce, bool);
  ///@}

  ///@{
  /**
   * Whether surfaces without normals get some (default on), and the angle in degrees (default 30)
   * from which edges stay sharp. Without, their arrays are of the polygons' mean normals.
   */
  vtkSetMacro(GenerateMissingNormals, bool);
  vtkGetMacro(GenerateMissingNormals, bool);
  vtkSetClampMacro(MissingNormalsFeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(MissingNormalsFeatureAngle, double);
  ///@}

  ///@{
  /**
   * What several processes gather on each of them at most, in MiB: points and polygons of all parts
   * of the surface, at 8 bytes an index. Default 2047, the most that MPI's counts allow. A larger
   * surface gets no arrays, and the first process says so.
   */
  vtkSetClampMacro(GatherLimit, int, 1, 2047);
  vtkGetMacro(GatherLimit, int);
  ///@}

protected:
  vtkPVSurfaceVisibilityFilter();
  ~vtkPVSurfaceVisibilityFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int NumberOfRays = 128;
  double MaximumDistance = 0.0;
  bool BothSides = false;
  bool Bounce = false;
  int GatherLimit = 2047;
  bool GenerateMissingNormals = true;
  double MissingNormalsFeatureAngle = 30.0;
  vtkNew<vtkSurfaceVisibilityFilter> Tracer; // knows what it has traced

private:
  vtkPVSurfaceVisibilityFilter(const vtkPVSurfaceVisibilityFilter&) = delete;
  void operator=(const vtkPVSurfaceVisibilityFilter&) = delete;

  void FollowTracer();
};

#endif
