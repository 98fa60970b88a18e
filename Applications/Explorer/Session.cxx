// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Session.h"

#include "Files.h"
#include "Inspection.h"
#include "Meshes.h"
#include "ParallelFor.h"
#include "Progress.h"
#include "Tool.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace
{
constexpr int RemakeTime = 80; // ms after a slider moved

//------------------------------------------------------------------------------
// A file, not a built-in name. Returns whether it was not there before.
bool AddOnce(std::vector<std::string>& list, const std::string& file)
{
  if (!explorer::IsBuiltIn(file) && std::find(list.begin(), list.end(), file) == list.end())
  {
    list.push_back(file);
    return true;
  }
  return false;
}
} // namespace

namespace explorer
{
//------------------------------------------------------------------------------
Session::Session(Jobs* jobs, QObject* parent)
  : QObject(parent)
  , Background(jobs)
{
  this->Remake.setSingleShot(true);
  this->Remake.setInterval(RemakeTime);
  connect(&this->Remake, &QTimer::timeout, this, [this]() { this->SetMaterial(this->Edited); });
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
  this->Current.Material = before.Material;
  this->Current.Environment = before.Environment;
  this->Current.Mesh = before.Mesh;
  for (const std::string& file : state.Compared)
  {
    AddOnce(this->Current.MaterialFiles, file); // so that it can be taken out of them
  }
  Q_EMIT this->listsChanged();
  this->SetMaterial(state.Material);
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
}

//------------------------------------------------------------------------------
// One after the other: the newest job also reads what the one that it stops has not read.
void Session::Open(const QStringList& files)
{
  if (files.isEmpty())
  {
    return;
  }
  this->Opening += files;
  this->Background->Start("open", tr("reading"),
    [this, opening = this->Opening](const Jobs::Post& post)
    {
      for (const QString& file : opening)
      {
        if (tool::BackgroundWork::Get()->IsStopped())
        {
          return;
        }
        const std::string name = file.toStdString();
        std::function<void()> show;
        const auto problem =
          measuredbrdf::FindThrown([&]() { show = this->Read(FindFileKind(name), name); });
        post(
          [=]()
          {
            this->Opening.removeFirst();
            problem ? this->Say(QString::fromStdString(*problem), true) : show();
          });
      }
    });
}

//------------------------------------------------------------------------------
// On a thread. What it returns shows what was read, on the window's.
std::function<void()> Session::Read(FileKind kind, const std::string& file)
{
  switch (kind)
  {
    case FileKind::State:
      return [this, state = LoadState(file)]() { this->Replace(state); };
    case FileKind::Mesh:
      return [this, file, mesh = file == "sphere" ? tool::MakeSphere() : tool::LoadMesh(file)]()
      { this->Take(mesh, file); };
    case FileKind::Environment:
      return [this, file,
               environment = file == DirectionalLightName ? vtkSmartPointer<vtkEnvironment>()
                                                          : tool::LoadEnvironment(file)]()
      { this->Take(environment, file); };
    case FileKind::Material:
      return [this, read = ReadMaterial(file)]() { this->Take(read); };
    default: // a material or an environment
      break;
  }
  try
  {
    return this->Read(FileKind::Material, file);
  }
  catch (const tool::Error& asMaterial)
  {
    try
    {
      return this->Read(FileKind::Environment, file);
    }
    catch (const tool::Error& asEnvironment)
    {
      throw tool::Error(std::string("As a material: ") + asMaterial.what() +
                        ". As an environment: " + asEnvironment.what());
    }
  }
}

//------------------------------------------------------------------------------
// Where it cannot be read, the one before is the current one again.
void Session::Show(FileKind kind, const QString& job, const std::string& file, bool isShown)
{
  if (isShown)
  {
    this->Background->Stop(job);
    return;
  }
  this->Background->Compute(
    job, tr("reading"), [=]() { return this->Read(kind, file); },
    [](const std::function<void()>& show) { show(); },
    [this](const QString& text)
    {
      this->Say(text, true);
      Q_EMIT this->listsChanged();
    });
}

//------------------------------------------------------------------------------
void Session::SetMaterial(const std::string& file)
{
  this->Remake.stop();
  this->Show(FileKind::Material, "material", file,
    this->GetMaterial().BRDF && file == this->Current.Material);
}

//------------------------------------------------------------------------------
void Session::SetEnvironment(const std::string& file)
{
  this->Show(
    FileKind::Environment, "environment", file, this->IsLit() && file == this->Current.Environment);
}

//------------------------------------------------------------------------------
void Session::SetMesh(const std::string& file)
{
  this->IsCameraGiven = false;
  this->Show(FileKind::Mesh, "mesh", file, this->Mesh && file == this->Current.Mesh);
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
    this->Say(
      tr("At most %1 materials are compared with the one that is shown").arg(int(MostCompared)),
      true);
  }
  else if (isCompared)
  {
    files.push_back(file);
    if (AddOnce(this->Current.MaterialFiles, file)) // a model with parameters, for its box
    {
      Q_EMIT this->listsChanged();
    }
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
std::vector<ShownMaterial> Session::GetChartedMaterials() const
{
  std::vector<ShownMaterial> materials = { this->Made };
  for (const std::string& file : this->Current.Compared)
  {
    const auto found = this->Compared.find(file);
    if (found != this->Compared.end() && file != this->Made.Material.File)
    {
      materials.push_back(found->second);
    }
  }
  return materials;
}

//------------------------------------------------------------------------------
// What is missing. One job reads one after the other: they may be large.
void Session::ReadCompared()
{
  this->Background->Stop("compare");
  std::vector<std::string> missing;
  for (const std::string& file : this->Current.Compared)
  {
    const auto found = this->Compared.find(file);
    if (found == this->Compared.end() || found->second.Info.is_null())
    {
      missing.push_back(file);
    }
  }
  if (missing.empty())
  {
    return;
  }
  this->Background->Start("compare", tr("reading for comparison"),
    [=](const Jobs::Post& post)
    {
      for (const std::string& file : missing)
      {
        if (tool::BackgroundWork::Get()->IsStopped())
        {
          return;
        }
        const auto show = [this, &post](const ShownMaterial& read)
        {
          post(
            [this, read]()
            {
              this->Compared[read.Material.File] = read;
              Q_EMIT this->comparedChanged();
            });
        };
        const auto problem = measuredbrdf::FindThrown(
          [&]()
          {
            ShownMaterial read = ReadMaterial(file);
            const tool::Material snapshot = MakeSnapshot(read.Material);
            show(read);
            read.Info = tool::InspectMaterial(snapshot); // for the albedo, which takes longer
            show(read);
          });
        if (problem)
        {
          post(
            [=]()
            {
              this->Say(QString::fromStdString(*problem), true);
              this->SetCompared(file, false);
            });
        }
      }
    });
}

//------------------------------------------------------------------------------
// What is read by other means is not waited for.
void Session::Take(const ShownMaterial& read)
{
  this->Background->Stop("material");
  this->Current.Material = read.Material.File;
  if (!FindModel(read.Material.File))
  {
    AddOnce(this->Current.MaterialFiles, read.Material.File);
  }
  this->Say(QString::fromStdString(read.Material.Notes), false);
  this->Made = read;
  this->InspectionError.clear();
  Q_EMIT this->listsChanged();
  const bool isEdited =
    FindModel(this->Edited) && FindModel(this->Edited) == FindModel(read.Material.File);
  if (!this->Remake.isActive() || !isEdited) // else its parameters are being set
  {
    this->Remake.stop();
    this->Edited = read.Material.File;
    Q_EMIT this->modelsChanged();
  }
  Q_EMIT this->materialChanged();
  this->Background->Compute(
    "findings", tr("measuring the material"),
    [material = MakeSnapshot(read.Material)]() { return tool::InspectMaterial(material); },
    [this](const nlohmann::ordered_json& info)
    {
      this->Made.Info = info;
      Q_EMIT this->inspected();
    },
    [this](const QString& text)
    {
      this->Say(text, true);
      this->InspectionError = tr("The material could not be measured: %1").arg(text);
      Q_EMIT this->inspected();
    });
}

//------------------------------------------------------------------------------
void Session::Take(const vtkSmartPointer<vtkEnvironment>& environment, const std::string& file)
{
  this->Background->Stop("environment");
  this->Environment = environment;
  if (environment)
  {
    AddOnce(this->Current.EnvironmentFiles, file);
    this->Environment->SetRotationY(this->Current.Rotation);
  }
  this->Current.Environment = file;
  Q_EMIT this->listsChanged();
  Q_EMIT this->environmentChanged();
}

//------------------------------------------------------------------------------
void Session::Take(const vtkSmartPointer<vtkPolyData>& mesh, const std::string& file)
{
  this->Background->Stop("mesh");
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
  if (!this->Made.Material.BRDF)
  {
    return;
  }
  this->Background->Compute(
    "save material", tr("writing the material"),
    [path, shown = MakeSnapshot(this->Made.Material)]()
    {
      tool::WriteMaterial(shown.BRDF, path);
      return shown.Transmission != nullptr;
    },
    [this, path](bool transmits)
    {
      this->Say(tr("Saved: %1").arg(QString::fromStdString(path)) +
                  (transmits ? tr(" (its transmission is left out)") : QString()),
        false);
    });
}

//------------------------------------------------------------------------------
bool Session::Try(const std::function<void()>& what)
{
  const auto problem = measuredbrdf::FindThrown(what);
  if (problem)
  {
    this->Say(QString::fromStdString(*problem), true);
  }
  return !problem;
}

//------------------------------------------------------------------------------
bool Session::Save(const std::string& path)
{
  return this->Try(
    [&]()
    {
      tool::WriteWhole(path, WriteState(this->Current));
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
void Session::SetModelValue(const std::string& parameter, std::size_t k, double value)
{
  if (const ParametricModel* model = FindModel(this->Edited))
  {
    ModelValues values = GetValues(this->Edited);
    values.at(parameter).at(k) = value;
    this->Edited = NameModel(*model, values);
    this->Remake.start();
    Q_EMIT this->modelsChanged();
  }
}

//------------------------------------------------------------------------------
void Session::SetMethod(int side, const std::string& key)
{
  if (IsMethod(key))
  {
    this->Edit(&Session::methodsChanged, [&](State& state) { state.Methods[side] = key; });
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
