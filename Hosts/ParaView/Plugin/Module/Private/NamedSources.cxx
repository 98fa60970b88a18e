// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The sources whose material is named.
#include "MaterialFiles.h"

#include "vtkObjectFactory.h"
#include "vtkPVBRDFImageSource.h"
#include "vtkPVBRDFLobeSource.h"
#include "vtkPVBRDFSliceSource.h"

using namespace measuredmaterials;

namespace
{
// Give the source its material. Returns whether there is one; an error event says why not.
template <typename Source>
bool SetNamedMaterial(Source* self, const std::string& name, const std::string& file)
{
  const Found<vtkBRDF> found = FindMaterial(name == "File" ? file : name, nullptr);
  if (!found.Object)
  {
    vtkErrorWithObjectMacro(self, << (found.Error.empty() ? "no material was named" : found.Error));
    return false;
  }
  self->SetBRDF(found.Object);
  return true;
}
}

#define measuredmaterialsNamedSourceMacro(Class)                                             \
  vtkStandardNewMacro(Class);                                                                \
  int Class::RequestInformation(vtkInformation* request, vtkInformationVector** inputVector, \
    vtkInformationVector* outputVector)                                                      \
  {                                                                                          \
    return SetNamedMaterial(this, this->Material, this->MaterialFile) &&                     \
           this->Superclass::RequestInformation(request, inputVector, outputVector);         \
  }                                                                                          \
  void Class::PrintSelf(ostream& os, vtkIndent indent)                                       \
  {                                                                                          \
    this->Superclass::PrintSelf(os, indent);                                                 \
    os << indent << "Material: " << this->Material << "\n";                                  \
    os << indent << "MaterialFile: " << this->MaterialFile << "\n";                          \
  }

measuredmaterialsNamedSourceMacro(vtkPVBRDFImageSource);
measuredmaterialsNamedSourceMacro(vtkPVBRDFLobeSource);
measuredmaterialsNamedSourceMacro(vtkPVBRDFSliceSource);
