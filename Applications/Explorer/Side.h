// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One side of the picture: the mesh by one method.
 */

#ifndef Side_h
#define Side_h

#include "Inputs.h"
#include "Jobs.h"
#include "Methods.h"
#include "Picture.h"
#include "Session.h"

#include "vtkMeasuredBRDFMapper.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <QObject>
#include <QString>

#include <memory>
#include <string>

class vtkActor;
class vtkCamera;
class vtkLight;
class vtkOpenGLPolyDataMapper;
class vtkProperty;
class vtkRadiancePlanner;
class vtkTexture;

namespace explorer
{
class CaptureScene;

/**
 * Plans are made by the mapper's own thread, other methods by a job. What was drawn before is
 * drawn until then. Of the reference a side draws what is planned; the picture lies over it.
 */
class Side : public QObject
{
  Q_OBJECT

public:
  Side(int index, Session* session, Jobs* jobs, QObject* parent = nullptr);
  ~Side() override;

  vtkRenderer* GetRenderer() const { return this->Renderer; }

  /// The method that was asked for.
  const std::string& GetKey() const { return this->Model->GetState().Methods[this->Index]; }
  bool IsReference() const { return this->GetKey() == method::Reference; }

  /// Whether the material itself is drawn under the directional light: nothing is planned or made.
  bool IsDirect() const { return this->Drawn == Kind::Direct; }

  /// Whether what is asked for is drawn.
  bool IsReady() const;

  /// Take up a plan that is ready; whether there was one: a render shows it.
  bool PollPlan() { return this->Drawn == Kind::Planned && this->Mapper->GetPlanReady(); }

  /// What the mapper planned by; null where it did not.
  vtkRadiancePlanner* GetPlanner() const;

  /// Method, sizes, lights: one line.
  QString Describe() const;

  /// Factor of radiance before it is displayed.
  void SetExposure(double factor);

  void SetVisible(bool visible);

  /// Radiance that a camera sees, drawn off screen, and the time of one frame in milliseconds.
  /// Throws tool::Error.
  tool::Picture Capture(vtkCamera* camera, const tool::Size& size, double& frame);

Q_SIGNALS:
  /// Another picture: a method was made, or the material changed.
  void changed();

private:
  /// What is drawn: a method that the mapper plans or that was made, the material itself under the
  /// directional light, or VTK's own shading.
  enum class Kind
  {
    Planned,
    Made,
    Direct,
    Stock
  };

  void UpdateMethod();
  void UpdateMesh();
  void StartMethod(const std::string& key);
  void StartFit();
  template <typename Make, typename Take>
  void Start(const QString& label, Make make, Take take);
  void Draw(Kind kind, vtkEnvironment* light, const tool::Method& method);
  void Update();
  void OnPlan();
  QString GetJobKey() const { return QString("method %1").arg(this->Index); }

  int Index;
  Session* Model;
  Jobs* Background;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Actor; // of one mapper and property or of the other
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkProperty> Plain;
  vtkNew<vtkOpenGLPolyDataMapper> StockMapper;
  vtkNew<vtkProperty> Fitted;
  vtkNew<vtkTexture> StockLight;
  double StockUnit = 1.0; // of its radiance
  double Exposure = 1.0;
  vtkNew<vtkLight> Lamp;                 // on where there is the directional light
  vtkSmartPointer<vtkEnvironment> Light; // of what is drawn; null under the directional light
  tool::Method Made;
  double FitError = 0.0;
  Kind Drawn = Kind::Made;
  bool IsLit = false; // whether anything is drawn yet
  bool IsMade = true; // false while a job makes the method
  bool IsVisible = true;
  std::string Plan;                    // that was told of
  std::unique_ptr<CaptureScene> Scene; // for Capture
};
} // namespace explorer

#endif
