// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBTDF.h"

#include "HalfVector.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "vtkAngleBasisBRDF.h"
#include "vtkObjectFactory.h"
#include "vtkTensorTreeBRDF.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBTDF);

namespace
{
constexpr int Rings = 256; // of the projected hemisphere, and parts of each
constexpr int Parts = 2048;
constexpr int Cells = 256; // along a side of a square: trees of genBSDF have 64 or 128
constexpr double Golden = 0.6180339887498949;
constexpr std::uint32_t Pairs = 1 << 16;

// The folded values for light on a side. Exchanged: light and view are, by reciprocity.
struct Values
{
  vtkBRDF* Folded;
  bool IsExchanged;
};

Values Find(vtkBRDF* same, vtkBRDF* other)
{
  return same ? Values{ same, false } : Values{ other, true };
}

// A direction with the projected solid angle that it stands for.
struct Node
{
  glm::dvec3 Direction;
  double Weight;
};

Node MakeNode(double sine, double phi, double weight)
{
  return { glm::dvec3(sine * std::cos(phi), sine * std::sin(phi),
             std::sqrt(std::max(1.0 - sine * sine, 0.0))),
    weight };
}

// The middle of each patch. Those of the view are where it is continued through the surface.
std::vector<Node> MakeNodes(const vtkAngleBasisBRDF::Basis& basis, bool isView)
{
  std::vector<Node> nodes;
  double lower = 0.0;
  for (std::size_t ring = 0; ring < basis.Patches.size(); ++ring)
  {
    const double upper = basis.UpperTheta[ring] * Pi / 180.0;
    const double inner = std::sin(lower);
    const double outer = std::sin(upper);
    const int count = basis.Patches[ring];
    for (int k = 0; k < count; ++k)
    {
      nodes.push_back(MakeNode(std::sin(0.5 * (lower + upper)),
        2.0 * Pi * k / count + (isView ? Pi : 0.0), Pi * (outer * outer - inner * inner) / count));
    }
    lower = upper;
  }
  return nodes;
}

std::vector<Node> MakeRingNodes()
{
  std::vector<Node> nodes;
  for (int ring = 0; ring < Rings; ++ring)
  {
    const double sine = (ring + 0.5) / Rings;
    for (int part = 0; part < Parts; ++part)
    {
      // Turned from ring to ring, so that narrow cells are met evenly.
      const double phi = 2.0 * Pi * (part + Golden * ring) / Parts;
      nodes.push_back(MakeNode(sine, phi, 2.0 * Pi * sine / (Rings * Parts)));
    }
  }
  return nodes;
}

// The cells of a tree over the disk (Shirley, Chiu 1997): each has the same area. Its values are
// constant in them.
std::vector<Node> MakeSquareNodes()
{
  std::vector<Node> nodes;
  for (int row = 0; row < Cells; ++row)
  {
    for (int column = 0; column < Cells; ++column)
    {
      const double a = 2.0 * (column + 0.5) / Cells - 1.0;
      const double b = 2.0 * (row + 0.5) / Cells - 1.0;
      const bool flat = std::abs(a) > std::abs(b);
      const double radius = flat ? a : b;
      const double phi = 0.25 * Pi * (flat ? b / a : 2.0 - a / b);
      nodes.push_back(MakeNode(radius, phi, Pi / (Cells * Cells)));
    }
  }
  return nodes;
}

// What the sum goes over: the view, or the light, of the folded values. bases: room for the nodes
// of a matrix; the others are made once.
const std::vector<Node>& GetNodes(vtkBRDF* folded, bool isView, std::vector<Node>& bases)
{
  if (auto* matrix = vtkAngleBasisBRDF::SafeDownCast(folded))
  {
    bases = MakeNodes(isView ? matrix->GetViewBasis() : matrix->GetLightBasis(), isView);
    return bases;
  }
  auto* tree = vtkTensorTreeBRDF::SafeDownCast(folded);
  if (tree && (tree->GetTree().Dimensions == 4 || !isView))
  {
    static const auto& square = *new std::vector<Node>(MakeSquareNodes()); // for threads, too
    return square;
  }
  static const auto& rings = *new std::vector<Node>(MakeRingNodes());
  return rings;
}

// Mirrored to the upper hemisphere; false at the horizon and for what is no direction.
bool Fold(const double in[3], double out[3])
{
  const double folded[3] = { in[0], in[1], std::abs(in[2]) };
  return ToUpperUnit(folded, out);
}
}

//------------------------------------------------------------------------------
void vtkBTDF::SetFolded(int side, vtkBRDF* folded)
{
  if (side != FRONT && side != BACK)
  {
    vtkErrorMacro("SetFolded: found side " << side << ", expected FRONT (0) or BACK (1).");
    return;
  }
  if (this->Folded[side] != folded)
  {
    this->Folded[side] = folded;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkBRDF* vtkBTDF::GetFolded(int side)
{
  return side == FRONT || side == BACK ? this->Folded[side].Get() : nullptr;
}

//------------------------------------------------------------------------------
void vtkBTDF::Prepare()
{
  for (const auto& folded : this->Folded)
  {
    if (folded)
    {
      folded->Prepare();
    }
  }
}

//------------------------------------------------------------------------------
void vtkBTDF::Evaluate(const double i[3], const double o[3], double f[3])
{
  std::fill_n(f, 3, 0.0);
  double light[3];
  double view[3];
  if ((i[2] > 0.0) == (o[2] > 0.0) || !Fold(i, light) || !Fold(o, view))
  {
    return;
  }
  const int side = i[2] > 0.0 ? FRONT : BACK;
  const Values values = Find(this->Folded[side], this->Folded[1 - side]);
  if (values.Folded)
  {
    values.Folded->Evaluate(
      values.IsExchanged ? view : light, values.IsExchanged ? light : view, f);
  }
}

//------------------------------------------------------------------------------
// Over the directions on the other side: the view's where isLight is true, else the light's.
void vtkBTDF::Integrate(const double direction[3], bool isLight, double rgb[3])
{
  std::fill_n(rgb, 3, 0.0);
  double fixed[3];
  if (!Fold(direction, fixed))
  {
    return;
  }
  const int side = (direction[2] > 0.0) == isLight ? FRONT : BACK; // on which light falls
  const Values values = Find(this->Folded[side], this->Folded[1 - side]);
  if (!values.Folded)
  {
    return;
  }
  const bool overView = isLight != values.IsExchanged; // of the folded values
  if (values.Folded
        ->IsIsotropic()) // any azimuth will do: the one where a tree's cells are straight
  {
    fixed[0] = -std::hypot(fixed[0], fixed[1]);
    fixed[1] = 0.0;
  }
  std::vector<Node> bases;
  for (const Node& node : GetNodes(values.Folded, overView, bases))
  {
    const double* moved = &node.Direction.x;
    double f[3];
    values.Folded->Evaluate(overView ? fixed : moved, overView ? moved : fixed, f);
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] += f[c] * node.Weight;
    }
  }
}

//------------------------------------------------------------------------------
void vtkBTDF::GetTransmittance(const double i[3], double rgb[3]) { this->Integrate(i, true, rgb); }

//------------------------------------------------------------------------------
void vtkBTDF::GetSkyTransmittance(const double o[3], double rgb[3])
{
  this->Integrate(o, false, rgb);
}

//------------------------------------------------------------------------------
bool vtkBTDF::IsIsotropic()
{
  return std::all_of(std::begin(this->Folded), std::end(this->Folded),
    [](const vtkSmartPointer<vtkBRDF>& folded) { return !folded || folded->IsIsotropic(); });
}

//------------------------------------------------------------------------------
double vtkBTDF::GetReciprocityError()
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::uint32_t k = 1; k <= Pairs; ++k)
  {
    glm::dvec3 i;
    glm::dvec3 o;
    SampleCosine(RadicalInverse(k, 2), RadicalInverse(k, 3), &i.x);
    SampleCosine(RadicalInverse(k, 5), RadicalInverse(k, 7), &o.x);
    o.z = -o.z;
    glm::dvec3 f;
    glm::dvec3 exchanged;
    this->Evaluate(&i.x, &o.x, &f.x);
    this->Evaluate(&o.x, &i.x, &exchanged.x);
    for (int c = 0; c < 3; ++c)
    {
      difference += std::abs(f[c] - exchanged[c]);
      sum += f[c];
    }
  }
  return sum > 0.0 ? difference / sum : 0.0;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkBTDF::GetMTime()
{
  vtkMTimeType latest = this->Superclass::GetMTime();
  for (const auto& folded : this->Folded)
  {
    latest = folded ? std::max(latest, folded->GetMTime()) : latest;
  }
  return latest;
}

//------------------------------------------------------------------------------
void vtkBTDF::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const int side : { FRONT, BACK })
  {
    os << indent << (side == FRONT ? "Front" : "Back") << ": " << this->Folded[side].Get() << "\n";
  }
}
