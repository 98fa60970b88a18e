// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What is being explored: the state, the objects that it names, and what
 * changes them. No widgets.
 */

#ifndef Session_h
#define Session_h

#include "Jobs.h"
#include "Materials.h"
#include "State.h"

#include "vtkEnvironment.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace explorer
{
/**
 * Files are read in the background; what was shown before stays until one has
 * been read, and stays where it cannot be read, with a message.
 */
class Session : public QObject
{
  Q_OBJECT

public:
  using Signal = void (Session::*)();

  explicit Session(Jobs* jobs, QObject* parent = nullptr);

  const State& GetState() const { return this->Current; }

  /// Show what a state says; without its camera: the whole mesh.
  void Replace(const State& state, bool withCamera = true);

  /// Open files of any kind: materials, environments, meshes, states.
  void Open(const QStringList& files);

  ///@{
  /// Read it and show it.
  void SetMaterial(const std::string& file);
  void SetEnvironment(const std::string& file);
  void SetMesh(const std::string& file);
  ///@}

  ///@{
  /// Which materials the charts have beside the one that is shown, at most MostCompared. They are
  /// read in the background; what cannot be read is taken out, with a message.
  void SetCompared(const std::vector<std::string>& files);
  void SetCompared(const std::string& file, bool isCompared);
  bool IsCompared(const std::string& file) const;
  ///@}

  /// What the charts have: the material that is shown, then those that it is compared with and that
  /// have been read.
  std::vector<ShownMaterial> GetChartedMaterials() const;

  ///@{
  /// What was read; null before. The environment is null, too, where there is
  /// one directional light.
  const tool::Material& GetMaterial() const { return this->Made.Material; }
  vtkEnvironment* GetEnvironment() const { return this->Environment; }
  vtkPolyData* GetMesh() const { return this->Mesh; }
  ///@}

  ///@{
  /// What was measured of the material, null before; and why it cannot be measured, else "".
  const nlohmann::ordered_json& GetInspection() const { return this->Made.Info; }
  const QString& GetInspectionError() const { return this->InspectionError; }
  ///@}

  /// The file of the mesh that is shown.
  const std::string& GetMeshFile() const { return this->MeshFile; }

  /// Whether one directional light is in an environment's place.
  bool IsDirectional() const { return this->Current.Environment == DirectionalLightName; }

  /// Whether there is light: an environment that has been read, or the
  /// directional light.
  bool IsLit() const { return this->Environment || this->IsDirectional(); }

  /// Whether the material waits for parameters to come to rest.
  bool IsWaiting() const { return this->Remake.isActive(); }

  ///@{
  /// Changes the state and tells of it. Values outside of what a state allows are taken as the
  /// nearest that are allowed.
  void Edit(Signal changed, const std::function<void(State&)>& change);
  template <typename Value>
  void Set(Value State::*field, const Value& value, Signal changed)
  {
    this->Edit(changed, [&](State& state) { state.*field = value; });
  }
  void SetRotation(double turn) { this->Set(&State::Rotation, turn, &Session::rotationChanged); }
  void SetLight(const LightState& light)
  {
    this->Set(&State::Light, light, &Session::lightChanged);
  }
  void SetMethod(int side, const std::string& key);
  void SetLights(int count) { this->Set(&State::Lights, count, &Session::methodsChanged); }
  void SetLobe(double thetaI, double phiI);
  void SetTolerance(double share)
  {
    this->Set(&State::Tolerance, share, &Session::toleranceChanged);
  }
  void SetShown(Shown shown) { this->Set(&State::Show, shown, &Session::pictureChanged); }
  void SetSplit(double share) { this->Set(&State::Split, share, &Session::pictureChanged); }
  ///@}

  ///@{
  /// The name of the material that is shown, where it is a model with the parameters that it will
  /// have: what is shown of it follows in the background.
  const std::string& GetEdited() const { return this->Edited; }
  void SetModelValue(const std::string& parameter, std::size_t k, double value);
  ///@}

  ///@{
  /// State files. False with a message where that does not work.
  bool Save(const std::string& path);
  bool Load(const std::string& path);

  /// Does something; where it throws, people are told. Whether it did not.
  bool Try(const std::function<void()>& what);
  ///@}

  /// The material that is shown, with its parameters, as a file
  /// (.exr), in the background.
  void SaveMaterial(const std::string& path);

  /// Something to tell people.
  void Say(const QString& text, bool isError) { Q_EMIT this->messaged(text, isError); }

Q_SIGNALS:
  void listsChanged();
  void materialChanged();
  void inspected();       // the material was measured
  void comparedChanged(); // which are to be compared, or one has been read
  void environmentChanged();
  void rotationChanged();
  void lightChanged();
  void modelsChanged();
  void meshChanged();
  void toleranceChanged();
  void methodsChanged();
  void pictureChanged(); // how the picture is shown: split, exposure, backdrop
  void referenceHeightChanged();
  void cameraChanged();
  void cameraReplaced(); // by another state
  void lobeChanged();
  void slicesChanged();
  void messaged(const QString& text, bool isError);

private:
  std::function<void()> Read(FileKind kind, const std::string& file);
  void Show(FileKind kind, const QString& job, const std::string& file, bool isShown);
  void ReadCompared();
  void Take(const ShownMaterial& read);
  void Take(const vtkSmartPointer<vtkEnvironment>& environment, const std::string& file);
  void Take(const vtkSmartPointer<vtkPolyData>& mesh, const std::string& file);

  Jobs* Background;
  State Current;
  ShownMaterial Made;
  QString InspectionError;
  std::map<std::string, ShownMaterial> Compared; // by their files
  std::string Edited;
  QTimer Remake; // until Edited is made
  vtkSmartPointer<vtkEnvironment> Environment;
  vtkSmartPointer<vtkPolyData> Mesh;
  std::string MeshFile;       // of Mesh
  QStringList Opening;        // what is not read yet
  bool IsCameraGiven = false; // by the state that the next mesh belongs to
};
} // namespace explorer

#endif
