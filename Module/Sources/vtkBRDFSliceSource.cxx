// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFSliceSource.h"

#include "MaterialSource.h"
#include "NumberText.h"
#include "ParallelFor.h"
#include "Setters.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <stdexcept>
#include <string>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBRDFSliceSource);

namespace
{
constexpr double LargestNumberOfRows = 1e7;

std::string FindProblem(const double range[2], double low, double high)
{
  if (range[0] >= low && range[0] <= high && range[1] >= low && range[1] <= high) // NaN is not
  {
    return "";
  }
  TextStream text;
  text << "found " << range[0] << ", " << range[1] << ", expected angles from " << low << " to "
       << high << " degrees";
  return text.str();
}

std::string FindThetaProblem(const double range[2]) { return FindProblem(range, 0.0, 90.0); }
std::string FindPhiProblem(const double range[2]) { return FindProblem(range, -360.0, 360.0); }

double GetAngle(const double range[2], int number, vtkIdType index, bool squared)
{
  const double part = number > 1 ? static_cast<double>(index) / (number - 1) : 0.0;
  return range[0] + (squared ? part * part : part) * (range[1] - range[0]);
}
}

//------------------------------------------------------------------------------
vtkBRDFSliceSource::vtkBRDFSliceSource() { this->SetNumberOfInputPorts(0); }

//------------------------------------------------------------------------------
measuredbrdfSetChecked2Macro(vtkBRDFSliceSource, ThetaHRange, FindThetaProblem);
measuredbrdfSetChecked2Macro(vtkBRDFSliceSource, ThetaDRange, FindThetaProblem);
measuredbrdfSetChecked2Macro(vtkBRDFSliceSource, PhiDRange, FindPhiProblem);
measuredbrdfSetClampedMacro(vtkBRDFSliceSource, NumberOfThetaH, int, 1, 100000);
measuredbrdfSetClampedMacro(vtkBRDFSliceSource, NumberOfThetaD, int, 1, 100000);
measuredbrdfSetClampedMacro(vtkBRDFSliceSource, NumberOfPhiD, int, 1, 100000);
measuredbrdfSetClampedMacro(vtkBRDFSliceSource, PhiH, double, -360.0, 360.0);

//------------------------------------------------------------------------------
void vtkBRDFSliceSource::SetBRDF(vtkBRDF* brdf) { measuredbrdfAssignMacro(BRDF, brdf); }

//------------------------------------------------------------------------------
vtkMTimeType vtkBRDFSliceSource::GetMTime()
{
  return GetLatestTime(this->Superclass::GetMTime(), this->BRDF);
}

//------------------------------------------------------------------------------
int vtkBRDFSliceSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return RunGuarded(this, "RequestData", [&]() { this->Fill(vtkTable::GetData(outputVector)); });
}

//------------------------------------------------------------------------------
void vtkBRDFSliceSource::Fill(vtkTable* output)
{
  const double rows =
    static_cast<double>(this->NumberOfThetaH) * this->NumberOfThetaD * this->NumberOfPhiD;
  if (!this->BRDF)
  {
    throw std::runtime_error("There is no BRDF; call SetBRDF first");
  }
  if (rows > LargestNumberOfRows)
  {
    TextStream text;
    text << this->NumberOfThetaH << " x " << this->NumberOfThetaD << " x " << this->NumberOfPhiD
         << " samples are more than " << LargestNumberOfRows << " rows";
    throw std::runtime_error(text.str());
  }
  const vtkIdType count = static_cast<vtkIdType>(rows);
  vtkSmartPointer<vtkDoubleArray> columns[7];
  const char* const names[7] = { "theta_h", "theta_d", "phi_d", "red", "green", "blue",
    "luminance" };
  for (int c = 0; c < 7; ++c)
  {
    columns[c] = NewArray<vtkDoubleArray>(names[c], 1, count);
  }
  const auto mask = NewArray<vtkUnsignedCharArray>("vtkValidPointMask", 1, count);

  this->BRDF->Prepare();
  measuredbrdf::ParallelForEach(
    count,
    [&](vtkIdType row)
    {
      const vtkIdType outer = row / this->NumberOfPhiD;
      const double thetaH = GetAngle(this->ThetaHRange, this->NumberOfThetaH,
        outer / this->NumberOfThetaD, this->UseThetaHSquared);
      const double thetaD =
        GetAngle(this->ThetaDRange, this->NumberOfThetaD, outer % this->NumberOfThetaD, false);
      const double phiD =
        GetAngle(this->PhiDRange, this->NumberOfPhiD, row % this->NumberOfPhiD, false);
      double f[3];
      mask->SetValue(
        row, EvaluateHalfDifference(this->BRDF, thetaH, thetaD, phiD, this->PhiH, f) ? 1 : 0);
      const double values[7] = { thetaH, thetaD, phiD, f[0], f[1], f[2], GetLuminance(f) };
      for (int c = 0; c < 7; ++c)
      {
        columns[c]->SetValue(row, values[c]);
      }
    },
    nullptr, 0);

  for (const auto& column : columns)
  {
    output->AddColumn(column);
  }
  output->AddColumn(mask);
}

//------------------------------------------------------------------------------
void vtkBRDFSliceSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "ThetaHRange: " << this->ThetaHRange[0] << ", " << this->ThetaHRange[1] << "\n";
  os << indent << "ThetaDRange: " << this->ThetaDRange[0] << ", " << this->ThetaDRange[1] << "\n";
  os << indent << "PhiDRange: " << this->PhiDRange[0] << ", " << this->PhiDRange[1] << "\n";
  os << indent << "NumberOfThetaH: " << this->NumberOfThetaH << "\n";
  os << indent << "NumberOfThetaD: " << this->NumberOfThetaD << "\n";
  os << indent << "NumberOfPhiD: " << this->NumberOfPhiD << "\n";
  os << indent << "UseThetaHSquared: " << this->UseThetaHSquared << "\n";
  os << indent << "PhiH: " << this->PhiH << "\n";
}
