// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVBRDFImageSource.h"

#include "NamedMaterial.h"

#include "vtkObjectFactory.h"

using namespace measuredmaterials;

vtkStandardNewMacro(vtkPVBRDFImageSource);

//------------------------------------------------------------------------------
vtkPVBRDFImageSource::vtkPVBRDFImageSource() = default;

//------------------------------------------------------------------------------
void vtkPVBRDFImageSource::SetMaterial(const char* name) { AssignName(this, this->Material, name); }

//------------------------------------------------------------------------------
void vtkPVBRDFImageSource::SetMaterialFile(const char* path)
{
  AssignName(this, this->MaterialFile, path);
}

//------------------------------------------------------------------------------
int vtkPVBRDFImageSource::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return SetNamedMaterial(this, this->Material, this->MaterialFile) &&
         this->Superclass::RequestInformation(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
void vtkPVBRDFImageSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material: " << this->Material << "\n";
  os << indent << "MaterialFile: " << this->MaterialFile << "\n";
}
