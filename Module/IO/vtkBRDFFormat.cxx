// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFFormat.h"

#include "Printable.h"

namespace
{
constexpr std::size_t LongestNote = 1000;
constexpr std::size_t MostNotes = 20000; // what a file has to say ends somewhere
}

//------------------------------------------------------------------------------
void vtkBRDFFormat::Content::AddNote(const std::string& note)
{
  if (this->Notes.size() < MostNotes)
  {
    this->Notes += (this->Notes.empty() ? "" : "\n") + measuredbrdf::ToPrintable(note, LongestNote);
  }
}

//------------------------------------------------------------------------------
std::vector<std::string> vtkBRDFFormat::GetMaterialNames(const File& vtkNotUsed(file))
{
  return {};
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> vtkBRDFFormat::Convert(vtkBRDF* brdf, std::string& vtkNotUsed(error))
{
  return brdf;
}

//------------------------------------------------------------------------------
bool vtkBRDFFormat::Write(vtkBRDF* vtkNotUsed(brdf), const std::string& path,
  bool vtkNotUsed(halfFloats), std::string& error)
{
  error = path + ": " + this->GetName() + " is read only";
  return false;
}

//------------------------------------------------------------------------------
void vtkBRDFFormat::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Name: " << this->GetName() << "\n";
  os << indent << "Description: " << this->GetDescription() << "\n";
  os << indent << "Extensions:";
  for (const std::string& extension : this->GetExtensions())
  {
    os << " " << extension;
  }
  os << "\n" << indent << "CanWrite: " << (this->CanWrite() ? "yes" : "no") << "\n";
}
