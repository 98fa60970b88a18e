// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVBRDFSliceSource.h"

#include "NamedMaterial.h"

#include "vtkObjectFactory.h"

using namespace measuredmaterials;

vtkStandardNewMacro(vtkPVBRDFSliceSource);

//------------------------------------------------------------------------------
vtkPVBRDFSliceSource::vtkPVBRDFSliceSource() = default;

//------------------------------------------------------------------------------
void vtkPVBRDFSliceSource::SetMaterial(const char* name) { AssignName(this, this->Material, name); }

//------------------------------------------------------------------------------
void vtkPVBRDFSliceSource::SetMaterialFile(const char* path)
{
  AssignName(this, this->MaterialFile, path);
}

//------------------------------------------------------------------------------
int vtkPVBRDFSliceSource::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return SetNamedMaterial(this, this->Material, this->MaterialFile) &&
         this->Superclass::RequestInformation(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
void vtkPVBRDFSliceSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material: " << this->Material << "\n";
  os << indent << "MaterialFile: " << this->MaterialFile << "\n";
}
