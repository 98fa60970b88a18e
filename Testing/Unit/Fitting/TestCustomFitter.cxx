// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A program's own model is fitted with the public headers alone.
#include "HalfVector.h"

#include "vtkBRDFFitter.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSumBRDF.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{
using measuredbrdf::Pi;

// The albedo whose f' = albedo / pi is best in the sense of SQUARED: a weighted mean of f.
class LambertFitter : public vtkBRDFFitter
{
public:
  static LambertFitter* New();
  vtkTypeMacro(LambertFitter, vtkBRDFFitter);

  std::string GetModelName() override { return "Lambert"; }

  double SumOfWeights = 0.0;
  double MeanSquare = 0.0; // with GetLossValue

protected:
  Result FitTo(const std::vector<Sample>& samples) override
  {
    double albedo[3] = { 0.0, 0.0, 0.0 };
    double total = 0.0;
    this->SumOfWeights = 0.0;
    for (const Sample& sample : samples)
    {
      this->SumOfWeights += sample.Weight;
      total += sample.Weight * sample.I[2];
      for (int c = 0; c < 3; ++c)
      {
        albedo[c] += Pi * sample.Weight * sample.I[2] * sample.F[c];
      }
    }
    this->MeanSquare = 0.0;
    for (double& value : albedo)
    {
      value /= total;
    }
    for (const Sample& sample : samples)
    {
      for (int c = 0; c < 3; ++c)
      {
        const double difference = this->GetLossValue(sample.F[c], sample.I[2]) -
                                  this->GetLossValue(albedo[c] / Pi, sample.I[2]);
        this->MeanSquare += sample.Weight * difference * difference / 3.0;
      }
    }
    vtkNew<vtkLambertBRDF> lambert;
    lambert->SetAlbedo(albedo);
    return { lambert.Get(), { this->MeanSquare }, this->UpdateProgress(0.5), "a report" };
  }
};
vtkStandardNewMacro(LambertFitter);

//------------------------------------------------------------------------------
// Over fresh pairs the residual is about the fit's own.
TEST(CustomFitter, IsMeasuredAsTheOthersAre)
{
  vtkNew<vtkLambertBRDF> diffuse;
  diffuse->SetAlbedo(0.3, 0.5, 0.2);
  vtkNew<vtkBlinnPhongBRDF> gloss;
  gloss->SetExponent(5.0);
  gloss->SetSpecular(0.1, 0.1, 0.1);
  vtkNew<vtkSumBRDF> input;
  input->AddTerm(diffuse);
  input->AddTerm(gloss);
  input->SetName("chalk");
  vtkNew<LambertFitter> fitter;
  fitter->SetLossToSquared();
  fitter->SetInput(input);
  ASSERT_TRUE(fitter->Fit());
  EXPECT_NEAR(fitter->SumOfWeights, 1.0, 1e-12);
  EXPECT_TRUE(fitter->GetConverged());
  EXPECT_EQ(fitter->GetReport(), "a report");
  EXPECT_EQ(fitter->GetOutput()->GetName(), "chalk");
  ASSERT_EQ(fitter->GetResidualHistory().size(), 1u);
  EXPECT_DOUBLE_EQ(fitter->GetResidualHistory()[0], std::sqrt(fitter->MeanSquare));
  EXPECT_GT(fitter->GetResidual(), 0.0);
  EXPECT_NEAR(fitter->GetResidual(), fitter->GetResidualHistory()[0], 1e-2 * fitter->GetResidual());
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(fitter->GetOutputAlbedo()[c], fitter->GetInputAlbedo()[c], 0.02);
  }
}
}
