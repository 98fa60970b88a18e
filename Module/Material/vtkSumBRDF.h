// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSumBRDF
 * @brief   sum of BRDFs, e.g. a Lambert part and a specular lobe
 *
 * Sampling picks a term with probability proportional to its normal-incidence albedo.
 */

#ifndef vtkSumBRDF_h
#define vtkSumBRDF_h

#include "vtkBRDF.h"

#include <vector> // for terms

class VTKMEASUREDBRDF_EXPORT vtkSumBRDF : public vtkBRDF
{
public:
  static vtkSumBRDF* New();
  vtkTypeMacro(vtkSumBRDF, vtkBRDF);

  /// Most terms of a sum.
  static constexpr int MaximumNumberOfTerms = 64;

  ///@{
  /**
   * The terms, shared (not copied). Adding null, this sum itself, a sum that holds it or more than
   * MaximumNumberOfTerms is an error.
   */
  void AddTerm(vtkBRDF* term);
  void RemoveAllTerms();
  int GetNumberOfTerms();
  vtkBRDF* GetTerm(int index);
  ///@}

  vtkMTimeType GetMTime() override;
  void GetDirectionalAlbedo(const double o[3], double albedo[3]) override;
  bool IsIsotropic() override;
  bool IsReciprocal() override;
  void Prepare() override;
  bool IsRenderable() override;
  vtkBRDF* GetRenderable() override;
  VTK_NEWINSTANCE vtkBRDF* NewQuickRenderable() override;
  void GetShaderInputs(vtkBRDFShaderInputs& inputs) override;
  std::string GetModelName() override { return "Sum"; }
  VTK_WRAPEXCLUDE void ExchangeData(vtkBRDFExchange& exchange) override;

protected:
  vtkSumBRDF() = default;
  ~vtkSumBRDF() override = default;

  vtkBRDF* NewCopy() override;
  void EvaluateAbove(const double i[3], const double o[3], double f[3]) override;
  void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]) override;
  bool SampleAbove(const double o[3], double u1, double u2, double i[3]) override;
  double PdfAbove(const double i[3], const double o[3]) override;

  std::vector<vtkSmartPointer<vtkBRDF>> Terms;
  std::vector<double> Weights; // probability of each term, from Prepare
  vtkTimeStamp PrepareTime;
  vtkSmartPointer<vtkSumBRDF> Renderable;
  vtkTimeStamp RenderableTime;

private:
  vtkSumBRDF(const vtkSumBRDF&) = delete;
  void operator=(const vtkSumBRDF&) = delete;
};

#endif
