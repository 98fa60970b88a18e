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
class vtkMeasuredBRDFMapper;
class vtkOpenGLPolyDataMapper;
class vtkProperty;
class vtkRadiancePlanner;
class vtkTexture;

namespace tool
{
class OffscreenScene;
}

namespace explorer
{
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
  const std::string& GetKey() const;
  bool IsReference() const;

  /// Whether the material itself is drawn under the directional light: nothing is planned or made.
  bool IsDirect() const { return this->IsDirectlyLit && !this->IsStock; }

  /// Whether what is asked for is drawn.
  bool IsReady() const;

  /// Take up a plan that is ready; whether there was one: a render shows it.
  bool PollPlan();

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

signals:
  /// Another picture: a method was made, or the material changed.
  void changed();

private:
  void UpdateMethod();
  void UpdateMesh();
  void UpdateRotation();
  void UpdateLight();
  void UpdateTolerance();
  void StartMethod(const std::string& key);
  void StartFit();
  void DrawPlanned();
  void DrawDirect();
  void DrawMade(const tool::Method& method, vtkEnvironment* environment);
  void DrawFitted(vtkProperty* fitted, double error);
  void UpdateVisibility();
  void OnPlan();
  void OpenScene();
  QString GetJobKey() const;

  int Index;
  Session* Model;
  Jobs* Background;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkMeasuredBRDFMapper> Mapper;
  vtkNew<vtkActor> StockActor;
  vtkNew<vtkOpenGLPolyDataMapper> StockMapper;
  vtkNew<vtkTexture> StockLight;
  double StockUnit = 1.0; // of its radiance
  double Exposure = 1.0;
  vtkNew<vtkLight> Lamp;                 // on where there is the directional light
  vtkSmartPointer<vtkEnvironment> Light; // of the actor's mapper
  tool::Method Made;
  double FitError = 0.0;
  bool IsStock = false;       // what is drawn
  bool IsPlanned = false;     // what is drawn
  bool IsDirectlyLit = false; // by the directional light
  bool IsMade = true;         // false while a job makes the method
  bool IsVisible = true;
  std::string Plan;                            // that was told of
  std::unique_ptr<tool::OffscreenScene> Scene; // for Capture
  bool SceneIsStock = false;
  bool SceneIsDirect = false;
};
} // namespace explorer

#endif
