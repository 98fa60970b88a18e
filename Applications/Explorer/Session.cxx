// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Session.h"

#include "FileKinds.h"
#include "Files.h"
#include "Meshes.h"
#include "Tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
//------------------------------------------------------------------------------
void AddOnce(std::vector<std::string>& list, const std::string& file)
{
  if (std::find(list.begin(), list.end(), file) == list.end())
  {
    list.push_back(file);
  }
}

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
vtkSmartPointer<vtkPolyData> LoadMeshByName(const std::string& file)
{
  return file == "sphere" ? tool::MakeSphere() : tool::LoadMesh(file);
}

//------------------------------------------------------------------------------
Session::Session(Jobs* jobs, QObject* parent)
  : QObject(parent)
  , Background(jobs)
{
  connect(jobs, &Jobs::noted, this, [this](const QString& text) { this->Say(text, false); });
}

//------------------------------------------------------------------------------
Session::~Session() = default;

//------------------------------------------------------------------------------
void Session::Say(const QString& text, bool isError) { emit this->messaged(text, isError); }

//------------------------------------------------------------------------------
// What is on the screen stays until the new state's objects have been read.
void Session::Replace(const State& state, bool withCamera)
{
  const State before = this->Current;
  this->Current = state;
  this->Current.Material = before.Material;
  this->Current.Environment = before.Environment;
  this->Current.Mesh = before.Mesh;
  for (const std::string& file : state.Compared)
  {
    if (!IsEmbeddedMaterial(file))
    {
      AddOnce(this->Current.MaterialFiles, file); // so that it can be taken out
    }
  }
  emit this->listsChanged();
  this->SetMaterial(state.Material);
  this->SetCompared(state.Compared);
  this->SetEnvironment(state.Environment);
  if (this->Mesh && this->MeshFile == state.Mesh)
  {
    emit this->cameraReplaced();
  }
  else
  {
    this->SetMesh(state.Mesh);
    this->IsCameraGiven = withCamera;
  }
  if (this->Environment)
  {
    this->Environment->SetRotationY(state.Rotation);
  }
  emit this->rotationChanged();
  emit this->methodsChanged();
  emit this->toleranceChanged();
  emit this->pictureChanged();
  emit this->referenceHeightChanged();
  emit this->lobeChanged();
  emit this->slicesChanged();
}

//------------------------------------------------------------------------------
std::vector<Item> Session::GetMaterials() const
{
  return ListMaterials(this->Current.MaterialFiles);
}

//------------------------------------------------------------------------------
std::vector<Item> Session::GetEnvironments() const
{
  return ListEnvironments(this->Current.EnvironmentFiles);
}

//------------------------------------------------------------------------------
std::vector<Item> Session::GetMeshes() const { return ListMeshes(this->MeshFile); }

//------------------------------------------------------------------------------
void Session::Open(const QStringList& files)
{
  std::vector<std::string> names;
  for (const QString& file : files)
  {
    names.push_back(file.toStdString());
  }
  if (names.empty())
  {
    return;
  }
  this->Background->Start(
    "open", tr("reading"),
    [this, names](JobThread& thread)
    {
      for (const std::string& name : names)
      {
        try
        {
          this->OpenOne(name, thread);
        }
        catch (const std::exception& error)
        {
          const QString text = QString::fromUtf8(error.what());
          thread.Post([this, text]() { this->Say(text, true); });
        }
      }
    },
    [this](const QString& text) { this->Say(text, true); });
}

//------------------------------------------------------------------------------
// On a thread.
void Session::OpenOne(const std::string& file, JobThread& thread)
{
  const auto tryMaterial = [&]()
  {
    tool::Material material = tool::LoadMaterial(file);
    material.BRDF->Prepare();
    thread.Post(
      [this, material]()
      {
        this->Background->Stop("material"); // asked for before
        this->Take(material);
      });
  };
  const auto tryEnvironment = [&]()
  {
    const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(file);
    thread.Post(
      [this, environment, file]()
      {
        this->Background->Stop("environment");
        this->Take(environment, file);
      });
  };
  if (IsEmbeddedEnvironment(file))
  {
    tryEnvironment();
    return;
  }
  switch (FindFileKind(file))
  {
    case FileKind::State:
      thread.Post([this, state = LoadState(file)]() { this->Replace(state); });
      break;
    case FileKind::Mesh:
    {
      const vtkSmartPointer<vtkPolyData> mesh = LoadMeshByName(file);
      thread.Post(
        [this, mesh, file]()
        {
          this->Background->Stop("mesh");
          this->Take(mesh, file);
        });
      break;
    }
    case FileKind::Environment:
      tryEnvironment();
      break;
    case FileKind::Material:
      tryMaterial();
      break;
    case FileKind::MaterialOrEnvironment:
      try
      {
        tryMaterial();
      }
      catch (const tool::Error& asMaterial)
      {
        try
        {
          tryEnvironment();
        }
        catch (const tool::Error& asEnvironment)
        {
          throw tool::Error(std::string("As a material: ") + asMaterial.what() +
                            ". As an environment: " + asEnvironment.what());
        }
      }
  }
}

//------------------------------------------------------------------------------
void Session::SetMaterial(const std::string& file)
{
  if (this->Material.BRDF && file == this->Current.Material)
  {
    this->Background->Stop("material");
    return;
  }
  this->Background->Start(
    "material", tr("reading"),
    [this, file](JobThread& thread)
    {
      const tool::Material material = tool::LoadMaterial(file);
      material.BRDF->Prepare();
      thread.Post([this, material]() { this->Take(material); });
    },
    [this](const QString& text)
    {
      this->Say(text, true);
      emit this->listsChanged(); // the one before is the current one again
    });
}

//------------------------------------------------------------------------------
void Session::SetEnvironment(const std::string& file)
{
  if (this->Environment && file == this->Current.Environment)
  {
    this->Background->Stop("environment");
    return;
  }
  this->Background->Start(
    "environment", tr("reading"),
    [this, file](JobThread& thread)
    {
      const vtkSmartPointer<vtkEnvironment> environment = tool::LoadEnvironment(file);
      thread.Post([this, environment, file]() { this->Take(environment, file); });
    },
    [this](const QString& text)
    {
      this->Say(text, true);
      emit this->listsChanged();
    });
}

//------------------------------------------------------------------------------
void Session::SetMesh(const std::string& file)
{
  if (this->Mesh && file == this->Current.Mesh)
  {
    this->Background->Stop("mesh");
    return;
  }
  this->IsCameraGiven = false;
  this->Background->Start(
    "mesh", tr("reading"),
    [this, file](JobThread& thread)
    {
      const vtkSmartPointer<vtkPolyData> mesh = LoadMeshByName(file);
      thread.Post([this, mesh, file]() { this->Take(mesh, file); });
    },
    [this](const QString& text)
    {
      this->Say(text, true);
      emit this->listsChanged();
    });
}

//------------------------------------------------------------------------------
void Session::SetCompared(const std::vector<std::string>& files)
{
  this->Current.Compared = files;
  emit this->comparedChanged();
}

//------------------------------------------------------------------------------
void Session::Take(const tool::Material& material)
{
  if (!IsEmbeddedMaterial(material.File))
  {
    AddOnce(this->Current.MaterialFiles, material.File);
  }
  this->Material = material;
  this->Current.Material = material.File;
  this->Say(QString::fromStdString(material.Notes), false);
  emit this->listsChanged();
  emit this->materialChanged();
}

//------------------------------------------------------------------------------
void Session::Take(vtkEnvironment* environment, const std::string& file)
{
  if (!IsEmbeddedEnvironment(file))
  {
    AddOnce(this->Current.EnvironmentFiles, file);
  }
  this->Environment = environment;
  this->Environment->SetRotationY(this->Current.Rotation);
  this->Current.Environment = file;
  emit this->listsChanged();
  emit this->environmentChanged();
}

//------------------------------------------------------------------------------
void Session::Take(vtkPolyData* mesh, const std::string& file)
{
  this->Mesh = mesh;
  this->MeshFile = file;
  this->Current.Mesh = file;
  const CameraState camera = this->Current.Camera;
  emit this->listsChanged();
  emit this->meshChanged(); // the view looks at all of it
  if (this->IsCameraGiven)
  {
    this->Current.Camera = camera;
    emit this->cameraReplaced();
  }
  this->IsCameraGiven = false;
}

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
  this->Current.Exposure = std::clamp(stops, -10.0, 10.0);
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

//------------------------------------------------------------------------------
bool Session::Save(const std::string& path)
{
  try
  {
    SaveState(this->Current, path);
    this->Say(tr("Saved: %1").arg(QString::fromStdString(path)), false);
    return true;
  }
  catch (const std::exception& error)
  {
    this->Say(QString::fromUtf8(error.what()), true);
    return false;
  }
}

//------------------------------------------------------------------------------
bool Session::Load(const std::string& path)
{
  try
  {
    this->Replace(LoadState(path));
    return true;
  }
  catch (const std::exception& error)
  {
    this->Say(QString::fromUtf8(error.what()), true);
    return false;
  }
}
} // namespace explorer
