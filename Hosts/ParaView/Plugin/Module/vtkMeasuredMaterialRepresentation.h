// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeasuredMaterialRepresentation
 * @brief   ParaView's representation "Measured Material": surfaces of a measured material
 *
 * Draws what "Surface" draws by vtkCompositeMeasuredBRDFMapper. Materials and environments are
 * named: a built-in one, or "File" and a file's path. On a parallel server each rank reads the
 * files, as ParaView's own readers do, and plans from the same input in the foreground. What cannot
 * be read is said once, and the surface is drawn as "Surface" draws it, on all ranks.
 */

#ifndef vtkMeasuredMaterialRepresentation_h
#define vtkMeasuredMaterialRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkPVMeasuredMaterialsModule.h" // for export macro

#include <memory> // for Internals
#include <string> // for Plan

class vtkDataObjectTree;

class VTKPVMEASUREDMATERIALS_EXPORT vtkMeasuredMaterialRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkMeasuredMaterialRepresentation* New();
  vtkTypeMacro(vtkMeasuredMaterialRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material: a name of vtkEmbeddedMaterials, or "File" for the file. Default "gold-paint".
   */
  void SetMeasuredMaterial(const char* name);
  void SetMeasuredMaterialFile(const char* path);
  ///@}

  ///@{
  /**
   * Materials of blocks, by selector ("/Root/Wing") and name or path. The first material above
   * serves all others.
   */
  void SetBlockMaterial(const char* selector, const char* material);
  void RemoveAllBlockMaterials();
  ///@}

  ///@{
  /**
   * Whether data choose the materials (vtkMaterialMap): 0 no (default), 1 an array of classes, 2 an
   * array of values on a scale, 3 components of a point array as weights, 4 images of weights over
   * the texture coordinates. The array is a point or cell array; the materials are pairs of a class
   * or value (for weights a number, in whose order they belong to the components) and a name or
   * path. The images are files (vtkPictureReader) of three components each, or four with alpha. The
   * first material above is that of places that the data say nothing of. It is drawn everywhere
   * where an image or a material of weights cannot be read, and by levels of detail that lack the
   * array.
   */
  void SetMaterialMapMode(int mode);
  void SetMaterialMapArray(const char* name);
  void SetMapMaterial(const char* value, const char* material);
  void RemoveAllMapMaterials();
  void AddWeightImage(const char* path);
  void RemoveAllWeightImages();
  ///@}

  ///@{
  /**
   * The environment: "Automatic" (default) is the view's own where it has one, else "room". "View"
   * is the view's own only. Other names are those of vtkEmbeddedEnvironments, or "File". The
   * up axis is the world's x, y (default) or z axis (0, 1, 2); the rotation is about it, in
   * degrees. Both leave the view's own environment as it is.
   */
  void SetMeasuredEnvironment(const char* name);
  void SetMeasuredEnvironmentFile(const char* path);
  void SetMeasuredEnvironmentRotation(double degrees);
  void SetMeasuredEnvironmentUpAxis(int axis);
  ///@}

  ///@{
  /**
   * As vtkMeasuredBRDFMapper has them: the error tolerance in [0.001, 1], default 0.02; what a
   * pixel may cost, times a table's, in [1, 1e6], default 150; whether scalar colors multiply the
   * radiance (default on); whether the view's lights light the material beside the environment
   * (default off: ParaView's light kit stands for an environment).
   */
  void SetErrorTolerance(double tolerance);
  void SetMaximumCost(double cost);
  void SetModulateByScalars(bool modulate);
  void SetUseViewLights(bool use);
  ///@}

  ///@{
  /**
   * What the surface hides of the environment from itself, as vtkMeasuredBRDFMapper has it: 0 off,
   * 1 (default) where its predicted error exceeds what the tolerance leaves, 2 on; and whether what
   * hides reflects, too (default off). A surface of which several processes have parts is drawn
   * without; with 2 the first process warns once.
   */
  void SetOcclusionMode(int mode);
  void SetOcclusionBounce(bool bounce);
  ///@}

  /**
   * Whether plans are made in the background while the user interacts (default on). Still pictures
   * wait for the plan. With several ranks plans are always made in the foreground.
   */
  void SetPlanInBackground(bool background);

  ///@{
  /**
   * Whether surfaces without normals get some (default on), and the angle in degrees (default 30)
   * from which edges stay sharp.
   */
  void SetGenerateMissingNormals(bool generate);
  void SetMissingNormalsFeatureAngle(double degrees);
  ///@}

  /**
   * What the last picture was drawn by: method, predicted error, memory and why, a line for each
   * material. Empty in a client while its server draws: the proxy asks the server.
   */
  const char* GetPlan();

  int ProcessViewRequest(vtkInformationRequestKey* requestType, vtkInformation* inInfo,
    vtkInformation* outInfo) override;

protected:
  vtkMeasuredMaterialRepresentation();
  ~vtkMeasuredMaterialRepresentation() override;

  void SetupDefaults() override;
  void SetPointArrayToProcess(int index, const char* name) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  std::string Plan;

private:
  vtkMeasuredMaterialRepresentation(const vtkMeasuredMaterialRepresentation&) = delete;
  void operator=(const vtkMeasuredMaterialRepresentation&) = delete;

  void NamesChanged();
  template <typename Function>
  void ForEachMapper(const Function& function); // (mapper, whether it draws the level of detail)
  int FindOcclusionMode(vtkDataObject* data, bool interactive);
  void WarnOfParts();
  void UpdateMappers(vtkDataObject* data, vtkDataObject* levelOfDetail);
  void UpdateBlocks(vtkDataObjectTree* data);

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
