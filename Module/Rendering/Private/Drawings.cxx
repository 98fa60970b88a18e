// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Drawings.h"

namespace measuredbrdf
{
Drawings& Drawings::Get()
{
  static Drawings& drawings = *new Drawings;
  return drawings;
}

void Drawings::Add(vtkObject* mapper, MaterialDrawing* drawing)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->ByMapper[mapper] = drawing;
}

// Unless a new mapper has the address of the old one.
void Drawings::Remove(vtkObject* mapper, MaterialDrawing* drawing)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = this->ByMapper.find(mapper);
  if (found != this->ByMapper.end() && found->second == drawing)
  {
    this->ByMapper.erase(found);
  }
}

MaterialDrawing* Drawings::Find(vtkObject* mapper)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = this->ByMapper.find(mapper);
  return found == this->ByMapper.end() ? nullptr : found->second;
}
} // namespace measuredbrdf
