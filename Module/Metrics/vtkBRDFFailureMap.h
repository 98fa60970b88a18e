// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFFailureMap
 * @brief   at which angles a BRDF (a fit, a projection, what shaders get) is far from a reference
 *
 * Two maps of relative error, each over the cells of a square grid: over the polar angles of i and
 * o, and over those of the half vector and of the difference (Rusinkiewicz 1998). A cell's error is
 * that of its center over all azimuths together, sum |f - r| / sum r over azimuths and channels:
 * that of the light that a ring of theta_i reflects to a view of theta_o. A share: 0.02 is 2 %. NaN
 * where the reference is black or every pair lies below the horizon.
 *
 * Polar angles of i and o beyond those whose cosine is 0.02 count as that (88.85 degrees): nothing
 * nearer to the horizon is shaded, and measured f grows as 1/cos there. Over theta_h and theta_d
 * such pairs are left out.
 */

#ifndef vtkBRDFFailureMap_h
#define vtkBRDFFailureMap_h

#include "vtkBRDF.h"               // for BRDF, Reference
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkNew.h"                // for images
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF, Reference

#include <array>  // for worst angles
#include <atomic> // for Abort
#include <vector> // for worst angles

class vtkImageData;

class VTKMEASUREDBRDF_EXPORT vtkBRDFFailureMap : public vtkObject
{
public:
  static vtkBRDFFailureMap* New();
  vtkTypeMacro(vtkBRDFFailureMap, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What is right, and what is measured against it.
   */
  void SetReference(vtkBRDF* reference);
  vtkBRDF* GetReference() { return this->Reference; }
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF() { return this->BRDF; }
  ///@}

  ///@{
  /**
   * Cells along each axis of the maps; default 60 (1.5 degrees), clamped to [2, 720].
   */
  virtual void SetNumberOfCells(int numberOfCells);
  vtkGetMacro(NumberOfCells, int);
  ///@}

  ///@{
  /**
   * Azimuths of each cell, evenly over the full turn (of i from o, or of the difference vector),
   * 180 degrees among them where it is even; default 120, clamped to [2, 3600]. Where a BRDF is
   * anisotropic, each comes with another azimuth of the whole pair.
   */
  virtual void SetNumberOfAzimuths(int numberOfAzimuths);
  vtkGetMacro(NumberOfAzimuths, int);
  ///@}

  /**
   * Compute what follows. Returns false with an error event, results unchanged, without both BRDFs
   * or where it was aborted. Raises ProgressEvent (calldata: double*).
   */
  bool Update();

  ///@{
  /**
   * NumberOfCells x NumberOfCells points at the cells' centers, one double each ("Error"). Empty
   * before Update. IncidentOutgoing: x is theta_i, y is theta_o, in degrees. HalfDifference: x is
   * sqrt(theta_h / 90 degrees) in [0,1], which is MERL's axis, fine where highlights are, y is
   * theta_d in degrees.
   */
  vtkImageData* GetIncidentOutgoing() { return this->IncidentOutgoing; }
  vtkImageData* GetHalfDifference() { return this->HalfDifference; }
  ///@}

  /**
   * sum |f - r| / sum r over all of IncidentOutgoing, weighted by both cosines and solid angles.
   */
  vtkGetMacro(RelativeL1, double);

  ///@{
  /**
   * The worst cells of IncidentOutgoing, the worst first, 5 at most, each 10 degrees or more from
   * those before. Angles: theta_i, theta_o and the azimuth of i from o in [0,360) at which |f - r|
   * is largest, in degrees; 180 is the mirror direction's side. Zeros for an index out of range.
   */
  int GetNumberOfWorstAngles() { return static_cast<int>(this->Worst.size()); }
  void GetWorstAngles(int index, double angles[3]);
  double GetWorstError(int index);
  ///@}

  ///@{
  /**
   * Set from an observer or another thread to stop a running Update, which starts with it cleared.
   */
  void SetAbort(bool abort) { this->Abort = abort; }
  bool GetAbort() { return this->Abort; }
  ///@}

protected:
  vtkBRDFFailureMap();
  ~vtkBRDFFailureMap() override;

  vtkSmartPointer<vtkBRDF> Reference;
  vtkSmartPointer<vtkBRDF> BRDF;
  int NumberOfCells = 60;
  int NumberOfAzimuths = 120;
  vtkNew<vtkImageData> IncidentOutgoing;
  vtkNew<vtkImageData> HalfDifference;
  double RelativeL1 = 0.0;
  std::vector<std::array<double, 4>> Worst; // angles and error
  std::atomic<bool> Abort{ false };

private:
  vtkBRDFFailureMap(const vtkBRDFFailureMap&) = delete;
  void operator=(const vtkBRDFFailureMap&) = delete;
};

#endif
