// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTracedScene
 * @brief   surfaces that hide each other from the light, and rays against them
 *
 * Add the surfaces of a scene, each with its actor's matrix. vtkTracedRadianceIntegrator then gives
 * the radiance that leaves a point of them, and vtkOcclusionPredictor how much a picture without
 * occlusion is off. Polygons and strips hide from both sides; vertices and lines hide nothing.
 * Triangles without area, or with coordinates that are not finite, are left out and counted.
 *
 * A scene takes about 54 bytes a triangle of a closed mesh, and 12 a point with normals.
 */

#ifndef vtkTracedScene_h
#define vtkTracedScene_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"

#include <memory> // for surfaces
#include <string> // for names

class vtkDataArray;
class vtkMatrix4x4;
class vtkPolyData;
class vtkTracedSurfaces;

class VTKMEASUREDBRDF_EXPORT vtkTracedScene : public vtkObject
{
public:
  static vtkTracedScene* New();
  vtkTypeMacro(vtkTracedScene, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Add a surface; matrix: from its coordinates to the world's, affine, null: the same. Point
   * normals are taken where it has them (3 components), else its facets'. The surface is read when
   * the scene is built: its arrays must not change between this call and then, and changes
   * thereafter do not count until it is added anew. Returns its number, 0, 1, 2..., or -1 with an
   * error event, nothing added, where it is null, the matrix is not finite or not affine, or there
   * are more than 2^32 - 2 points or cells.
   */
  int AddSurface(vtkPolyData* surface, vtkMatrix4x4* matrix = nullptr);

  /**
   * Remove them all.
   */
  void RemoveAllSurfaces();

  int GetNumberOfSurfaces();

  /**
   * Make ready for rays what was added since the last call. All that trace do so themselves.
   */
  void Build();

  ///@{
  /**
   * Of all surfaces, built if necessary: triangles; those that were left out; bounds (xmin, xmax,
   * ymin..., all 0 where there is no triangle).
   */
  vtkIdType GetNumberOfTriangles();
  vtkIdType GetNumberOfSkippedTriangles();
  void GetBounds(double bounds[6]);
  ///@}

  /**
   * Where rays from origins along directions (3 components, any length but 0, world) meet a surface
   * first. hits becomes one point a ray, with the point arrays
   *
   * * "Normals": interpolated, unit, on the side that the ray came from;
   * * "FacetNormals": the triangle's own, unit, on that side;
   * * "Surface": the surface's number, -1 where the ray meets nothing (then all else is 0);
   * * "Cell": the surface's cell.
   *
   * Points lie where the normals say the surface is, a little above triangles of bulging surfaces:
   * Hanika 2021, "Hacking the Shadow Terminator" (Ray Tracing Gems II, chapter 4). Rays that leave
   * from there do not meet the facets of a surface that is drawn as a smooth one. Returns false
   * with an error event, hits unchanged, where arrays are missing or do not match.
   */
  bool CastRays(vtkDataArray* origins, vtkDataArray* directions, vtkPolyData* hits);

  /**
   * Points as distant cameras see them: `count` hits of parallel rays, spread evenly over the
   * scene's picture. viewDirection: towards the camera; all 0: cameras all around, evenly over the
   * sphere. views becomes the unit directions towards the camera. The same call gives the same
   * points. Fewer come where rays hardly ever meet anything, none from an empty scene. Returns
   * false with an error event where arrays are missing, viewDirection is not finite, or count is
   * not from 1 to 10^7.
   */
  bool DrawVisiblePoints(
    vtkIdType count, const double viewDirection[3], vtkPolyData* hits, vtkDataArray* views);

#ifndef __VTK_WRAP__
  /// For integrators.
  const vtkTracedSurfaces& GetSurfaces();
#endif

protected:
  vtkTracedScene();
  ~vtkTracedScene() override;

private:
  vtkTracedScene(const vtkTracedScene&) = delete;
  void operator=(const vtkTracedScene&) = delete;

  std::unique_ptr<vtkTracedSurfaces> Data;
};

#endif
