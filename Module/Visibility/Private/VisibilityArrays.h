// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The point arrays that vtkSurfaceVisibilityFilter makes. Private to the module.
 */

#ifndef VisibilityArrays_h
#define VisibilityArrays_h

#include "BouncedLight.h"
#include "HiddenSky.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace measuredbrdf
{
/// Of one side of a surface.
struct SideNames
{
  std::string Sky;
  std::string Light;
  std::string Bounced;
};

struct SideArrays
{
  vtkSmartPointer<vtkUnsignedCharArray> Sky;
  vtkSmartPointer<vtkUnsignedCharArray> Light;
  vtkSmartPointer<vtkUnsignedCharArray> Bounced; // null: not asked for
  std::string BouncedName;
  std::map<vtkIdType, vtkIdType> Sources; // of points that have what another point sees

  SideArrays() = default;
  SideArrays(vtkIdType points, const SideNames& names)
    : Sky(Make(names.Sky, points, HiddenSky::SectorBytes))
    , Light(Make(names.Light, points, HiddenSky::TransferBytes))
    , BouncedName(names.Bounced)
  {
  }

  void Set(vtkIdType point, const HiddenSky::Code& code) const
  {
    std::copy_n(
      code.begin(), HiddenSky::SectorBytes, this->Sky->GetPointer(point * HiddenSky::SectorBytes));
    std::copy_n(code.begin() + HiddenSky::SectorBytes, HiddenSky::TransferBytes,
      this->Light->GetPointer(point * HiddenSky::TransferBytes));
  }

  HiddenSky::Code Get(vtkIdType point) const
  {
    HiddenSky::Code code;
    std::copy_n(
      this->Sky->GetPointer(point * HiddenSky::SectorBytes), HiddenSky::SectorBytes, code.begin());
    std::copy_n(this->Light->GetPointer(point * HiddenSky::TransferBytes), HiddenSky::TransferBytes,
      code.begin() + HiddenSky::SectorBytes);
    return code;
  }

  void AddBounced()
  {
    this->Bounced = Make(this->BouncedName, this->Sky->GetNumberOfTuples(), BouncedLight::Bytes);
  }

  void SetBounced(vtkIdType point, const BouncedLight::Code& code) const
  {
    std::copy(code.begin(), code.end(), this->Bounced->GetPointer(point * BouncedLight::Bytes));
  }

private:
  static vtkSmartPointer<vtkUnsignedCharArray> Make(
    const std::string& name, vtkIdType points, int components)
  {
    auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(points);
    return array;
  }
};

struct SurfaceArrays
{
  std::vector<SideArrays> Sides;
  std::string Key; // of the points, normals and cells
};
} // namespace measuredbrdf

#endif
