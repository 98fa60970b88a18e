// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEmbeddedEnvironments.h"

#include "EmbeddedRoom.h" // made of EmbeddedRoom.exr
#include "MaterialFormat.h"
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cstddef>
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
  { "room", "Poly Haven, as Blender's interior.exr, CC0 1.0; 512 x 256" },
  { "sky", "procedural: a clear sky with a sun; 256 x 128" },
  { "hall", "procedural: a dark hall with bright windows and lamps; 512 x 256" },
};

//------------------------------------------------------------------------------
// Returns whether it worked.
bool ReadRoom(vtkEnvironment* environment)
{
  const auto file = measuredbrdf::FileBytes::View("embedded room",
    std::string_view(reinterpret_cast<const char*>(EmbeddedRoom), sizeof(EmbeddedRoom)));
  int width = 0;
  int height = 0;
  std::vector<float> pixels = measuredbrdf::ReadExrImage(file, width, height);
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  for (int y = 0; y < height / 2; ++y) // files begin with the top row
  {
    float* low = &pixels[row * static_cast<std::size_t>(y)];
    std::swap_ranges(low, low + row, &pixels[row * static_cast<std::size_t>(height - 1 - y)]);
  }
  return environment->SetPixels(width, height, std::move(pixels));
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
