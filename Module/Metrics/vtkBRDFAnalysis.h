// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFAnalysis
 * @brief   checks how physical a material is: albedo, energy, reciprocity, range, negative values
 *
 * Measures in the sense of DeYoung 1996 ("Properties of Tabulated Bidirectional Reflectance
 * Distribution Functions"), relative and without units unless said otherwise. Pairs (i,o) are drawn
 * with a fixed seed: o by its cosine, i half by the material's own sampling and half by its cosine
 * (so that lobes are sampled and no direction is missed), weighted for the measure c_i c_o di do.
 *
 * These figures are measured. vtkBRDF::IsReciprocal() only says whether a class is reciprocal by
 * construction.
 */

#ifndef vtkBRDFAnalysis_h
#define vtkBRDFAnalysis_h

#include "vtkBRDF.h"               // for BRDF
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for BRDF

#include <array>  // for albedos
#include <vector> // for table

class vtkTabulatedBRDF;

class VTKMEASUREDBRDF_EXPORT vtkBRDFAnalysis : public vtkObject
{
public:
  static vtkBRDFAnalysis* New();
  vtkTypeMacro(vtkBRDFAnalysis, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material.
   */
  void SetBRDF(vtkBRDF* brdf);
  vtkBRDF* GetBRDF() { return this->BRDF; }
  ///@}

  ///@{
  /**
   * Polar angles of the albedo table in degrees, each in [0,90); default 0 to 80 by 10, then 85.
   * Other angles are refused with an error event.
   */
  void SetAngles(int count, const double* degrees) VTK_SIZEHINT(degrees, count);
  int GetNumberOfAngles() { return static_cast<int>(this->Angles.size()); }
  double GetAngle(int index);
  ///@}

  ///@{
  /**
   * Number of direction pairs; default 20000, clamped to [100, 1e8].
   */
  virtual void SetNumberOfPairs(int numberOfPairs);
  vtkGetMacro(NumberOfPairs, int);
  ///@}

  /**
   * Compute everything below. Returns false with an error event without a material.
   */
  bool Update();

  ///@{
  /**
   * At GetAngle(index), RGB: the directional albedo a(o) = integral of f(i,o) c_i di (the radiance
   * under a white sky; vtkBRDF::GetDirectionalAlbedo) and the reflectance r(i) = integral of f(i,o)
   * c_o do (the share of light from i that is reflected). For a reciprocal material both are equal.
   * They are at azimuth 0; for anisotropic materials they are the mean over 8 azimuths.
   */
  void GetAlbedo(int index, double rgb[3]);
  void GetReflectance(int index, double rgb[3]);
  ///@}

  ///@{
  /**
   * Largest channel of any computed albedo or reflectance; and whether a reflectance is above 1 by
   * more than 0.5 %, several times the integral's error: the material then reflects more light than
   * it receives.
   */
  vtkGetMacro(LargestAlbedo, double);
  vtkGetMacro(GainsEnergy, bool);
  ///@}

  ///@{
  /**
   * Reciprocity errors over RGB, f' = f(o,i), integrals with both cosines as weights:
   * integral |f - f'| / integral f, and the RMS sqrt(integral (f - f')^2 / integral f^2).
   */
  vtkGetMacro(ReciprocityError, double);
  vtkGetMacro(ReciprocityRMSError, double);
  ///@}

  ///@{
  /**
   * Smallest and largest value of each channel over the pairs, in 1/sr.
   */
  vtkGetVector3Macro(Minimum, double);
  vtkGetVector3Macro(Maximum, double);
  ///@}

  /**
   * Share of negative values before Evaluate's clamp, integral of f's negative part / integral |f|
   * with both cosines as weights. For a table it is computed over the cells; for a basis
   * representation (which rings) as in vtkBasisBRDF::GetNegativeMass, over the hemisphere and
   * NumberOfPairs pairs. 0 for other representations, whose values cannot be negative, or (RGL)
   * only after interpolation.
   */
  vtkGetMacro(NegativeMass, double);

protected:
  vtkBRDFAnalysis();
  ~vtkBRDFAnalysis() override;

  vtkSmartPointer<vtkBRDF> BRDF;
  std::vector<double> Angles;
  std::vector<std::array<double, 3>> Albedos;
  std::vector<std::array<double, 3>> Reflectances;
  int NumberOfPairs = 20000;
  double LargestAlbedo = 0.0;
  bool GainsEnergy = false;
  double ReciprocityError = 0.0;
  double ReciprocityRMSError = 0.0;
  double Minimum[3] = { 0.0, 0.0, 0.0 };
  double Maximum[3] = { 0.0, 0.0, 0.0 };
  double NegativeMass = 0.0;

private:
  vtkBRDFAnalysis(const vtkBRDFAnalysis&) = delete;
  void operator=(const vtkBRDFAnalysis&) = delete;

  void UpdateAlbedos();
  void UpdatePairs();
  void UpdateNegativeMass();
  double GetTableNegativeMass(vtkTabulatedBRDF* table);
};

#endif
