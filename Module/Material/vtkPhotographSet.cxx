// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographSet.h"

#include "HalfVector.h"
#include "NumberText.h"
#include "Printable.h"
#include "Refusal.h"
#include "Setters.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

vtkStandardNewMacro(vtkPhotographSet);

//------------------------------------------------------------------------------
vtkPhotographSet::vtkPhotographSet() = default;
vtkPhotographSet::~vtkPhotographSet() = default;

//------------------------------------------------------------------------------
std::string vtkPhotographSet::FindDirectionProblem(
  const double direction[3], const std::string& what)
{
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  measuredbrdf::TextStream found;
  found << what << ": found (" << direction[0] << ", " << direction[1] << ", " << direction[2]
        << "), expected ";
  if (!std::isfinite(length) || !(length > 0.0))
  {
    return found.str() + "a finite direction";
  }
  return direction[2] / length > 0.0 ? std::string()
                                     : found.str() + "a direction above the horizon, z > 0";
}

//------------------------------------------------------------------------------
std::string vtkPhotographSet::FindExposureProblem(double exposure)
{
  if (std::isfinite(exposure) && exposure > 0.0)
  {
    return std::string();
  }
  measuredbrdf::TextStream found;
  found << "exposure: found " << exposure << ", expected a finite number > 0";
  return found.str();
}

//------------------------------------------------------------------------------
int vtkPhotographSet::Insert(Photograph photograph)
{
  const std::string problem = measuredbrdf::FindProblemOf(
    [&]()
    {
      for (const std::string& each :
        { FindDirectionProblem(photograph.Light, "light"),
          FindDirectionProblem(photograph.View, "view"), FindExposureProblem(photograph.Exposure) })
      {
        measuredbrdf::Require(each.empty(), each);
      }
      const int most = MaximumNumberOfPhotographs;
      measuredbrdf::Require(this->GetNumberOfPhotographs() < most,
        "there are " + std::to_string(most) + " photographs, the most");
    });
  if (!problem.empty())
  {
    vtkErrorMacro("AddPhotograph: " << measuredbrdf::ToPrintable(photograph.Name)
                                    << (photograph.Name.empty() ? "" : ": ") << problem << ".");
    return -1;
  }
  for (double* direction : { photograph.Light, photograph.View })
  {
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    std::for_each(direction, direction + 3, [length](double& value) { value /= length; });
  }
  this->Photographs.push_back(std::move(photograph));
  this->Modified();
  return this->GetNumberOfPhotographs() - 1;
}

//------------------------------------------------------------------------------
int vtkPhotographSet::AddPhotograph(vtkImageData* picture, const double light[3],
  const double view[3], double exposure, const std::string& name)
{
  if (!picture)
  {
    vtkErrorMacro("AddPhotograph: no picture.");
    return -1;
  }
  Photograph photograph;
  photograph.Picture = picture;
  std::copy_n(light, 3, photograph.Light);
  std::copy_n(view, 3, photograph.View);
  photograph.Exposure = exposure;
  photograph.Name = name;
  return this->Insert(std::move(photograph));
}

//------------------------------------------------------------------------------
void vtkPhotographSet::RemoveAllPhotographs()
{
  this->Photographs.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
const vtkPhotographSet::Photograph& vtkPhotographSet::Get(int index) const
{
  static const Photograph none = { nullptr, {}, {}, 0.0, "" };
  return index >= 0 && static_cast<std::size_t>(index) < this->Photographs.size()
           ? this->Photographs[static_cast<std::size_t>(index)]
           : none;
}

//------------------------------------------------------------------------------
void vtkPhotographSet::GetLight(int index, double light[3])
{
  std::copy_n(this->Get(index).Light, 3, light);
}

//------------------------------------------------------------------------------
void vtkPhotographSet::GetView(int index, double view[3])
{
  std::copy_n(this->Get(index).View, 3, view);
}

//------------------------------------------------------------------------------
double vtkPhotographSet::GetExposure(int index) { return this->Get(index).Exposure; }
std::string vtkPhotographSet::GetName(int index) { return this->Get(index).Name; }

//------------------------------------------------------------------------------
double vtkPhotographSet::GetScale(int index)
{
  const Photograph& photograph = this->Get(index);
  return photograph.Exposure * this->Irradiance * photograph.Light[2];
}

//------------------------------------------------------------------------------
vtkImageData* vtkPhotographSet::NewPicture(int index)
{
  vtkImageData* picture = this->Get(index).Picture;
  if (!picture)
  {
    vtkErrorMacro("NewPicture: there is no photograph " << index << ".");
    return nullptr;
  }
  picture->Register(nullptr);
  return picture;
}

//------------------------------------------------------------------------------
void vtkPhotographSet::SetIrradiance(double irradiance)
{
  if (!std::isfinite(irradiance) || !(irradiance > 0.0))
  {
    measuredbrdfRefuseMacro(Irradiance, irradiance, "a finite number > 0");
    return;
  }
  measuredbrdfAssignMacro(Irradiance, irradiance);
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkPhotographSet, Transfer, int, AUTOMATIC, POWER);
measuredbrdfSetClampedMacro(vtkPhotographSet, Gamma, double, 0.1, 10.0);
measuredbrdfSetClampedMacro(vtkPhotographSet, SaturationLevel, double,
  std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max());
measuredbrdfSetClampedMacro(vtkPhotographSet, BlackLevel, double,
  std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max());

//------------------------------------------------------------------------------
void vtkPhotographSet::GetDirection(double theta, double phi, double direction[3])
{
  const double degree = measuredbrdf::Pi / 180.0;
  direction[0] = std::sin(theta * degree) * std::cos(phi * degree);
  direction[1] = std::sin(theta * degree) * std::sin(phi * degree);
  direction[2] = std::cos(theta * degree);
}

//------------------------------------------------------------------------------
void vtkPhotographSet::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPhotographs: " << this->Photographs.size() << "\n";
  os << indent << "Irradiance: " << this->Irradiance << "\n";
  os << indent << "Transfer: " << this->Transfer << "\n";
  os << indent << "Gamma: " << this->Gamma << "\n";
  os << indent << "SaturationLevel: " << this->SaturationLevel << "\n";
  os << indent << "BlackLevel: " << this->BlackLevel << "\n";
  os << indent << "LevelsForFloats: " << (this->LevelsForFloats ? "On" : "Off") << "\n";
}
