// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What tables of radiance of one material have in common, whatever their sizes and the light: a
 * planner, which tries many, has it made once.
 */

#ifndef MaterialPrecomputation_h
#define MaterialPrecomputation_h

#include "LobeHarmonics.h"
#include "LobeViews.h"
#include "vtkRadianceIntegrator.h"
#include "vtkSmartPointer.h"

#include <Eigen/Core>

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// For one material while it does not change; not for two threads at a time.
class MaterialPrecomputation
{
public:
  /// quick: of an isotropic material by far fewer evaluations, for a table that nothing is promised
  /// of.
  explicit MaterialPrecomputation(bool quick = false);
  ~MaterialPrecomputation();

  /// What is wanted of kernels: their nodes, or else no more than GetExpanded of these sizes.
  struct Use
  {
    bool Nodes = true;
    int Degree = 0;
    int Orders = 0;
  };

  /// Kernels at so many view angles (LobeViews::GetKnotAngle). Null ones where it was aborted.
  using Kernels = std::vector<std::unique_ptr<LobeHarmonics>>;
  const Kernels& GetKernels(
    vtkBRDF* brdf, int angles, int resolution, const std::atomic<bool>& abort, const Use& use);
  const Kernels& GetKernels(
    vtkBRDF* brdf, int angles, int resolution, const std::atomic<bool>& abort)
  {
    return this->GetKernels(brdf, angles, resolution, abort, Use());
  }

  /// Their harmonics about the axes of the views, as LobeHarmonics::Expand has them: of these
  /// sizes, taken from larger ones where these are known.
  std::vector<std::vector<float>> GetExpanded(const Kernels& kernels, int degree, int orders);

  /// What a factored table lacks of the kernels (RadianceCore.h), by what it depends on: the sizes
  /// that made it.
  using Matrices = std::vector<Eigen::MatrixXd>;
  const Matrices& GetRemainders(
    const std::vector<double>& sizes, const std::function<Matrices()>& make);

  ///@{
  /// Of anisotropic materials: the views, and kernels at so many polar angles of the view and
  /// azimuths over f's period, the azimuths of one angle side by side.
  const AnisotropicViews& GetAnisotropicViews(vtkBRDF* brdf, const std::atomic<bool>& abort);
  using AnisotropicKernels = std::vector<std::unique_ptr<AnisotropicLobe>>;
  const AnisotropicKernels& GetAnisotropicKernels(
    vtkBRDF* brdf, int angles, int azimuths, int resolution, const std::atomic<bool>& abort);
  ///@}

  /// The material's views: for a profile, and to be split into parts.
  const LobeViews& GetViews(vtkBRDF* brdf, const std::atomic<bool>& abort);

  /// LampBRDF::Make of an isotropic material; null where it was aborted.
  vtkSmartPointer<vtkBRDF> GetLampForm(
    vtkBRDF* brdf, double spread, const std::atomic<bool>& abort);

  /// Without what few plans need: what a factored table lacks, and the nodes of kernels at more
  /// than so many angles or of more than so many nodes. Their harmonics stay.
  void Trim(int mostAngles, int mostNodes);

private:
  const bool Quick;
  std::map<std::pair<int, int>, Kernels> KernelsOf; // angles, resolution
  struct Expansion
  {
    int Degree = -1;
    int Orders = -1;
    std::vector<std::vector<float>> Harmonics;
  };
  std::map<const Kernels*, Expansion> Expansions;
  std::map<std::vector<double>, Matrices> Remainders;
  std::unique_ptr<LobeViews> Views;
  bool AreViewsWhole = false;                           // else they were aborted
  std::map<double, vtkSmartPointer<vtkBRDF>> LampForms; // by spread
  std::unique_ptr<AnisotropicViews> ViewsByAzimuth;
  bool AreViewsByAzimuthWhole = false;
  std::map<std::array<int, 3>, AnisotropicKernels> KernelsByAzimuth; // angles, azimuths, resolution
};
} // namespace measuredbrdf

/// What public headers call it.
class vtkRadianceIntegrator::Precomputation : public measuredbrdf::MaterialPrecomputation
{
public:
  using MaterialPrecomputation::MaterialPrecomputation;
};

#endif
