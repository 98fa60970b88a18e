// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBTDF.h"

#include "HalfVector.h"
#include "LocalFrame.h"
#include "LowDiscrepancy.h"
#include "vtkObjectFactory.h"

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/component_wise.hpp>

#include <algorithm>
#include <cstdint>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkBTDF);

namespace
{
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
  overView ? values.Folded->GetDirectionalReflectance(fixed, rgb)
           : values.Folded->GetDirectionalAlbedo(fixed, rgb);
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
    difference += glm::compAdd(glm::abs(f - exchanged));
    sum += glm::compAdd(f);
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
