// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEmbeddedEnvironments.h"

#include "AbsentLibraries.h"
#include "vtkEnvironment.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#if MEASUREDBRDF_WITH_OPENEXR
#include "EmbeddedRoom.h" // made of EmbeddedRoom.exr
#include "ExrImage.h"
#include "FileBytes.h"
#endif

#include <string_view>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkEmbeddedEnvironments);

namespace
{
struct Embedded
{
  const char* Name;
  const char* Source;
};

const std::vector<Embedded> Environments = {
#if MEASUREDBRDF_WITH_OPENEXR
  { "room", "Poly Haven, as Blender's interior.exr, CC0 1.0; 512 x 256" },
#endif
  { "sky", "procedural: a clear sky with a sun; 256 x 128" },
  { "hall", "procedural: a dark hall with bright windows and lamps; 512 x 256" },
};

//------------------------------------------------------------------------------
// Returns whether it worked.
bool ReadRoom(vtkEnvironment* environment)
{
#if MEASUREDBRDF_WITH_OPENEXR
  const auto file = measuredbrdf::FileBytes::View("embedded room",
    std::string_view(reinterpret_cast<const char*>(EmbeddedRoom), sizeof(EmbeddedRoom)));
  measuredbrdf::ExrImage image = measuredbrdf::ReadExrImage(file);
  return environment->SetPixels(image.Width, image.Height, std::move(image.Pixels));
#else
  static_cast<void>(environment);
  const vtkNew<vtkEmbeddedEnvironments> self; // an object to complain
  vtkErrorWithObjectMacro(
    self.Get(), "NewEnvironment: " << measuredbrdf::NoOpenEXR
                                   << "the embedded environment 'room' cannot be read.");
  return false;
#endif
}
}

//------------------------------------------------------------------------------
int vtkEmbeddedEnvironments::GetNumberOfEnvironments()
{
  return static_cast<int>(Environments.size());
}

//------------------------------------------------------------------------------
std::string vtkEmbeddedEnvironments::GetName(int index)
{
  return index >= 0 && index < GetNumberOfEnvironments() ? Environments[index].Name : "";
}

//------------------------------------------------------------------------------
std::string vtkEmbeddedEnvironments::GetSource(int index)
{
  return index >= 0 && index < GetNumberOfEnvironments() ? Environments[index].Source : "";
}

//------------------------------------------------------------------------------
vtkEnvironment* vtkEmbeddedEnvironments::NewEnvironment(const std::string& name)
{
  vtkEnvironment* environment = vtkEnvironment::New();
  bool known = true;
  if (name == "sky")
  {
    environment->SetToProceduralSky();
  }
  else if (name == "hall")
  {
    environment->SetToProceduralHall();
  }
  else
  {
    known = name == "room" && ReadRoom(environment);
  }
  if (!known)
  {
    environment->Delete();
    return nullptr;
  }
  environment->SetName("built-in " + name);
  return environment;
}

//------------------------------------------------------------------------------
void vtkEmbeddedEnvironments::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfEnvironments: " << GetNumberOfEnvironments() << "\n";
}
