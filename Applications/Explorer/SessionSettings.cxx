// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// The session's settings: what needs no file.
#include "DirectionalLight.h"
#include "ModelMaterials.h"
#include "Session.h"

#include <algorithm>
#include <cmath>

namespace
{
//------------------------------------------------------------------------------
double WrapDegrees(double degrees)
{
  const double turned = std::fmod(degrees + 180.0, 360.0);
  return (turned < 0.0 ? turned + 360.0 : turned) - 180.0;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
void Session::SetRotation(double degrees)
{
  const double wrapped = WrapDegrees(degrees);
  if (!std::isfinite(wrapped) || wrapped == this->Current.Rotation)
  {
    return;
  }
  this->Current.Rotation = wrapped;
  if (this->Environment)
  {
    this->Environment->SetRotationY(wrapped);
  }
  emit this->rotationChanged();
}

//------------------------------------------------------------------------------
void Session::SetLight(const LightState& light)
{
  if (!std::isfinite(light.Theta + light.Phi + light.Irradiance))
  {
    return;
  }
  this->Current.Light.Theta = std::clamp(light.Theta, 0.0, 180.0);
  this->Current.Light.Phi = WrapDegrees(light.Phi);
  this->Current.Light.Irradiance = std::clamp(light.Irradiance, 0.0, LargestIrradiance);
  emit this->lightChanged();
}

//------------------------------------------------------------------------------
void Session::SetModelValues(
  const std::string& key, const std::string& parameter, const std::vector<double>& values)
{
  const ParametricModel* model = FindModel(GetModelFile({ key, {}, {}, {} }));
  for (const ModelParameter& one : model ? model->Parameters : std::vector<ModelParameter>())
  {
    if (one.Key == parameter && values.size() == one.Default.size())
    {
      std::vector<double>& set = this->Current.Models[key][parameter];
      set = values;
      for (double& value : set)
      {
        value = std::isfinite(value) ? std::clamp(value, one.Least, one.Largest) : one.Default[0];
      }
    }
  }
  emit this->modelsChanged();
  this->Remake.start();
}

//------------------------------------------------------------------------------
void Session::SetEdits(const std::string& file, const SampleEdits& edits)
{
  if (edits.empty())
  {
    this->Current.Edits.erase(file);
  }
  else
  {
    this->Current.Edits[file] = edits;
  }
  emit this->editsChanged();
  this->Remake.start();
}

//------------------------------------------------------------------------------
void Session::SetTolerance(double tolerance)
{
  const double value = std::clamp(tolerance, 1e-3, 1.0);
  if (value != this->Current.Tolerance)
  {
    this->Current.Tolerance = value;
    emit this->toleranceChanged();
  }
}

//------------------------------------------------------------------------------
void Session::SetMethod(int side, const std::string& key)
{
  std::string& method = this->Current.Methods[side == 0 ? 0 : 1];
  if (method != key && explorer::GetMethodName(key) != key)
  {
    method = key;
    emit this->methodsChanged();
  }
}

//------------------------------------------------------------------------------
void Session::SetLights(int count)
{
  int power = 1;
  while (power * 2 <= std::clamp(count, 1, 4096))
  {
    power *= 2;
  }
  if (power != this->Current.Lights)
  {
    this->Current.Lights = power;
    emit this->methodsChanged();
  }
}

//------------------------------------------------------------------------------
void Session::SetShown(Shown shown)
{
  this->Current.Show = shown;
  emit this->pictureChanged();
}

//------------------------------------------------------------------------------
void Session::SetSplit(double share)
{
  this->Current.Split = std::clamp(share, 0.0, 1.0);
  emit this->pictureChanged();
}

//------------------------------------------------------------------------------
void Session::SetExposure(double stops)
{
  this->Current.Exposure = std::clamp(stops, -MostStops, MostStops);
  emit this->pictureChanged();
}

//------------------------------------------------------------------------------
void Session::SetBackdrop(bool shown)
{
  this->Current.Backdrop = shown;
  emit this->pictureChanged();
}

//------------------------------------------------------------------------------
void Session::SetReferenceHeight(int pixels)
{
  this->Current.ReferenceHeight = std::clamp(pixels, 32, 2048);
  emit this->referenceHeightChanged();
}

//------------------------------------------------------------------------------
void Session::SetCamera(const CameraState& camera)
{
  this->Current.Camera = camera;
  emit this->cameraChanged();
}

//------------------------------------------------------------------------------
void Session::SetLobe(double thetaI, double phiI, bool logarithmic)
{
  this->Current.LobeThetaI = std::clamp(thetaI, 0.0, 89.0);
  this->Current.LobePhiI = WrapDegrees(phiI - 180.0) + 180.0; // [0, 360)
  this->Current.LobeLogarithmic = logarithmic;
  emit this->lobeChanged();
}

//------------------------------------------------------------------------------
void Session::SetSlices(double thetaH, double thetaD, double phiD, bool logarithmic)
{
  this->Current.SliceThetaH = std::clamp(thetaH, 0.0, 90.0);
  this->Current.SliceThetaD = std::clamp(thetaD, 0.0, 90.0);
  this->Current.SlicePhiD = std::clamp(phiD, 0.0, 180.0);
  this->Current.SliceLogarithmic = logarithmic;
  emit this->slicesChanged();
}

//------------------------------------------------------------------------------
void Session::SetSlicePolar(bool polar)
{
  this->Current.SlicePolar = polar;
  emit this->slicesChanged();
}
} // namespace explorer
