// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFFailureMap
 * @brief   shows at which angles a BRDF (a fit, a projection, a GPU form) differs from a reference
 *
 * Two maps of relative error, each over the cells of a square grid: over the polar angles of i and
 * o, and over those of the half vector and of the difference (Rusinkiewicz 1998). A cell's error is
 * computed at its center over all azimuths together, sum |f - r| / sum r over azimuths and
 * channels. It is the error of the light that a ring of theta_i reflects to a view of theta_o.
 * Errors are shares: 0.02 is 2 %. They are NaN where the reference is black or every pair lies
 * below the horizon.
 *
 * Polar angles of i and o whose cosine is below 0.02 (88.85 degrees) are replaced by that angle:
 * directions nearer to the horizon are never shaded, and measured f grows as 1/cos there. Over
 * theta_h and theta_d such pairs are left out.
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
   * The reference, and the BRDF that is compared with it.
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
   * Number of azimuths of each cell, evenly over the full turn (of i from o, or of the difference
   * vector); an even number includes 180 degrees. Default 120, clamped to [2, 3600]. For
   * anisotropic BRDFs each is combined with a different azimuth of the whole pair.
   */
  virtual void SetNumberOfAzimuths(int numberOfAzimuths);
  vtkGetMacro(NumberOfAzimuths, int);
  ///@}

  /**
   * Compute the results below. Returns false with an error event and leaves them unchanged without
   * both BRDFs or when aborted. Raises ProgressEvent (calldata: double*).
   */
  bool Update();

  ///@{
  /**
   * NumberOfCells x NumberOfCells points at the cells' centers, one double each ("Error"). Empty
   * before Update. IncidentOutgoing: x is theta_i, y is theta_o, in degrees. HalfDifference: x is
   * sqrt(theta_h / 90 degrees) in [0,1], as on MERL's axis, which is fine near highlights; y is
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
   * The worst cells of IncidentOutgoing, the worst first, at most 5, each at least 10 degrees from
   * the ones before. Angles: theta_i, theta_o and the azimuth of i from o in [0,360) at which
   * |f - r| is largest, in degrees; 180 is the side of the mirror direction. Zeros for an index out
   * of range.
   */
  int GetNumberOfWorstAngles() { return static_cast<int>(this->Worst.size()); }
  void GetWorstAngles(int index, double angles[3]);
  double GetWorstError(int index);
  ///@}

  ///@{
  /**
   * Set this from an observer or another thread to stop a running Update. Update clears it first.
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
