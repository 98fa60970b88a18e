// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceModel.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tool
{
const char* GetFeatureName(Feature feature)
{
  static const char* const names[] = { "core", "specular", "coat", "sheen", "anisotropy" };
  return names[static_cast<int>(feature)];
}

//------------------------------------------------------------------------------
Directions::Directions(const glm::dvec3& light, const glm::dvec3& view)
  : Light(light)
  , View(view)
  , Half(glm::normalize(light + view))
  , NdL(light.z)
  , NdV(view.z)
  , NdH(std::min(this->Half.z, 1.0))
  , VdH(std::clamp(glm::dot(view, this->Half), 0.0, 1.0))
{
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(SurfaceModel);

//------------------------------------------------------------------------------
SurfaceModel::SurfaceModel() { this->SetModel(GetPbrModels().front()); }

//------------------------------------------------------------------------------
vtkSmartPointer<SurfaceModel> SurfaceModel::Make(const std::string& name)
{
  for (const auto* models : { &GetPbrModels(), &GetMaterialXModels() })
  {
    for (const ShadingModel& model : *models)
    {
      if (model.Name == name)
      {
        auto made = vtkSmartPointer<SurfaceModel>::New();
        made->SetModel(model);
        return made;
      }
    }
  }
  throw std::invalid_argument("no shading model is called " + name);
}

//------------------------------------------------------------------------------
void SurfaceModel::SetModel(const ShadingModel& model)
{
  this->Model = &model;
  this->Numbers.clear();
  this->Values.clear();
  for (const ModelParameter& parameter : model.Parameters)
  {
    for (std::size_t c = 0; c < parameter.Size; ++c)
    {
      this->Numbers.push_back({ &parameter, c });
      this->Values.push_back(parameter.Neutral);
    }
  }
}

//------------------------------------------------------------------------------
void SurfaceModel::SetValues(const std::vector<double>& values)
{
  if (values.size() != this->Values.size())
  {
    throw std::invalid_argument(
      this->GetTitle() + " has " + std::to_string(this->Values.size()) + " values");
  }
  this->Values = values;
  this->Modified();
}

//------------------------------------------------------------------------------
std::size_t SurfaceModel::Find(const std::string& name) const
{
  for (std::size_t k = 0; k < this->Numbers.size(); ++k)
  {
    if (this->Numbers[k].Parameter->Name == name)
    {
      return k;
    }
  }
  throw std::invalid_argument(this->GetTitle() + " has no parameter " + name);
}

//------------------------------------------------------------------------------
std::array<double, 3> SurfaceModel::GetColor(const std::string& name) const
{
  const std::size_t k = this->Find(name);
  return { this->Values[k], this->Values[k + 1], this->Values[k + 2] };
}

//------------------------------------------------------------------------------
bool SurfaceModel::HasFeature(Feature feature) const
{
  for (std::size_t k = 0; k < this->Numbers.size(); ++k)
  {
    const ModelParameter& parameter = *this->Numbers[k].Parameter;
    if (parameter.Part == feature && this->Values[k] != parameter.Neutral)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
glm::dvec3 SurfaceModel::EvaluateDirections(const Directions& directions) const
{
  glm::dvec3 f = this->Model->Shade(this->Values.data(), directions);
  for (int c = 0; c < 3; ++c)
  {
    f[c] = std::isfinite(f[c]) ? std::max(f[c], 0.0) : 0.0;
  }
  return f;
}

//------------------------------------------------------------------------------
void SurfaceModel::EvaluateAbove(const double i[3], const double o[3], double f[3])
{
  const glm::dvec3 value =
    this->Model->Shade(this->Values.data(), Directions({ i[0], i[1], i[2] }, { o[0], o[1], o[2] }));
  std::copy_n(&value.x, 3, f);
}
} // namespace tool
