// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMissingNormalsFilter.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"

vtkStandardNewMacro(vtkMissingNormalsFilter);

//------------------------------------------------------------------------------
int vtkMissingNormalsFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const bool hasSurface = input->GetNumberOfPolys() > 0 || input->GetNumberOfStrips() > 0;
  if (!this->Enabled || !hasSurface || input->GetPointData()->GetNormals())
  {
    output->ShallowCopy(input);
    return 1;
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(input);
  normals->SetFeatureAngle(this->FeatureAngle);
  normals->ConsistencyOff(); // what is one surface and what is its outside is the data's to say
  normals->Update();
  output->ShallowCopy(normals->GetOutput());
  return 1;
}

//------------------------------------------------------------------------------
void vtkMissingNormalsFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Enabled: " << this->Enabled << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
}
