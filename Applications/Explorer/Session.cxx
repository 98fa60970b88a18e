// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Session.h"

#include "Files.h"
#include "Meshes.h"
#include "Progress.h"
#include "Tool.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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
} // namespace

namespace explorer
{
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
  connect(this, &Session::rotationChanged, this,
    [this]()
    {
      if (this->Environment)
      {
        this->Environment->SetRotationY(this->Current.Rotation);
      }
    });
  connect(jobs, &Jobs::noted, this, [this](const QString& text) { this->Say(text, false); });
  connect(jobs, &Jobs::failed, this, [this](const QString& text) { this->Say(text, true); });
}

//------------------------------------------------------------------------------
// What is on the screen stays until the new state's objects have been read.
void Session::Replace(const State& state, bool withCamera)
{
  const State before = this->Current;
  this->Current = state;
  this->Current.Note.clear();
  this->Current.Material = before.Material;
  this->Current.Environment = before.Environment;
  this->Current.Mesh = before.Mesh;
  for (const std::string& file : state.Compared)
  {
    if (!IsBuiltInMaterial(file))
    {
      AddOnce(this->Current.MaterialFiles, file); // so that it can be taken out
    }
  }
  Q_EMIT this->listsChanged();
  Q_EMIT this->modelsChanged();
  this->SetMaterial(state.Material);
  this->Remake.start(); // where it is the one that is shown
  this->SetCompared(state.Compared);
  this->SetEnvironment(state.Environment);
  Q_EMIT this->lightChanged();
  if (this->Mesh && this->MeshFile == state.Mesh)
  {
    Q_EMIT this->cameraReplaced();
  }
  else
  {
    this->SetMesh(state.Mesh);
    this->IsCameraGiven = withCamera;
  }
  for (const Signal signal : { &Session::rotationChanged, &Session::methodsChanged,
         &Session::toleranceChanged, &Session::pictureChanged, &Session::referenceHeightChanged,
         &Session::lobeChanged, &Session::slicesChanged })
  {
    Q_EMIT(this->*signal)();
  }
  if (!state.Note.empty())
  {
    this->Say(QString::fromStdString(state.Note), false);
  }
}

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
  // One job at a time: this one also reads what the one that it stops has not
  // read.
  this->Background->Start("open", tr("reading"),
    [this, names = this->Opening, models = this->Current.Models](const Jobs::Post& post)
    {
      for (const std::string& name : names)
      {
        if (tool::BackgroundWork::Get()->IsStopped())
        {
          return;
        }
        try
        {
          this->OpenOne(name, models, post);
        }
        catch (const std::exception& error)
        {
          const QString text = QString::fromUtf8(error.what());
          post([this, text]() { this->Say(text, true); });
        }
        post([this]() { this->Opening.erase(this->Opening.begin()); }); // this one
      }
    });
}

//------------------------------------------------------------------------------
// On a thread. What was asked for before by other means is not waited for.
void Session::OpenOne(const std::string& file, const ModelStates& models, const Jobs::Post& post)
{
  const auto take = [this, &post](const char* job, const auto&... taken)
  {
    post(
      [this, job, taken...]()
      {
        this->Background->Stop(job);
        this->Take(taken...);
      });
  };
  const auto readMaterial = [&]() { take("material", MakeMaterial(file, models)); };
  const auto readEnvironment = [&]() { take("environment", tool::LoadEnvironment(file), file); };
  const FileKind kind = FindFileKind(file);
  switch (kind)
  {
    case FileKind::DirectionalLight:
      post([this, file]() { this->SetEnvironment(file); });
      break;
    case FileKind::State:
      post([this, state = LoadState(file)]() { this->Replace(state); });
      break;
    case FileKind::Mesh:
      take("mesh", LoadMeshByName(file), file);
      break;
    case FileKind::Environment:
      readEnvironment();
      break;
    case FileKind::Material:
      readMaterial();
      break;
    case FileKind::MaterialOrEnvironment:
      try
      {
        readMaterial();
      }
      catch (const tool::Error& asMaterial)
      {
        try
        {
          readEnvironment();
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
// Where it cannot be read, the one before is the current one again.
template <typename Reading, typename Taking>
void Session::Read(const char* job, Reading read, Taking take)
{
  this->Background->Compute(job, tr("reading"), read, take,
    [this](const QString& text)
    {
      this->Say(text, true);
      Q_EMIT this->listsChanged();
    });
}

//------------------------------------------------------------------------------
void Session::SetMaterial(const std::string& file)
{
  if (this->GetMaterial().BRDF && file == this->Current.Material)
  {
    this->Background->Stop("material");
    return;
  }
  this->Read(
    "material", [file, models = this->Current.Models]() { return MakeMaterial(file, models); },
    [this](const MadeMaterial& made) { this->Take(made); });
}

//------------------------------------------------------------------------------
void Session::SetEnvironment(const std::string& file)
{
  if (file == DirectionalLightName || (this->IsLit() && file == this->Current.Environment))
  {
    this->Background->Stop("environment");
    if (file != this->Current.Environment)
    {
      this->Take(vtkSmartPointer<vtkEnvironment>(), file);
    }
    return;
  }
  this->Read(
    "environment", [file]() { return tool::LoadEnvironment(file); },
    [this, file](const vtkSmartPointer<vtkEnvironment>& read) { this->Take(read, file); });
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
  this->Read(
    "mesh", [file]() { return LoadMeshByName(file); },
    [this, file](const vtkSmartPointer<vtkPolyData>& read) { this->Take(read, file); });
}

//------------------------------------------------------------------------------
void Session::SetCompared(const std::vector<std::string>& files)
{
  this->Current.Compared = files;
  for (auto one = this->Compared.begin(); one != this->Compared.end();)
  {
    one = this->IsCompared(one->first) ? std::next(one) : this->Compared.erase(one);
  }
  Q_EMIT this->comparedChanged();
  this->ReadCompared();
}

//------------------------------------------------------------------------------
void Session::SetCompared(const std::string& file, bool isCompared)
{
  std::vector<std::string> files = this->Current.Compared;
  files.erase(std::remove(files.begin(), files.end(), file), files.end());
  if (isCompared && files.size() >= MostCompared)
  {
    this->Say(tr("At most %1 materials are compared with the one that is shown")
                .arg(static_cast<int>(MostCompared)),
      true);
  }
  else if (isCompared)
  {
    files.push_back(file);
  }
  this->SetCompared(files);
}

//------------------------------------------------------------------------------
bool Session::IsCompared(const std::string& file) const
{
  const std::vector<std::string>& files = this->Current.Compared;
  return std::find(files.begin(), files.end(), file) != files.end();
}

//------------------------------------------------------------------------------
std::vector<ChartedMaterial> Session::GetComparedMaterials() const
{
  std::vector<ChartedMaterial> materials;
  for (const std::string& file : this->Current.Compared)
  {
    const auto found = this->Compared.find(file);
    if (found != this->Compared.end())
    {
      materials.push_back(found->second);
    }
  }
  return materials;
}

//------------------------------------------------------------------------------
// What is missing, or is a model with other parameters now. One job reads one after the other: they
// may be large. A model is shown as it was until then.
void Session::ReadCompared()
{
  const ModelStates models = this->Current.Models;
  std::vector<std::string> missing;
  for (const std::string& file : this->Current.Compared)
  {
    const auto found = this->Compared.find(file);
    if (found == this->Compared.end() || found->second.Values != FindValues(file, models))
    {
      missing.push_back(file);
    }
  }
  if (missing.empty())
  {
    this->Background->Stop("compare");
    return;
  }
  this->Background->Start("compare", tr("reading for comparison"),
    [this, missing, models](const Jobs::Post& post)
    {
      for (const std::string& file : missing)
      {
        if (tool::BackgroundWork::Get()->IsStopped())
        {
          return;
        }
        try
        {
          const MadeMaterial made = MakeMaterial(file, models);
          const tool::Material& read = made.Shown;
          const ChartedMaterial material{ file, read.Name, read.BRDF, SampleAlbedo(read.BRDF),
            made.Values, read.Transmission,
            read.Transmission ? SampleTransmittance(read.Transmission) : Curve() };
          post(
            [this, material]()
            {
              this->Compared[material.File] = material;
              Q_EMIT this->comparedChanged();
              if (material.Values != FindValues(material.File, this->Current.Models))
              {
                this->ReadCompared(); // they have changed since this was begun
              }
            });
        }
        catch (const std::exception& error)
        {
          post(
            [this, file, text = QString::fromUtf8(error.what())]()
            {
              this->Say(text, true);
              this->SetCompared(file, false);
            });
        }
      }
    });
}

//------------------------------------------------------------------------------
void Session::Take(const MadeMaterial& made)
{
  const std::string& file = made.Shown.File;
  if (!IsBuiltInMaterial(file))
  {
    AddOnce(this->Current.MaterialFiles, file);
  }
  this->Background->Stop("remake"); // of what was shown
  this->Made = made;
  this->Current.Material = file;
  this->Say(QString::fromStdString(made.Shown.Notes), false);
  Q_EMIT this->listsChanged();
  Q_EMIT this->materialChanged();
  this->Remake.start(); // where settings have changed since it was asked for
}

//------------------------------------------------------------------------------
// The model that is shown with other parameters; another material is not waited
// for.
void Session::RemakeMaterial()
{
  const ModelStates& models = this->Current.Models;
  if (std::any_of(this->Compared.begin(), this->Compared.end(),
        [&](const auto& one) { return one.second.Values != FindValues(one.first, models); }))
  {
    this->ReadCompared();
  }
  const std::string& file = this->Made.Shown.File;
  if (!this->Made.Shown.BRDF || this->Made.Values == FindValues(file, models))
  {
    this->Background->Stop("remake"); // of parameters that are taken back
    return;
  }
  this->Background->Compute(
    "remake", tr("making the material"), [file, models]() { return MakeMaterial(file, models); },
    [this](const MadeMaterial& made)
    {
      if (made.Shown.File == this->Made.Shown.File)
      {
        this->Made = made;
        Q_EMIT this->materialChanged();
      }
    });
}

//------------------------------------------------------------------------------
void Session::Take(const vtkSmartPointer<vtkEnvironment>& environment, const std::string& file)
{
  if (environment && !IsBuiltInEnvironment(file))
  {
    AddOnce(this->Current.EnvironmentFiles, file);
  }
  this->Environment = environment;
  if (environment)
  {
    this->Environment->SetRotationY(this->Current.Rotation);
  }
  this->Current.Environment = file;
  Q_EMIT this->listsChanged();
  Q_EMIT this->environmentChanged();
}

//------------------------------------------------------------------------------
void Session::Take(const vtkSmartPointer<vtkPolyData>& mesh, const std::string& file)
{
  this->Mesh = mesh;
  this->MeshFile = file;
  this->Current.Mesh = file;
  const CameraState camera = this->Current.Camera;
  Q_EMIT this->listsChanged();
  Q_EMIT this->meshChanged(); // the view looks at all of it
  if (this->IsCameraGiven)
  {
    this->Current.Camera = camera;
    Q_EMIT this->cameraReplaced();
  }
  this->IsCameraGiven = false;
}

//------------------------------------------------------------------------------
void Session::SaveMaterial(const std::string& path)
{
  if (!this->Made.Shown.BRDF)
  {
    return;
  }
  const tool::Material shown = MakeSnapshot(this->Made.Shown);
  this->Background->Start("save material", tr("writing the material"),
    [this, path, shown](const Jobs::Post& post)
    {
      tool::WriteMaterial(shown.BRDF, path);
      post(
        [this, path, shown]()
        {
          this->Say(tr("Saved: %1").arg(QString::fromStdString(path)) +
                      (shown.Transmission ? tr(" (its transmission is left out)") : QString()),
            false);
        });
    });
}

//------------------------------------------------------------------------------
bool Session::Try(const std::function<void()>& what)
{
  try
  {
    what();
    return true;
  }
  catch (const std::exception& error)
  {
    this->Say(QString::fromUtf8(error.what()), true);
    return false;
  }
}

//------------------------------------------------------------------------------
bool Session::Save(const std::string& path)
{
  return this->Try(
    [&]()
    {
      SaveState(this->Current, path);
      this->Say(tr("Saved: %1").arg(QString::fromStdString(path)), false);
    });
}

//------------------------------------------------------------------------------
bool Session::Load(const std::string& path)
{
  return this->Try([&]() { this->Replace(LoadState(path)); });
}

//------------------------------------------------------------------------------
void Session::Edit(Signal changed, const std::function<void(State&)>& change)
{
  change(this->Current);
  Limit(this->Current);
  Q_EMIT(this->*changed)();
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
  Q_EMIT this->modelsChanged();
  this->Remake.start();
}

//------------------------------------------------------------------------------
void Session::SetMethod(int side, const std::string& key)
{
  if (IsMethod(key))
  {
    this->Edit(&Session::methodsChanged,
      [&](State& state) { state.Methods[static_cast<std::size_t>(side)] = key; });
  }
}

//------------------------------------------------------------------------------
void Session::SetLobe(double thetaI, double phiI)
{
  this->Edit(&Session::lobeChanged,
    [&](State& state)
    {
      state.LobeThetaI = thetaI;
      state.LobePhiI = phiI;
    });
}
} // namespace explorer
