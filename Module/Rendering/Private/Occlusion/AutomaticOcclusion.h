// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether what a surface hides from itself is worth modeling (vtkOcclusionPredictor), and where it
 * is, vtkSurfaceVisibilityFilter's arrays: made at once, or on a thread.
 */

#ifndef AutomaticOcclusion_h
#define AutomaticOcclusion_h

#include "RecentlyUsed.h"
#include "vtkBRDF.h"
#include "vtkDataObject.h"
#include "vtkEnvironment.h"
#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace measuredbrdf
{
class SharedTrace;

/// What is drawn, with which light.
struct OcclusionQuestion
{
  struct Material
  {
    vtkSmartPointer<vtkBRDF> BRDF;
    vtkSmartPointer<vtkEnvironment> Environment;
    vtkMTimeType PixelsTime = 0; // of the environment
    double PlanError = 0.0;
  };
  vtkDataObject* Input = nullptr; // polydata, or composite data
  std::vector<Material> Materials;
  /// From the input's axes; none: the same. Asked for a new answer only.
  std::function<vtkSmartPointer<vtkMatrix4x4>()> FindToEnvironment;
  double Tolerance = 0.02;
  bool InBackground = false; // BRDFs are then snapshots
  bool Always = false;       // whatever it is worth: Materials do not matter
  bool WithBounce = false;   // whether what is traced has to have vtkSurfaceVisibilityFilter's
};

class AutomaticOcclusion
{
public:
  AutomaticOcclusion();

  /// Stops what is in the making, but does not wait for that.
  ~AutomaticOcclusion();
  AutomaticOcclusion(const AutomaticOcclusion&) = delete;
  void operator=(const AutomaticOcclusion&) = delete;

  /// Once a frame: answer, or begin to. What was answered holds until the surface, a material or
  /// the environment's pixels change; a rotation does not change it. A surface that changes in
  /// every frame is left alone after the third, until it rests. Returns why an answer that came
  /// now could not be found, for lack of memory say, or "": it is not tried again until it changes.
  std::string Update(const OcclusionQuestion& question);

  /// The input as it was last, with arrays; null: not worth it, or not known yet.
  vtkDataObject* GetTraced() const { return this->Traced; }

  /// The predicted error of leaving occlusion out; negative: not known.
  double GetError() const;

  /// For a plan: "" where next to nothing is hidden.
  std::string GetText() const;

  bool IsPending() const { return this->Work != nullptr; }
  bool IsReady() const;

  /// More points are not traced before a frame, and still more on no thread.
  static constexpr vtkIdType MostPoints = 20000;
  static constexpr vtkIdType MostPointsInBackground = 2000000;

private:
  class Job;
  using Key = std::vector<std::uint64_t>;

  /// What is known once a job is done.
  struct Prediction
  {
    double Error = -1.0; // of the material with the largest one; negative: not known
    double Uncertainty = 0.0;
    bool IsLeftOut = false; // worth modeling, but too large
    vtkIdType Points = 0;
    vtkIdType Most = 0;
    std::string Problem;
  };

  static Key GetKey(const OcclusionQuestion& question);
  bool FollowsSurface(vtkDataObject* input);
  void Begin(const OcclusionQuestion& question);
  void Leave();
  std::string Take();

  std::vector<std::pair<void*, vtkMTimeType>> Stamp; // of the surfaces' arrays in the last frame
  std::string Content;                               // hash of what they hold
  int Changes = 0;                                   // frames in a row with another content
  Key Asked;
  std::shared_ptr<Job> Work;           // which its thread holds, too
  RecentlyUsed<Key, Prediction> Known; // of this content
  std::optional<Prediction> Answer;    // to the last question
  vtkSmartPointer<vtkDataObject> Traced;
  std::shared_ptr<SharedTrace> Trace; // of which Traced has its arrays
  bool WithBounce = false;            // whether it has the bounce
};
} // namespace measuredbrdf

#endif
