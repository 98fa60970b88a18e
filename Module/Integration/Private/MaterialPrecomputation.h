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

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
/// Kernels at a table's views. Each Means.Delta is where tables have the lobe's axis
/// (LobeViews::GetAxis).
struct MaterialKernels
{
  std::vector<LobeKernel> At; // none where it was aborted

  /// ExpandLobes of an isotropic material about these axes, kept for the next time; smaller sizes
  /// are taken from larger ones.
  std::vector<std::vector<float>> Expand(int degree, int orders);

  /// Whether that needs nodes, which may be forgotten.
  bool NeedsNodes(int degree, int orders) const
  {
    return this->Degree < degree || this->Orders < orders;
  }

private:
  int Degree = -1;
  int Orders = -1;
  std::vector<std::vector<float>> Harmonics;
};

/// For one material while it does not change; not for two threads at a time.
class MaterialPrecomputation
{
public:
  /// quick: of an isotropic material by far fewer evaluations, for a table that nothing is promised
  /// of.
  explicit MaterialPrecomputation(bool quick = false);
  ~MaterialPrecomputation();

  /// At so many polar angles of the view (LobeViews::GetKnotAngle); of anisotropic materials at so
  /// many azimuths over f's period, the azimuths of one angle side by side.
  struct Sizes
  {
    int Angles;
    int Resolution; // nodes over theta_i
    int Azimuths = 0;
  };

  /// What is wanted of kernels: their nodes, or else no more than Expand of these sizes.
  struct Use
  {
    bool Nodes = true;
    int Degree = 0;
    int Orders = 0;
  };

  MaterialKernels& GetKernels(
    vtkBRDF* brdf, const Sizes& sizes, const std::atomic<bool>& abort, const Use& use);
  MaterialKernels& GetKernels(vtkBRDF* brdf, const Sizes& sizes, const std::atomic<bool>& abort)
  {
    return this->GetKernels(brdf, sizes, abort, Use());
  }

  ///@{
  /// The views of an isotropic or an anisotropic material: for a profile, and to be split into
  /// parts.
  const LobeViews& GetViews(vtkBRDF* brdf, const std::atomic<bool>& abort);
  const AnisotropicViews& GetAnisotropicViews(vtkBRDF* brdf, const std::atomic<bool>& abort);
  ///@}

  /// LampBRDF::Make of an isotropic material; null where it was aborted.
  vtkSmartPointer<vtkBRDF> GetLampForm(
    vtkBRDF* brdf, double spread, const std::atomic<bool>& abort);

  /// Without what few plans need: forms of lamps, and the nodes of kernels at more than so many
  /// angles or of more than so many nodes. Their harmonics stay.
  void Trim(int mostAngles, int mostNodes);

private:
  const bool Quick;
  std::map<std::array<int, 3>, MaterialKernels> KernelsOf; // angles, resolution, azimuths
  std::unique_ptr<LobeViews> Views;
  std::unique_ptr<AnisotropicViews> ViewsByAzimuth;
  bool AreViewsWhole = false; // else they were aborted
  bool AreViewsByAzimuthWhole = false;
  std::map<double, vtkSmartPointer<vtkBRDF>> LampForms; // by spread
};
} // namespace measuredbrdf

/// What public headers call it.
class vtkRadianceIntegrator::Precomputation : public measuredbrdf::MaterialPrecomputation
{
public:
  using MaterialPrecomputation::MaterialPrecomputation;
};

#endif
