// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkEmbeddedEnvironments.h"

#include "EmbeddedRoom.h" // made of EmbeddedRoom.exr
#include "vtkEnvironment.h"
#include "vtkObjectFactory.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

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
// The file is this library's own: RGB, scanlines, top row first.
bool ReadRoom(vtkEnvironment* environment)
{
  OIIO::Filesystem::IOMemReader bytes(EmbeddedRoom, sizeof(EmbeddedRoom));
  const auto input = OIIO::ImageInput::open("room.exr", nullptr, &bytes);
  if (!input || input->spec().nchannels != 3)
  {
    return false;
  }
  const int width = input->spec().width;
  const int height = input->spec().height;
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  std::vector<float> pixels(row * static_cast<std::size_t>(height));
  const auto stride = static_cast<OIIO::stride_t>(row * sizeof(float));
  return input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data() + row * (height - 1),
           OIIO::AutoStride, -stride) &&
         environment->SetPixels(width, height, std::move(pixels));
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
