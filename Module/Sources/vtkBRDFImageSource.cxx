// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFImageSource.h"

#include "MaterialSource.h"
#include "ParallelFor.h"
#include "Setters.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <stdexcept>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBRDFImageSource);

//------------------------------------------------------------------------------
vtkBRDFImageSource::vtkBRDFImageSource() { this->SetNumberOfInputPorts(0); }

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDFImageSource, Resolution, int, 2, 4096);
measuredbrdfSetClampedMacro(vtkBRDFImageSource, PhiD, double, -360.0, 360.0);
measuredbrdfSetClampedMacro(vtkBRDFImageSource, PhiH, double, -360.0, 360.0);

//------------------------------------------------------------------------------
void vtkBRDFImageSource::SetBRDF(vtkBRDF* brdf) { measuredbrdfAssignMacro(BRDF, brdf); }

//------------------------------------------------------------------------------
vtkMTimeType vtkBRDFImageSource::GetMTime()
{
  return GetLatestTime(this->Superclass::GetMTime(), this->BRDF);
}

//------------------------------------------------------------------------------
int vtkBRDFImageSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  const int extent[6] = { 0, this->Resolution - 1, 0, this->Resolution - 1, 0, 0 };
  const double spacing = 90.0 / this->Resolution;
  const double spacings[3] = { spacing, spacing, 1.0 };
  const double origin[3] = { 0.5 * spacing, 0.5 * spacing, 0.0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), spacings, 3);
  info->Set(vtkDataObject::ORIGIN(), origin, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 3);
  return 1;
}

//------------------------------------------------------------------------------
void vtkBRDFImageSource::ExecuteDataWithInformation(vtkDataObject* output, vtkInformation* outInfo)
{
  RunGuarded(this, "RequestData",
    [&]()
    {
      vtkImageData* image = this->AllocateOutputData(output, outInfo);
      auto values = vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars());
      values->SetName("BRDF");
      values->FillValue(0.0f);
      if (!this->BRDF)
      {
        throw std::runtime_error("There is no BRDF; call SetBRDF first");
      }
      const int* extent = image->GetExtent();
      const vtkIdType width = extent[1] - extent[0] + 1;
      const double pixel = 90.0 / this->Resolution;
      this->BRDF->Prepare();
      measuredbrdf::ParallelForEach(
        values->GetNumberOfTuples(),
        [&](vtkIdType k)
        {
          const vtkIdType row = extent[2] + k / width;
          const double x = pixel * (static_cast<double>(extent[0] + k % width) + 0.5);
          const double thetaD = pixel * (static_cast<double>(row) + 0.5);
          const double thetaH = this->UseThetaHSquared ? x * x / 90.0 : x;
          double f[3];
          EvaluateHalfDifference(this->BRDF, thetaH, thetaD, this->PhiD, this->PhiH, f);
          values->SetTypedTuple(k, glm::value_ptr(glm::vec3(f[0], f[1], f[2])));
        },
        nullptr, 0);
    });
}

//------------------------------------------------------------------------------
void vtkBRDFImageSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BRDF: " << this->BRDF.Get() << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "PhiD: " << this->PhiD << "\n";
  os << indent << "UseThetaHSquared: " << this->UseThetaHSquared << "\n";
  os << indent << "PhiH: " << this->PhiH << "\n";
}
