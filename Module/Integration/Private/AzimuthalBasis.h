// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The best basis of incident directions for one isotropic BRDF: f(i,o) is a Fourier series in the
 * difference of the azimuths phi_i - phi_o, and each of its orders m, a function of the two polar
 * angles, is decomposed by singular values. Weighted by both cosines and solid angles, so that by
 * Eckart and Young (1936) what is left out is the smallest there is for as many functions, and its
 * norm is known exactly.
 *
 *   f = sum_k s_k V_k(theta_i) (Uc_k(theta_o) cos(m_k dphi) + Us_k(theta_o) sin(m_k dphi)),
 *
 * s = 1 for m = 0, else 2; V is shared by the colors, U is RGB. Order 0 needs one function of i a
 * term, V, others two, V cos(m phi_i) and V sin(m phi_i). The sine part is only kept where the
 * material is not its own mirror image (isotropic measurements can be so).
 *
 * Sampled at NumberOfNodes polar angles each (CosinePowerWarp.h), theta_i down to the horizon,
 * theta_o down to MinimumViewCosine, and NumberOfAzimuths differences.
 */

#ifndef AzimuthalBasis_h
#define AzimuthalBasis_h

#include <Eigen/Core>

#include <functional>
#include <vector>

class vtkBRDF;

namespace measuredbrdf
{
class AzimuthalBasis
{
public:
  static constexpr int NumberOfNodes = 64;
  static constexpr int NumberOfAzimuths = 128;
  static constexpr int NumberOfOrders = NumberOfAzimuths / 2; // m = 0 ... 63

  struct Term
  {
    int Order;                // m
    double Sigma;             // singular value of each of its functions
    Eigen::VectorXd Incident; // V at the nodes
    Eigen::MatrixXd Cosine;   // Uc: nodes x RGB
    Eigen::MatrixXd Sine;     // Us, or empty
    int GetNumberOfFunctions() const { return this->Order > 0 ? 2 : 1; }
  };

  /**
   * Sample and decompose an isotropic material that is ready (vtkBRDF::Prepare). progress is called
   * from this thread with the share that is done; where it returns false, so does this, and the
   * basis stays as it was. The sine part is dropped, and counted as truncated, where its share of
   * the norm is at most sineTolerance.
   */
  bool Compute(vtkBRDF* brdf, double sineTolerance, const std::function<bool(double)>& progress);

  /// All terms, singular values descending.
  const std::vector<Term>& GetTerms() const { return this->Terms; }

  /// How many leading terms leave out at most `tolerance` of the norm within so many functions.
  int FindNumberOfTerms(double tolerance, int maximumNumberOfFunctions) const;

  /// Relative L2 error of the first `count` terms at the nodes.
  double GetTruncationError(int count) const;

  /// Functions of i in the first `count` terms.
  int GetNumberOfFunctions(int count) const;

  /// Share of the norm in the sine part.
  double GetSineShare() const { return this->SineShare; }

private:
  std::vector<Term> Terms;
  std::vector<double> Discarded; // energy left out by the first k terms
  double Energy = 0.0;
  double SineShare = 0.0;
};
} // namespace measuredbrdf

#endif
