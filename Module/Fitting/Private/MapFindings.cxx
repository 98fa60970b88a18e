// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MapFindings.h"

#include "LinearLeastSquares.h"
#include "NumberText.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace measuredbrdf
{
namespace
{
constexpr double Alike = 1e-3;             // relative difference of materials that are the same
constexpr double UncertainWeight = 0.1;    // standard deviation that is reported
constexpr double PureWeight = 0.9;         // a found material should have it somewhere
constexpr double UsualBrightness = 0.05;   // deviation from 1 that needs no word
constexpr std::size_t MostLookalikes = 10; // that are listed

std::string FormatPercent(double share) { return NumberText(100.0 * share, 2) + " %"; }

//------------------------------------------------------------------------------
double GetDifference(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  const double size = std::max(a.norm(), b.norm());
  return size > 0.0 ? (a - b).norm() / size : 0.0;
}

//------------------------------------------------------------------------------
void FindLookalikes(
  const IdentityFacts& facts, const MapFitResult& result, std::vector<std::string>& findings)
{
  std::vector<std::string> pairs;
  for (Eigen::Index a = 0; a < facts.Values.cols(); ++a)
  {
    const std::string& name = result.Materials[static_cast<std::size_t>(a)].Material.Name;
    for (Eigen::Index b = a + 1; b < facts.Values.cols(); ++b)
    {
      const double difference = GetDifference(facts.Values.col(a), facts.Values.col(b));
      if (difference < Alike)
      {
        pairs.push_back("'" + name + "' and '" +
                        result.Materials[static_cast<std::size_t>(b)].Material.Name +
                        "' are the same in these photographs (difference " +
                        FormatPercent(difference) + "): only the sum of their weights is known");
      }
    }
    for (Eigen::Index b = 0; facts.Library && b < facts.LibraryValues.cols(); ++b)
    {
      const double difference = GetDifference(facts.Values.col(a), facts.LibraryValues.col(b));
      if (difference < Alike &&
          std::find(facts.Chosen.begin(), facts.Chosen.end(), b) == facts.Chosen.end())
      {
        pairs.push_back("'" + name + "' could as well be '" +
                        (*facts.Library)[static_cast<std::size_t>(b)].Name +
                        "': in these photographs they differ by " + FormatPercent(difference));
      }
    }
  }
  const std::size_t listed = std::min(pairs.size(), MostLookalikes);
  findings.insert(
    findings.end(), pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(listed));
  if (listed < pairs.size())
  {
    findings.push_back(
      "and " + std::to_string(pairs.size() - listed) + " more pairs of materials that look alike");
  }
}
}

//------------------------------------------------------------------------------
std::vector<double> GetWeightUncertainties(const IdentityFacts& facts)
{
  const SmallMatrix matrix = facts.Values.transpose() * facts.Values;
  const SmallVector variances = GetShareVariances(matrix);
  const double unknowns = static_cast<double>(facts.Values.cols() - 1) * facts.Texels;
  const double freedom = std::max(facts.Samples - unknowns, 1.0);
  std::vector<double> uncertainties;
  for (Eigen::Index k = 0; k < variances.size(); ++k)
  {
    uncertainties.push_back(std::isinf(variances[k])
                              ? std::numeric_limits<double>::infinity()
                              : std::sqrt(facts.Residual / freedom * variances[k]));
  }
  return uncertainties;
}

//------------------------------------------------------------------------------
std::vector<std::string> FindIdentityProblems(
  const IdentityFacts& facts, const MapFitResult& result)
{
  std::vector<std::string> findings;
  FindLookalikes(facts, result, findings);
  for (const MapMaterial& material : result.Materials)
  {
    TextStream text;
    text.precision(2);
    if (std::isinf(material.Uncertainty))
    {
      text << "the weights of '" << material.Material.Name
           << "' are not determined by these photographs";
    }
    else if (material.Uncertainty > UncertainWeight)
    {
      text << "the weights of '" << material.Material.Name << "' are uncertain by "
           << material.Uncertainty << " (standard deviation)";
    }
    if (!text.str().empty())
    {
      findings.push_back(text.str());
    }
    if (!facts.Library && material.LargestWeight < PureWeight)
    {
      TextStream pure;
      pure.precision(2);
      pure << "no place is of '" << material.Material.Name << "' alone (at most "
           << material.LargestWeight << "): what it looks like alone is extrapolated";
      findings.push_back(pure.str());
    }
  }
  if (std::abs(result.Brightness - 1.0) > UsualBrightness)
  {
    TextStream text;
    text.precision(3);
    text << "with all materials times " << result.Brightness
         << " the photographs would fit better: check irradiance and exposures, or the library "
            "lacks a material";
    findings.push_back(text.str());
  }
  return findings;
}
} // namespace measuredbrdf
