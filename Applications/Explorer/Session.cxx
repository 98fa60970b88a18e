// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Session.h"

#include "FileKinds.h"
#include "Files.h"
#include "Meshes.h"
#include "ModelMaterials.h"
#include "Progress.h"
#include "Tool.h"

#include <algorithm>
#include <utility>

namespace
{
constexpr int RemakeTime = 80; // ms after a slider moved

//------------------------------------------------------------------------------
void AddOnce(std::vector<std::string>& list, const std::string& file)
{
  if (std::find(list.begin(), list.end(), file) == list.end())
  {
    list.push_back(file);
  }
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
  this->Remake.setSingleShot(true);
  this->Remake.setInterval(RemakeTime);
  connect(&this->Remake, &QTimer::timeout, this, &Session::RemakeMaterial);
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
  this->SavedEdits = state.Edits;
  this->Current.Material = before.Material;
  this->Current.Environment = before.Environment;
  this->Current.Mesh = before.Mesh;
  for (const std::string& file : state.Compared)
  {
    if (!IsEmbeddedMaterial(file) && !FindModel(file))
    {
      AddOnce(this->Current.MaterialFiles, file); // so that it can be taken out
    }
  }
  emit this->replaced();
  emit this->listsChanged();
  emit this->modelsChanged();
  emit this->editsChanged();
  this->SetMaterial(state.Material);
  this->Remake.start(); // where it is the one that is shown
  this->SetCompared(state.Compared);
  this->SetEnvironment(state.Environment);
  emit this->lightChanged();
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
  if (files.empty())
  {
    return;
  }
  for (const QString& file : files)
  {
    this->Opening.push_back(file.toStdString());
  }
  // One job at a time: this one also reads what the one that it stops has not read.
  this->Background->Start(
    "open", tr("reading"),
    [this, names = this->Opening, settings = this->GetMaterialSettings()](JobThread& thread)
    {
      for (const std::string& name : names)
      {
        if (tool::BackgroundWork::Get()->IsStopped())
        {
          return;
        }
        try
        {
          this->OpenOne(name, settings, thread);
        }
        catch (const std::exception& error)
        {
          const QString text = QString::fromUtf8(error.what());
          thread.Post([this, text]() { this->Say(text, true); });
        }
        thread.Post([this]() { this->Opening.erase(this->Opening.begin()); }); // this one
      }
    },
    [this](const QString& text) { this->Say(text, true); });
}

//------------------------------------------------------------------------------
// On a thread.
void Session::OpenOne(const std::string& file, const MaterialSettings& settings, JobThread& thread)
{
  const auto tryMaterial = [&]()
  {
    const MadeMaterial made = MakeMaterial(file, settings);
    thread.Post(
      [this, made]()
      {
        this->Background->Stop("material"); // asked for before
        this->Take(made);
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
  if (file == DirectionalLightName)
  {
    thread.Post([this, file]() { this->SetEnvironment(file); });
    return;
  }
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
  if (this->GetMaterial().BRDF && file == this->Current.Material)
  {
    this->Background->Stop("material");
    return;
  }
  this->Background->Start(
    "material", tr("reading"),
    [this, file, settings = this->GetMaterialSettings()](JobThread& thread)
    {
      const MadeMaterial made = MakeMaterial(file, settings);
      thread.Post([this, made]() { this->Take(made); });
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
  if (this->IsLit() && file == this->Current.Environment)
  {
    this->Background->Stop("environment");
    return;
  }
  if (file == DirectionalLightName)
  {
    this->Background->Stop("environment");
    this->Take(static_cast<vtkEnvironment*>(nullptr), file);
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
void Session::Take(const MadeMaterial& made)
{
  const std::string& file = made.Shown.File;
  if (!IsEmbeddedMaterial(file) && !FindModel(file))
  {
    AddOnce(this->Current.MaterialFiles, file);
  }
  this->Background->Stop("remake"); // of what was shown
  this->Made = made;
  this->Current.Material = file;
  this->Say(QString::fromStdString(made.Shown.Notes), false);
  emit this->listsChanged();
  emit this->materialChanged();
  this->Remake.start(); // where settings have changed since it was asked for
}

//------------------------------------------------------------------------------
MaterialSettings Session::GetMaterialSettings() const
{
  return { this->Current.Models, this->Current.Edits };
}

//------------------------------------------------------------------------------
// The material that is shown with other parameters or edits; another one is not waited for.
void Session::RemakeMaterial()
{
  emit this->settingsSettled();
  const MaterialSettings settings = this->GetMaterialSettings();
  const std::string file = this->Made.Shown.File;
  if (!this->Made.Shown.BRDF || !this->Made.IsAnother(settings))
  {
    this->Background->Stop("remake"); // of settings that are taken back
    return;
  }
  this->Background->Start(
    "remake", tr("making the material"),
    [this, original = this->Made.Original, settings](JobThread& thread)
    {
      const MadeMaterial made = RemakeMaterialOf(original, settings);
      thread.Post(
        [this, made]()
        {
          if (made.Shown.File == this->Made.Shown.File)
          {
            this->Made = made;
            if (made.Shown.Notes != made.Original.Notes)
            {
              this->Say(QString::fromStdString(made.Shown.Notes), true);
            }
            emit this->materialChanged();
          }
        });
    },
    [this](const QString& text) { this->Say(text, true); });
}

//------------------------------------------------------------------------------
void Session::Take(vtkEnvironment* environment, const std::string& file)
{
  if (environment && !IsEmbeddedEnvironment(file))
  {
    AddOnce(this->Current.EnvironmentFiles, file);
  }
  this->Environment = environment;
  if (environment)
  {
    this->Environment->SetRotationY(this->Current.Rotation);
  }
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
void Session::SaveMaterial(const std::string& path)
{
  vtkSmartPointer<vtkBRDF> brdf = this->Made.Shown.BRDF;
  if (!brdf)
  {
    return;
  }
  if (auto copy = vtkSmartPointer<vtkBRDF>::Take(brdf->NewSnapshot()))
  {
    brdf = copy;
  }
  this->Background->Start(
    "save material", tr("writing the material"),
    [this, brdf, path, shown = this->Made.Shown, edits = this->Made.Edits](JobThread& thread)
    {
      tool::WriteMaterial(brdf, path);
      thread.Post(
        [this, path, shown, edits]()
        {
          const auto current = this->Current.Edits.find(shown.File);
          if (current != this->Current.Edits.end() && current->second == edits)
          {
            this->SavedEdits[shown.File] = edits; // not where others came meanwhile
          }
          this->Say(tr("Saved: %1").arg(QString::fromStdString(path)) +
                      (shown.Transmission ? tr(" (its transmission is left out)") : QString()),
            false);
        });
    },
    [this](const QString& text) { this->Say(text, true); });
}

//------------------------------------------------------------------------------
bool Session::HasUnsavedEdits() const
{
  return std::any_of(this->Current.Edits.begin(), this->Current.Edits.end(),
    [this](const auto& edits)
    {
      const auto saved = this->SavedEdits.find(edits.first);
      return saved == this->SavedEdits.end() || saved->second != edits.second;
    });
}

//------------------------------------------------------------------------------
bool Session::Save(const std::string& path)
{
  try
  {
    SaveState(this->Current, path);
    this->SavedEdits = this->Current.Edits;
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
