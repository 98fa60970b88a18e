// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceVisibilityFilter
 * @brief   which part of the sky each point of a surface sees, as point arrays
 *
 * A surface hides part of its surroundings from itself: the environment does not light its hollows
 * as it lights a sphere. This filter traces rays from each point and adds what is hidden to the
 * surface as two point arrays, 60 bytes a point (and a third one of 9, see Bounce).
 * vtkMeasuredBRDFMapper and vtkCompositeMeasuredBRDFMapper shade with them, whatever the
 * environment, its rotation and the material (SetOcclusionMode). Written to a file, they need not
 * be computed again.
 *
 * Input: polydata, or composite data whose blocks are polydata. All blocks hide one another. The
 * output is the same data with the arrays.
 *
 * - "MeasuredBRDFHiddenSky", 35 unsigned bytes: a normal (3: 12 bits for each side of the unit
 *   octahedron, low bits first), then for each of 16 sectors of azimuth the lower and the upper
 *   sine of elevation between which the sky is hidden, 255 for 1; or, in hollows, first the upper
 *   and then the lower one between which it is visible: where the sum of the first ones exceeds
 *   that of the second ones. Azimuths count from the first column of the frame about the normal
 *   (Duff et al. 2017).
 * - "MeasuredBRDFHiddenLight", 25 unsigned bytes: orthonormal spherical harmonics of degree 0 to 4
 *   of the hidden part of cos(theta) about the normal, in the surface's own axes; 127 for 0, steps
 *   of 1.05 / 127.
 * - With Bounce, "MeasuredBRDFBouncedLight", 9 unsigned bytes: the irradiance that comes back from
 *   what is hidden, if that is matte and white, as a linear function of the light's orthonormal
 *   harmonics of degree 0 to 2 in the surface's own axes. The first byte is the root of the first
 *   factor in steps of 0.9415 / 255; the others are relative to that factor, 127 for 0, steps of
 *   2.25 / 127.
 * - All of them again with the suffix "Back", for the other side, with BothSides.
 * - Field data "MeasuredBRDFVisibilityKey": a version, and a hash of the surface's points, normals
 *   and cells. Mappers compare it: arrays of a surface that has changed since are not used.
 *
 * Normals are the point normals of the data, otherwise the polygons' means by area. Points that
 * belong to no polygon see the whole sky. Polygons and strips hide from both sides; vertices and
 * lines hide nothing.
 *
 * Rays are the same about every normal: 16 sectors, a number of elevations each. Results depend
 * neither on the number of threads nor on chance. An input whose points, polygons, normals and
 * occluders are what they were, whatever else has changed, is not traced again. ProgressEvent says
 * how far it is; an aborted run (SetAbortExecute) leaves the output without the arrays.
 */

#ifndef vtkSurfaceVisibilityFilter_h
#define vtkSurfaceVisibilityFilter_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // for Internals

class vtkActor;
class vtkMatrix4x4;
class vtkPolyData;

class VTKMEASUREDBRDF_EXPORT vtkSurfaceVisibilityFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkSurfaceVisibilityFilter* New();
  vtkTypeMacro(vtkSurfaceVisibilityFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Rays from each point, rounded to a multiple of 16; default 128, clamped to [64, 4096].
   */
  virtual void SetNumberOfRays(int numberOfRays);
  vtkGetMacro(NumberOfRays, int);
  ///@}

  ///@{
  /**
   * What is farther away than this hides nothing, in the surface's units; default 0: no limit.
   */
  virtual void SetMaximumDistance(double maximumDistance);
  vtkGetMacro(MaximumDistance, double);
  ///@}

  ///@{
  /**
   * Whether the side that the normals turn away from gets arrays, too; default off. For sheets that
   * are seen from both sides, and for surfaces whose normals point inwards.
   */
  vtkSetMacro(BothSides, bool);
  vtkGetMacro(BothSides, bool);
  vtkBooleanMacro(BothSides, bool);
  ///@}

  ///@{
  /**
   * Whether points also get what comes back to them from what hides the sky, after one bounce;
   * default off. It takes nearly as long as the rest, on top, and 9 bytes a point:
   * vtkMeasuredBRDFMapper::OcclusionBounceOn shades with it. Occluders reflect nothing; nor does
   * the other side of a surface without BothSides.
   */
  vtkSetMacro(Bounce, bool);
  vtkGetMacro(Bounce, bool);
  vtkBooleanMacro(Bounce, bool);
  ///@}

  ///@{
  /**
   * Whether the surface hides itself; default on. Off: only the occluders below do.
   */
  vtkSetMacro(SelfOcclusion, bool);
  vtkGetMacro(SelfOcclusion, bool);
  vtkBooleanMacro(SelfOcclusion, bool);
  ///@}

  ///@{
  /**
   * Further surfaces that hide. matrix takes an occluder's coordinates to the input's; null: they
   * are the same. Both are shared, not copied: a change of them shows in the next Update.
   */
  void AddOccluder(vtkPolyData* surface, vtkMatrix4x4* matrix = nullptr);
  void RemoveAllOccluders();
  int GetNumberOfOccluders();
  ///@}

  /**
   * The polydata that an actor's mapper shows now, placed beside the input as it stands beside
   * `self`, the actor that shows the input (null: the input is in world coordinates). Actors that
   * move later need a new call. Returns false with an error event where there is no polydata.
   */
  bool AddOccluder(vtkActor* actor, vtkActor* self);

  ///@{
  /**
   * Names of the arrays.
   */
  static const char* GetHiddenSkyArrayName() { return "MeasuredBRDFHiddenSky"; }
  static const char* GetHiddenLightArrayName() { return "MeasuredBRDFHiddenLight"; }
  static const char* GetBouncedLightArrayName() { return "MeasuredBRDFBouncedLight"; }
  static const char* GetKeyArrayName() { return "MeasuredBRDFVisibilityKey"; }
  ///@}

  /**
   * How many times surfaces were traced: what is known already is not traced again.
   */
  vtkGetMacro(NumberOfTraces, int);

  vtkMTimeType GetMTime() override;

protected:
  vtkSurfaceVisibilityFilter();
  ~vtkSurfaceVisibilityFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int NumberOfRays = 128;
  double MaximumDistance = 0.0;
  bool BothSides = false;
  bool Bounce = false;
  bool SelfOcclusion = true;
  int NumberOfTraces = 0;

private:
  vtkSurfaceVisibilityFilter(const vtkSurfaceVisibilityFilter&) = delete;
  void operator=(const vtkSurfaceVisibilityFilter&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
