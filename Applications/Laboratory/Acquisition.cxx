// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Acquisition.h"

#include "BasisFunctions.h"
#include "HalfVector.h" // for angles
#include "LocalFrame.h"
#include "ParallelFor.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace laboratory
{
namespace
{
using measuredbrdf::BasisFunctions;
using measuredbrdf::Pi;
using measuredbrdf::ToRadians;

// Directions of the projector's light: Gauss nodes in the cosine, equidistant azimuths.
constexpr int NumberOfNodes = 48;
constexpr int LeastAzimuths = 96;

struct Projector
{
  Projector(const BasisFunctions& functions, int azimuths)
    : NumberOfAzimuths(azimuths)
    , Patterns(functions.GetNumberOfFunctions(), NumberOfNodes * azimuths)
  {
    const measuredbrdf::Quadrature rule = measuredbrdf::GaussLegendre(NumberOfNodes);
    const double height = functions.GetNear() - functions.GetFar();
    for (int q = 0; q < NumberOfNodes; ++q)
    {
      const double cosine = functions.GetFar() + 0.5 * (rule.Nodes[q] + 1.0) * height;
      this->Cosines.push_back(cosine);
      this->Weights.push_back(rule.Weights[q] * 0.5 * height * 2.0 * Pi / azimuths * cosine);
      for (int a = 0; a < azimuths; ++a)
      {
        functions.Evaluate(cosine, 2.0 * Pi * a / azimuths, &this->Patterns(0, q * azimuths + a));
      }
    }
  }

  int NumberOfAzimuths;
  std::vector<double> Cosines;
  std::vector<double> Weights; // cos(theta) d omega of a light
  Eigen::MatrixXd Patterns;    // basis functions x lights
};

// What each light adds to each pixel and channel. Of an isotropic sample, the pixels of azimuth 0
// see what all others see of turned lights.
Eigen::MatrixXf FindResponses(vtkBRDF* sample, const Projector& projector,
  const AcquisitionOptions& options, const double zone[2], const Progress& show)
{
  const int azimuths = projector.NumberOfAzimuths;
  const int nPhi = options.NumberOfPhi;
  const int turn = azimuths / nPhi; // lights between two of the camera's azimuths
  const bool isotropic = sample->IsIsotropic();
  Eigen::MatrixXf responses(projector.Patterns.cols(), 3 * options.NumberOfTheta * nPhi);
  for (int t = 0; t < options.NumberOfTheta; ++t)
  {
    const double theta =
      ToRadians(zone[0] + (zone[1] - zone[0]) * t / (options.NumberOfTheta - 1.0));
    measuredbrdf::ParallelFor(0, NumberOfNodes, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType light = begin * azimuths; light < end * azimuths; ++light)
        {
          const vtkIdType q = light / azimuths, a = light % azimuths;
          const glm::dvec3 i =
            measuredbrdf::ToDirection(projector.Cosines[q], 2.0 * Pi * a / azimuths);
          for (int p = 0; p < (isotropic ? 1 : nPhi); ++p)
          {
            const glm::dvec3 o = measuredbrdf::LiftView(
              measuredbrdf::ToDirection(std::cos(theta), 2.0 * Pi * p / nPhi));
            double f[3];
            sample->Evaluate(&i.x, &o.x, f);
            const Eigen::Vector3f response =
              (projector.Weights[q] * Eigen::Map<Eigen::Vector3d>(f)).cast<float>();
            for (int other = p; other < (isotropic ? nPhi : p + 1); ++other)
            {
              responses.row(q * azimuths + (a + (other - p) * turn) % azimuths)
                .segment<3>(3 * (t * nPhi + other)) = response;
            }
          }
        }
      });
    show(0.5 * (t + 1) / options.NumberOfTheta);
  }
  return responses;
}

class Camera
{
public:
  explicit Camera(const AcquisitionOptions& options)
    : Noise(options.Noise)
    , Levels(options.Bits > 0 ? std::exp2(options.Bits) - 1.0 : 0.0)
    , Random(options.Seed)
  {
  }

  // What it makes of an image whose exposure is set to `full`.
  void Expose(Eigen::VectorXd& image, double full)
  {
    for (Eigen::Index k = 0; k < image.size() && full > 0.0; ++k)
    {
      double v = image[k] / full + (this->Noise > 0.0 ? this->Noise * this->GetNormal() : 0.0);
      if (this->Levels > 0.0)
      {
        v = std::round(std::clamp(v, 0.0, 1.0) * this->Levels) / this->Levels;
      }
      image[k] = v * full;
    }
  }

private:
  // Box, Muller 1958: the engine's bits are fixed by the standard, its distributions are not.
  double GetNormal()
  {
    const double u = (static_cast<double>(this->Random()) + 0.5) * 0x1p-32;
    const double v = (static_cast<double>(this->Random()) + 0.5) * 0x1p-32;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * Pi * v);
  }

  double Noise;
  double Levels;
  std::mt19937 Random;
};
}

//------------------------------------------------------------------------------
Acquisition Acquire(vtkBRDF* sample, const AcquisitionOptions& options, const Progress& show)
{
  sample->Prepare();
  const bool hemispherical = options.Basis == vtkBasisBRDF::HEMISPHERICAL;
  const double zone[2] = { hemispherical ? 0.0 : options.Zone[0],
    hemispherical ? 90.0 : options.Zone[1] };
  const BasisFunctions functions(options.Basis == vtkBasisBRDF::LEGENDRE_FOURIER, options.Order,
    std::cos(ToRadians(zone[0])), std::cos(ToRadians(zone[1])));
  const int nPhi = options.NumberOfPhi;
  const Projector projector(functions, (LeastAzimuths + nPhi - 1) / nPhi * nPhi);
  const Eigen::MatrixXf responses = FindResponses(sample, projector, options, zone, show);

  Acquisition result;
  Camera camera(options);
  std::vector<Eigen::VectorXd> stack;
  for (int k = 0; k < functions.GetNumberOfFunctions(); ++k)
  {
    const Eigen::VectorXf pattern = projector.Patterns.row(k).cast<float>();
    Eigen::VectorXd positive = (responses.transpose() * pattern.cwiseMax(0.0f)).cast<double>();
    Eigen::VectorXd negative = Eigen::VectorXd::Zero(positive.size());
    const bool hasNegative = pattern.minCoeff() < 0.0f;
    if (hasNegative)
    {
      negative = (responses.transpose() * (-pattern).cwiseMax(0.0f)).cast<double>();
    }
    const double full = std::max(positive.maxCoeff(), negative.maxCoeff());
    camera.Expose(positive, full);
    if (hasNegative)
    {
      camera.Expose(negative, full);
    }
    result.NumberOfPhotographs += hasNegative ? 2 : 1;
    stack.push_back(positive - negative);
    show(0.5 + 0.5 * (k + 1.0) / functions.GetNumberOfFunctions());
  }

  // Coefficients of an isotropic sample are averaged over the camera's azimuths, each turned back
  // by its own: (c_m, c_-m) -> R(m phi) (c_m, c_-m).
  const bool isotropic = sample->IsIsotropic();
  std::vector<float> coefficients;
  for (int l = 0; l <= options.Order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      const Eigen::VectorXd& same = stack[BasisFunctions::Index(l, m)];
      const Eigen::VectorXd& other = stack[BasisFunctions::Index(l, -m)];
      for (int t = 0; t < options.NumberOfTheta; ++t)
      {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (int p = 0; p < nPhi; ++p)
        {
          const Eigen::Index pixel = 3 * (t * nPhi + p);
          const double angle = 2.0 * Pi * m * p / nPhi;
          mean +=
            (std::cos(angle) * same.segment<3>(pixel) + std::sin(angle) * other.segment<3>(pixel)) /
            nPhi;
          if (!isotropic)
          {
            const Eigen::Vector3d own = same.segment<3>(pixel);
            coefficients.insert(coefficients.end(), own.begin(), own.end());
          }
        }
        if (isotropic)
        {
          coefficients.insert(coefficients.end(), mean.begin(), mean.end());
        }
      }
    }
  }
  result.Stack = vtkSmartPointer<vtkBasisBRDF>::New();
  const std::string problem = result.Stack->SetCoefficients(options.Basis, options.Order, zone,
    zone, options.NumberOfTheta, isotropic ? 1 : nPhi, std::move(coefficients));
  if (!problem.empty())
  {
    throw std::runtime_error("the acquisition of " + sample->GetName() + ": " + problem);
  }
  result.Stack->SetIncidentCosine(true);
  result.Stack->SetName(sample->GetName());
  result.Stack->SetSource(
    "simulated acquisition" + (sample->GetSource().empty() ? "" : " of: " + sample->GetSource()));
  return result;
}
} // namespace laboratory
