// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVBRDFLobeSource.h"

#include "NamedMaterial.h"

#include "vtkObjectFactory.h"

using namespace measuredmaterials;

vtkStandardNewMacro(vtkPVBRDFLobeSource);

//------------------------------------------------------------------------------
vtkPVBRDFLobeSource::vtkPVBRDFLobeSource() = default;

//------------------------------------------------------------------------------
void vtkPVBRDFLobeSource::SetMaterial(const char* name) { AssignName(this, this->Material, name); }

//------------------------------------------------------------------------------
void vtkPVBRDFLobeSource::SetMaterialFile(const char* path)
{
  AssignName(this, this->MaterialFile, path);
}

//------------------------------------------------------------------------------
int vtkPVBRDFLobeSource::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return SetNamedMaterial(this, this->Material, this->MaterialFile) &&
         this->Superclass::RequestInformation(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
void vtkPVBRDFLobeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material: " << this->Material << "\n";
  os << indent << "MaterialFile: " << this->MaterialFile << "\n";
}
