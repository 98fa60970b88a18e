// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A list of photographs, and a folder with a file of that name.
#include "FuzzTarget.h"

#include "vtkNew.h"
#include "vtkPhotographSet.h"
#include "vtkPhotographSetReader.h"

#include <algorithm>

int FuzzPhotographList(const std::uint8_t* data, std::size_t size)
{
  static const fuzz::ScratchFolder folder;
  static const fuzz::ScratchFolder named;
  const fuzz::Silence silence;
  std::string name(fuzz::ToView(data, std::min<std::size_t>(size, 200)));
  std::replace(name.begin(), name.end(), '/', '_');
  std::replace(name.begin(), name.end(), '\0', '_');
  folder.Write("a.png", "no image");
  const bool isName = !name.empty() && name != "." && name != "..";
  const std::string file = isName ? named.Write(name, "x") : "";
  for (const std::string& path :
    { folder.Write("list.json", fuzz::ToView(data, size)), named.GetPath().string() })
  {
    vtkNew<vtkPhotographSetReader> reader;
    reader->SetFileName(path);
    fuzz::Require(reader->Read() == (reader->GetPhotographs() != nullptr));
    vtkPhotographSet* set = reader->GetPhotographs();
    for (int k = 0; set && k < set->GetNumberOfPhotographs(); ++k)
    {
      double light[3];
      double view[3];
      set->GetLight(k, light);
      set->GetView(k, view);
      fuzz::Require(light[2] > 0.0 && view[2] > 0.0 && set->GetExposure(k) > 0.0);
    }
  }
  std::error_code error;
  std::filesystem::remove(file, error);
  return 0;
}
