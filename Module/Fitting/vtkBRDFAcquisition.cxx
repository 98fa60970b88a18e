// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBRDFAcquisition.h"

#include "BasisFunctions.h"
#include "HalfVector.h" // for angles
#include "LocalFrame.h"
#include "ParallelFor.h"
#include "Setters.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBRDFAcquisition);

namespace
{
// Directions of the projector's light: Gauss nodes in the cosine, equidistant azimuths. Azimuths
// are a multiple of the camera's, so that an isotropic sample need only be evaluated once per
// polar angle.
constexpr int NumberOfNodes = 48;
constexpr int SmallestNumberOfAzimuths = 96;
constexpr std::size_t MaximumBytes = std::size_t(1) << 30; // of the table of responses

int GetNumberOfAzimuths(int pixels)
{
  return (SmallestNumberOfAzimuths + pixels - 1) / pixels * pixels;
}

// The projector: light number q * NumberOfAzimuths + a, and the patterns it shows.
struct Projector
{
  int NumberOfAzimuths = 0;
  int NumberOfLights = 0;
  std::vector<double> Cosines;               // of node q
  std::vector<double> Weights;               // cos(theta) d omega of a light of node q
  std::vector<std::vector<double>> Patterns; // basis values: [k][light]

  glm::dvec3 GetDirection(int light) const
  {
    return ToDirection(this->Cosines[light / this->NumberOfAzimuths],
      2.0 * Pi * (light % this->NumberOfAzimuths) / this->NumberOfAzimuths);
  }
};

Projector MakeProjector(const BasisFunctions& functions, int azimuths)
{
  const int count = functions.GetNumberOfFunctions();
  Projector projector;
  projector.NumberOfAzimuths = azimuths;
  projector.NumberOfLights = NumberOfNodes * azimuths;
  projector.Patterns.assign(static_cast<std::size_t>(count),
    std::vector<double>(static_cast<std::size_t>(projector.NumberOfLights)));
  const Quadrature rule = GaussLegendre(NumberOfNodes);
  std::vector<double> values(static_cast<std::size_t>(count));
  for (int q = 0; q < NumberOfNodes; ++q)
  {
    const double height = functions.GetNear() - functions.GetFar();
    const double cosine = functions.GetFar() + 0.5 * (rule.Nodes[q] + 1.0) * height;
    projector.Cosines.push_back(cosine);
    projector.Weights.push_back(rule.Weights[q] * 0.5 * height * 2.0 * Pi / azimuths * cosine);
    for (int a = 0; a < azimuths; ++a)
    {
      functions.Evaluate(cosine, 2.0 * Pi * a / azimuths, values.data());
      for (int k = 0; k < count; ++k)
      {
        projector.Patterns[k][static_cast<std::size_t>(q * azimuths + a)] = values[k];
      }
    }
  }
  return projector;
}

// Where the camera's pixels look from.
struct Pixels
{
  int NumberOfTheta;
  int NumberOfPhi;
  double Zone[2]; // degrees
  bool Isotropic; // the sample is

  // An isotropic sample is looked at from azimuth 0 only.
  int GetNumberOfViews() const
  {
    return this->Isotropic ? this->NumberOfTheta : this->NumberOfTheta * this->NumberOfPhi;
  }

  glm::dvec3 GetDirection(int view) const
  {
    const int t = this->Isotropic ? view : view / this->NumberOfPhi;
    const int p = this->Isotropic ? 0 : view % this->NumberOfPhi;
    const double theta =
      ToRadians(this->Zone[0] + (this->Zone[1] - this->Zone[0]) * t / (this->NumberOfTheta - 1.0));
    return LiftView(ToDirection(std::cos(theta), 2.0 * Pi * p / this->NumberOfPhi));
  }
};

// Light of each direction towards one view.
void ComputeResponses(vtkBRDF* input, const Projector& projector, const Pixels& pixels, int view,
  Eigen::MatrixXf& responses)
{
  const glm::dvec3 o = pixels.GetDirection(view);
  for (int light = 0; light < projector.NumberOfLights; ++light)
  {
    const glm::dvec3 i = projector.GetDirection(light);
    const double weight = projector.Weights[light / projector.NumberOfAzimuths];
    double f[3];
    input->Evaluate(&i.x, &o.x, f);
    for (int c = 0; c < 3; ++c)
    {
      responses(light, 3 * view + c) = static_cast<float>(f[c] * weight);
    }
  }
}

// Camera images of one pattern: [theta][phi][channel].
using Photograph = std::vector<double>;

// What the camera makes of an image whose exposure is set to `full`.
class Camera
{
public:
  Camera(double noise, int bits, unsigned int seed)
    : Noise(noise)
    , Levels(bits > 0 ? std::exp2(bits) - 1.0 : 0.0)
    , Random(seed)
  {
  }

  void Expose(Photograph& image, double full)
  {
    if ((this->Noise == 0.0 && this->Levels == 0.0) || !(full > 0.0))
    {
      return;
    }
    for (double& value : image)
    {
      double v = value / full + (this->Noise > 0.0 ? this->Noise * this->GetNormal() : 0.0);
      if (this->Levels > 0.0)
      {
        v = std::round(std::clamp(v, 0.0, 1.0) * this->Levels) / this->Levels;
      }
      value = v * full;
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

// A photograph of the sample under the pattern max(sign B_k, 0). An isotropic sample at camera
// azimuth p sees the pattern turned by it: one column each.
Photograph TakePhotograph(const Eigen::MatrixXf& responses, const Projector& projector,
  const Pixels& pixels, int k, double sign)
{
  const int azimuths = projector.NumberOfAzimuths;
  const int turn = azimuths / pixels.NumberOfPhi; // per camera azimuth
  Eigen::MatrixXf pattern(projector.NumberOfLights, pixels.Isotropic ? pixels.NumberOfPhi : 1);
  for (int p = 0; p < pattern.cols(); ++p)
  {
    for (int light = 0; light < projector.NumberOfLights; ++light)
    {
      const int at = light - light % azimuths + (light + p * turn) % azimuths;
      pattern(light, p) = static_cast<float>(std::max(sign * projector.Patterns[k][at], 0.0));
    }
  }
  const Eigen::MatrixXf product = responses.transpose() * pattern;
  Photograph image;
  for (int t = 0; t < pixels.NumberOfTheta; ++t)
  {
    for (int p = 0; p < pixels.NumberOfPhi; ++p)
    {
      for (int c = 0; c < 3; ++c)
      {
        image.push_back(pixels.Isotropic ? product(3 * t + c, p)
                                         : product(3 * (t * pixels.NumberOfPhi + p) + c, 0));
      }
    }
  }
  return image;
}

// What the camera records of B_k: one photograph, or the difference of two where B_k has a negative
// part. Counts them.
Photograph Record(const Eigen::MatrixXf& responses, const Projector& projector,
  const Pixels& pixels, int k, Camera& camera, int& photographs)
{
  const std::vector<double>& pattern = projector.Patterns[k];
  Photograph positive = TakePhotograph(responses, projector, pixels, k, 1.0);
  double full = *std::max_element(positive.begin(), positive.end());
  const bool signedPattern =
    std::any_of(pattern.begin(), pattern.end(), [](double value) { return value < 0.0; });
  Photograph negative;
  if (signedPattern)
  {
    negative = TakePhotograph(responses, projector, pixels, k, -1.0);
    full = std::max(full, *std::max_element(negative.begin(), negative.end()));
    camera.Expose(negative, full);
  }
  camera.Expose(positive, full);
  photographs += signedPattern ? 2 : 1;
  for (std::size_t pixel = 0; pixel < negative.size(); ++pixel)
  {
    positive[pixel] -= negative[pixel];
  }
  return positive;
}

// The recorded images as coefficients. Those of an isotropic sample are averaged over the camera's
// azimuths, each turned back by its own: (c_m, c_-m) -> R(m phi) (c_m, c_-m).
std::vector<float> ToCoefficients(
  const std::vector<Photograph>& stack, const Pixels& pixels, int order)
{
  const int nTheta = pixels.NumberOfTheta;
  const int nPhi = pixels.NumberOfPhi;
  const int outPhi = pixels.Isotropic ? 1 : nPhi;
  std::vector<float> coefficients(3 * stack.size() * static_cast<std::size_t>(nTheta * outPhi));
  for (int l = 0; l <= order; ++l)
  {
    for (int m = -l; m <= l; ++m)
    {
      const int k = BasisFunctions::Index(l, m);
      const Photograph& same = stack[static_cast<std::size_t>(k)];
      const Photograph& other = stack[static_cast<std::size_t>(BasisFunctions::Index(l, -m))];
      for (int t = 0; t < nTheta; ++t)
      {
        for (int c = 0; c < 3; ++c)
        {
          const auto at = [&](const Photograph& image, int p) {
            return image[3 * static_cast<std::size_t>(t * nPhi + p) + static_cast<std::size_t>(c)];
          };
          const auto store = [&](int p, double value)
          {
            coefficients[3 * static_cast<std::size_t>((k * nTheta + t) * outPhi + p) +
                         static_cast<std::size_t>(c)] = static_cast<float>(value);
          };
          if (!pixels.Isotropic)
          {
            for (int p = 0; p < nPhi; ++p)
            {
              store(p, at(same, p));
            }
            continue;
          }
          double sum = 0.0;
          for (int p = 0; p < nPhi; ++p)
          {
            const double angle = 2.0 * Pi * m * p / nPhi;
            sum += std::cos(angle) * at(same, p) + (m != 0 ? std::sin(angle) * at(other, p) : 0.0);
          }
          store(0, sum / nPhi);
        }
      }
    }
  }
  return coefficients;
}
}

//------------------------------------------------------------------------------
void vtkBRDFAcquisition::SetInput(vtkBRDF* input)
{
  if (this->Input != input)
  {
    this->Input = input;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
std::string vtkBRDFAcquisition::FindProblem() const
{
  if (!this->Input)
  {
    return "no input";
  }
  const std::size_t bytes = 3 * sizeof(float) * NumberOfNodes *
                            static_cast<std::size_t>(GetNumberOfAzimuths(this->NumberOfPhi)) *
                            static_cast<std::size_t>(this->NumberOfTheta) *
                            (this->Input->IsIsotropic() ? 1 : this->NumberOfPhi);
  if (bytes > MaximumBytes)
  {
    return std::to_string(this->NumberOfTheta) + " x " + std::to_string(this->NumberOfPhi) +
           " pixels need " + std::to_string(bytes >> 20) + " MiB, expected at most " +
           std::to_string(MaximumBytes >> 20);
  }
  return "";
}

//------------------------------------------------------------------------------
bool vtkBRDFAcquisition::Acquire()
{
  const std::string problem = this->FindProblem();
  if (!problem.empty())
  {
    vtkErrorMacro("Acquire: " << problem << ".");
    return false;
  }
  this->Abort = false;
  vtkBRDF* input = this->Input;
  input->Prepare();
  const bool hemispherical = this->Basis == vtkBasisBRDF::HEMISPHERICAL;
  const double zone[2] = { hemispherical ? 0.0 : this->Zone[0],
    hemispherical ? 90.0 : this->Zone[1] };
  const BasisFunctions functions(this->Basis == vtkBasisBRDF::LEGENDRE_FOURIER, this->Order,
    std::cos(ToRadians(zone[0])), std::cos(ToRadians(zone[1])));
  const Pixels pixels = { this->NumberOfTheta, this->NumberOfPhi, { zone[0], zone[1] },
    input->IsIsotropic() };
  const Projector projector = MakeProjector(functions, GetNumberOfAzimuths(this->NumberOfPhi));

  // Half of the progress each. In batches, so that it and interruption happen on this thread.
  const auto report = [this](double progress)
  {
    this->InvokeEvent(vtkCommand::ProgressEvent, &progress);
    return !this->Abort;
  };
  const int views = pixels.GetNumberOfViews();
  Eigen::MatrixXf responses(projector.NumberOfLights, 3 * views);
  constexpr int batch = 16;
  for (int first = 0; first < views; first += batch)
  {
    const int last = std::min(first + batch, views);
    measuredbrdf::ParallelFor(first, last,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType view = begin; view < end; ++view)
        {
          ComputeResponses(input, projector, pixels, static_cast<int>(view), responses);
        }
      });
    if (!report(0.5 * last / views))
    {
      return false;
    }
  }

  const int count = functions.GetNumberOfFunctions();
  std::vector<Photograph> stack; // the isotropic average mixes (l, m) with (l, -m)
  Camera camera(this->Noise, this->Bits, this->Seed);
  int photographs = 0;
  for (int k = 0; k < count; ++k)
  {
    stack.push_back(Record(responses, projector, pixels, k, camera, photographs));
    if (!report(0.5 + 0.5 * (k + 1.0) / count))
    {
      return false;
    }
  }

  const auto output = vtkSmartPointer<vtkBasisBRDF>::New();
  const std::string refused =
    output->SetCoefficients(this->Basis, this->Order, zone, zone, this->NumberOfTheta,
      pixels.Isotropic ? 1 : this->NumberOfPhi, ToCoefficients(stack, pixels, this->Order));
  if (!refused.empty())
  {
    vtkErrorMacro("Acquire: " << refused << ".");
    return false;
  }
  output->SetIncidentCosine(true);
  output->SetName(input->GetName());
  output->SetSource(
    "simulated acquisition" + (input->GetSource().empty() ? "" : " of: " + input->GetSource()));
  this->Output = output;
  this->NumberOfPhotographs = photographs;
  return true;
}

//------------------------------------------------------------------------------
measuredbrdfSetClampedMacro(vtkBRDFAcquisition, NumberOfTheta, int, 2, 1024);
measuredbrdfSetClampedMacro(vtkBRDFAcquisition, NumberOfPhi, int, 1, 256);
measuredbrdfSetChecked2Macro(vtkBRDFAcquisition, Zone, vtkBasisBRDF::FindZoneProblem);
measuredbrdfSetInRangeMacro(
  vtkBRDFAcquisition, Basis, int, vtkBasisBRDF::HEMISPHERICAL, vtkBasisBRDF::LEGENDRE_FOURIER);
measuredbrdfSetInRangeMacro(vtkBRDFAcquisition, Order, int, 1, vtkBasisBRDF::MaximumOrder);
measuredbrdfSetInRangeMacro(vtkBRDFAcquisition, Noise, double, 0.0, VTK_DOUBLE_MAX);
measuredbrdfSetInRangeMacro(vtkBRDFAcquisition, Bits, int, 0, 24);

//------------------------------------------------------------------------------
void vtkBRDFAcquisition::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Input: " << this->Input.Get() << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
  os << indent << "Basis: " << vtkBasisBRDF::GetBasisName(this->Basis) << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Zone: " << this->Zone[0] << " " << this->Zone[1] << "\n";
  os << indent << "Noise: " << this->Noise << "\n";
  os << indent << "Bits: " << this->Bits << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "NumberOfTheta: " << this->NumberOfTheta << "\n";
  os << indent << "NumberOfPhi: " << this->NumberOfPhi << "\n";
  os << indent << "NumberOfPhotographs: " << this->NumberOfPhotographs << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
}
