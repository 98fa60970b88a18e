// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MaterialExchange.h"

#include "ArchiveFields.h"
#include "Printable.h"
#include "vtkAdaptiveWarpBRDF.h"
#include "vtkAshikhminShirleyBRDF.h"
#include "vtkBasisBRDF.h"
#include "vtkBlinnPhongBRDF.h"
#include "vtkCallbackCommand.h"
#include "vtkDistributionBRDF.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkSumBRDF.h"
#include "vtkTabulatedBRDF.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace measuredbrdf
{
namespace
{
constexpr int MaximumDepth = 16; // of sums in sums

// Keeps a material from complaining on its own: an ArchiveLoader says what is wrong.
class Silence
{
public:
  explicit Silence(vtkObject* object)
    : Object(object)
  {
    this->Tags[0] = object->AddObserver(vtkCommand::ErrorEvent, this->Command);
    this->Tags[1] = object->AddObserver(vtkCommand::WarningEvent, this->Command);
  }
  ~Silence()
  {
    this->Object->RemoveObserver(this->Tags[0]);
    this->Object->RemoveObserver(this->Tags[1]);
  }
  Silence(const Silence&) = delete;
  void operator=(const Silence&) = delete;

private:
  vtkNew<vtkCallbackCommand> Command; // does nothing
  vtkObject* Object;
  unsigned long Tags[2];
};

//------------------------------------------------------------------------------
// Functions Exchange name each member of a representation once, for a saver and a loader.

// A member of a material as an exchange argument: its getter and its setter.
#define NUMBER(member) \
  [&]() { return material->Get##member(); }, [&](double value) { material->Set##member(value); }
#define COLOR(member)                                     \
  [&](double value[3]) { material->Get##member(value); }, \
    [&](const double value[3]) { material->Set##member(value[0], value[1], value[2]); }
#define OPTION(member) \
  [&]() { return material->Get##member(); }, [&](int value) { material->Set##member(value); }

template <typename Exchanger>
void Exchange(Exchanger& x, vtkLambertBRDF* material)
{
  x.Color("albedo", COLOR(Albedo));
}

template <typename Exchanger>
void Exchange(Exchanger& x, vtkBlinnPhongBRDF* material)
{
  x.Color("specular", COLOR(Specular));
  x.Number("exponent", NUMBER(Exponent));
}

template <typename Exchanger>
void Exchange(Exchanger& x, vtkAshikhminShirleyBRDF* material)
{
  x.Color("specularScale", COLOR(SpecularScale));
  x.Color("reflectance", COLOR(Reflectance));
  x.Color("diffuse", COLOR(Diffuse));
  x.Number("exponentU", NUMBER(ExponentU));
  x.Number("exponentV", NUMBER(ExponentV));
  x.Option("fresnelModel", { "schlick", "dielectric" }, OPTION(FresnelModel));
  x.Number("indexOfRefraction", NUMBER(IndexOfRefraction));
}

//------------------------------------------------------------------------------
void Exchange(ArchiveSaver& x, vtkDistributionBRDF* material)
{
  x.Array("distribution",
    { material->GetNumberOfPhiSamples(), material->GetNumberOfThetaSamples() }, 3,
    material->GetDistribution());
  x.Array(
    "fresnel", { static_cast<int>(material->GetFresnel().size() / 3) }, 3, material->GetFresnel());
}

void Exchange(ArchiveLoader& x, vtkDistributionBRDF* material)
{
  const auto distribution = x.TakeArray("distribution", 2, 3);
  const auto fresnel = x.TakeArray("fresnel", 1, 3);
  if (!material->SetDistribution(distribution.Shape[1], distribution.Shape[0], distribution.Values))
  {
    x.Fail("array 'distribution' was refused: negative or not finite");
  }
  if (!material->SetFresnel(fresnel.Shape[0], fresnel.Values))
  {
    x.Fail("array 'fresnel' was refused: negative or not finite");
  }
}

//------------------------------------------------------------------------------
const std::vector<std::string> Parameterizations = { "half-difference", "incident-outgoing" };
const std::vector<std::string> AzimuthRanges = { "half-turn", "full-turn" };

template <typename Exchanger>
void ExchangeSettings(Exchanger& x, vtkTabulatedBRDF* material)
{
  x.Option("precision", { "automatic", "float16", "float32" }, OPTION(Precision));
  x.Option("cosineWeighted", { "off", "on" }, OPTION(CosineWeighted));
  x.Number("resamplingError", NUMBER(ResamplingError));
}

void Exchange(ArchiveSaver& x, vtkTabulatedBRDF* material)
{
  ExchangeSettings(x, material);
  const auto ignore = [](int) {};
  x.Option(
    "parameterization", Parameterizations, [&] { return material->GetParameterization(); }, ignore);
  x.Option(
    "azimuthRange", AzimuthRanges, [&] { return material->GetAzimuthRange(); }, ignore);
  const int* size = material->GetDimensions();
  x.Array("volume", { size[2], size[1], size[0] }, 3, material->GetVolume());
}

void Exchange(ArchiveLoader& x, vtkTabulatedBRDF* material)
{
  ExchangeSettings(x, material);
  const auto ignore = [] { return 0; };
  int parameterization = 0;
  int azimuthRange = 0;
  x.Option("parameterization", Parameterizations, ignore, [&](int k) { parameterization = k; });
  x.Option("azimuthRange", AzimuthRanges, ignore, [&](int k) { azimuthRange = k; });
  auto volume = x.TakeArray("volume", 3, 3);
  const int dimensions[3] = { volume.Shape[2], volume.Shape[1], volume.Shape[0] };
  if (!material->SetVolume(parameterization, azimuthRange, dimensions, std::move(volume.Values)))
  {
    x.Fail("array 'volume' was refused");
  }
}

//------------------------------------------------------------------------------
const std::vector<std::string> Bases = { "spherical-harmonics", "hemispherical", "zonal",
  "legendre-fourier" };

template <typename Exchanger>
void ExchangeSettings(Exchanger& x, vtkBasisBRDF* material)
{
  x.Option("incidentCosine", { "off", "on" }, OPTION(IncidentCosine));
  x.Option("outgoingCosine", { "off", "on" }, OPTION(OutgoingCosine));
  x.Number("resamplingError", NUMBER(ResamplingError));
}

void Exchange(ArchiveSaver& x, vtkBasisBRDF* material)
{
  ExchangeSettings(x, material);
  x.Option(
    "basis", Bases, [&] { return material->GetBasis(); }, [](int) {});
  const auto number = [&x](const char* name, double value)
  {
    x.Number(
      name, [value] { return value; }, [](double) {});
  };
  number("order", material->GetOrder());
  number("incidentBegin", material->GetIncidentZone()[0]);
  number("incidentEnd", material->GetIncidentZone()[1]);
  number("outgoingBegin", material->GetOutgoingZone()[0]);
  number("outgoingEnd", material->GetOutgoingZone()[1]);
  x.Array("coefficients",
    { material->GetNumberOfFunctions(), material->GetNumberOfTheta(), material->GetNumberOfPhi() },
    3, material->GetCoefficients());
}

void Exchange(ArchiveLoader& x, vtkBasisBRDF* material)
{
  ExchangeSettings(x, material);
  int basis = 0;
  x.Option(
    "basis", Bases, [] { return 0; }, [&](int k) { basis = k; });
  const auto number = [&x](const char* name)
  {
    double value = 0.0;
    x.Number(
      name, [&value] { return value; }, [&value](double v) { value = v; });
    return value;
  };
  const double order = number("order");
  const double incident[2] = { number("incidentBegin"), number("incidentEnd") };
  const double outgoing[2] = { number("outgoingBegin"), number("outgoingEnd") };
  auto coefficients = x.TakeArray("coefficients", 3, 3);
  const bool whole =
    order >= 0.0 && order <= vtkBasisBRDF::MaximumOrder && order == std::floor(order);
  if (!whole || coefficients.Shape[0] != static_cast<int>((order + 1.0) * (order + 1.0)))
  {
    x.Fail("number 'order' is " + ToText(order) + ", which does not suit " +
           std::to_string(coefficients.Shape[0]) + " basis functions");
  }
  const std::string problem = material->SetCoefficients(basis, static_cast<int>(order), incident,
    outgoing, coefficients.Shape[1], coefficients.Shape[2], std::move(coefficients.Values));
  if (!problem.empty())
  {
    x.Fail(problem);
  }
}

//------------------------------------------------------------------------------
void Exchange(ArchiveSaver& x, vtkAdaptiveWarpBRDF* material)
{
  const vtkAdaptiveWarpBRDF::Tables& tables = material->GetTables();
  x.Option(
    "jacobian", { "off", "on" }, [&] { return tables.Jacobian ? 1 : 0; }, [](int) {});
  x.Array("thetaI", { static_cast<int>(tables.ThetaI.size()) }, 1, tables.ThetaI);
  x.Array("phiI", { static_cast<int>(tables.PhiI.size()) }, 1, tables.PhiI);
  x.Array("ndf", tables.Ndf.Shape, 1, tables.Ndf.Values);
  x.Array("sigma", tables.Sigma.Shape, 1, tables.Sigma.Values);
  x.Array("vndf", tables.Vndf.Shape, 1, tables.Vndf.Values);
  x.Array("luminance", tables.Luminance.Shape, 1, tables.Luminance.Values);
  x.Array("rgb", tables.Rgb.Shape, 1, tables.Rgb.Values);
}

void Exchange(ArchiveLoader& x, vtkAdaptiveWarpBRDF* material)
{
  const auto table = [&](const std::string& name, std::size_t rank)
  {
    auto array = x.TakeArray(name, rank, 1);
    return vtkAdaptiveWarpBRDF::Table{ std::move(array.Shape), std::move(array.Values) };
  };
  vtkAdaptiveWarpBRDF::Tables tables;
  x.Option(
    "jacobian", { "off", "on" }, [] { return 0; }, [&](int k) { tables.Jacobian = k == 1; });
  tables.ThetaI = table("thetaI", 1).Values;
  tables.PhiI = table("phiI", 1).Values;
  tables.Ndf = table("ndf", 2);
  tables.Sigma = table("sigma", 2);
  tables.Vndf = table("vndf", 4);
  tables.Luminance = table("luminance", 4);
  tables.Rgb = table("rgb", 5);
  const std::string problem = material->SetTables(std::move(tables));
  if (!problem.empty())
  {
    x.Fail("tables: " + problem);
  }
}

//------------------------------------------------------------------------------
MaterialArchive Save(vtkBRDF* brdf, int depth);
vtkSmartPointer<vtkBRDF> Load(MaterialArchive& archive, int depth);

template <typename Material>
bool SaveAs(const char* representation, vtkBRDF* brdf, MaterialArchive& archive)
{
  Material* material = Material::SafeDownCast(brdf);
  if (!material)
  {
    return false;
  }
  archive.Representation = representation;
  ArchiveSaver saver(archive);
  Exchange(saver, material);
  return true;
}

template <typename Material>
vtkSmartPointer<vtkBRDF> LoadAs(const char* representation, MaterialArchive& archive)
{
  if (archive.Representation != representation)
  {
    return nullptr;
  }
  auto material = vtkSmartPointer<Material>::New();
  const Silence silence(material);
  ArchiveLoader loader(archive);
  Exchange(loader, material.Get());
  return material;
}

//------------------------------------------------------------------------------
MaterialArchive Save(vtkBRDF* brdf, int depth)
{
  if (!brdf)
  {
    throw std::runtime_error("there is no material");
  }
  if (depth > MaximumDepth)
  {
    throw std::runtime_error("sums are nested too deeply");
  }
  MaterialArchive archive;
  if (vtkSumBRDF* sum = vtkSumBRDF::SafeDownCast(brdf))
  {
    archive.Representation = "Sum";
    for (int k = 0; k < sum->GetNumberOfTerms(); ++k)
    {
      archive.Terms.push_back(Save(sum->GetTerm(k), depth + 1));
    }
  }
  else if (!SaveAs<vtkLambertBRDF>("Lambert", brdf, archive) &&
           !SaveAs<vtkBlinnPhongBRDF>("BlinnPhong", brdf, archive) &&
           !SaveAs<vtkAshikhminShirleyBRDF>("AshikhminShirley", brdf, archive) &&
           !SaveAs<vtkDistributionBRDF>("Distribution", brdf, archive) &&
           !SaveAs<vtkTabulatedBRDF>("Tabulated", brdf, archive) &&
           !SaveAs<vtkBasisBRDF>("Basis", brdf, archive) &&
           !SaveAs<vtkAdaptiveWarpBRDF>("AdaptiveWarp", brdf, archive))
  {
    throw std::runtime_error(std::string(brdf->GetClassName()) + " has no form in this format");
  }
  archive.Name = brdf->GetName();
  archive.Source = brdf->GetSource();
  archive.Numbers["resamplingTolerance"] = { brdf->GetResamplingTolerance() };
  return archive;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> Load(MaterialArchive& archive, int depth)
{
  if (depth > MaximumDepth)
  {
    throw std::runtime_error("terms are nested too deeply");
  }
  vtkSmartPointer<vtkBRDF> material;
  if (archive.Representation == "Sum")
  {
    if (archive.Terms.size() > static_cast<std::size_t>(vtkSumBRDF::MaximumNumberOfTerms))
    {
      throw std::runtime_error("Sum: " + std::to_string(archive.Terms.size()) +
                               " terms, expected at most " +
                               std::to_string(vtkSumBRDF::MaximumNumberOfTerms));
    }
    auto sum = vtkSmartPointer<vtkSumBRDF>::New();
    for (MaterialArchive& term : archive.Terms)
    {
      sum->AddTerm(Load(term, depth + 1));
    }
    material = sum;
  }
  else if (!(material = LoadAs<vtkLambertBRDF>("Lambert", archive)) &&
           !(material = LoadAs<vtkBlinnPhongBRDF>("BlinnPhong", archive)) &&
           !(material = LoadAs<vtkAshikhminShirleyBRDF>("AshikhminShirley", archive)) &&
           !(material = LoadAs<vtkDistributionBRDF>("Distribution", archive)) &&
           !(material = LoadAs<vtkTabulatedBRDF>("Tabulated", archive)) &&
           !(material = LoadAs<vtkBasisBRDF>("Basis", archive)) &&
           !(material = LoadAs<vtkAdaptiveWarpBRDF>("AdaptiveWarp", archive)))
  {
    throw std::runtime_error("unknown representation " + Quote(archive.Representation));
  }
  material->SetName(archive.Name);
  material->SetSource(archive.Source);
  const Silence silence(material);
  ArchiveLoader(archive).Number("resamplingTolerance", NUMBER(ResamplingTolerance));
  return material;
}
#undef NUMBER
#undef COLOR
#undef OPTION
}

//------------------------------------------------------------------------------
void CheckShape(const std::string& representation, const std::vector<int>& shape)
{
  if (representation != "Basis" || shape.size() != 3)
  {
    return; // tables are as large as the file at most; ranks are checked by name
  }
  const double values = 3.0 * shape[0] * shape[1] * shape[2];
  if (values > vtkBasisBRDF::MaximumNumberOfValues)
  {
    throw std::runtime_error("Basis: " + ToText(values) + " coefficients, expected at most " +
                             std::to_string(vtkBasisBRDF::MaximumNumberOfValues));
  }
}

//------------------------------------------------------------------------------
MaterialArchive ToArchive(vtkBRDF* brdf) { return Save(brdf, 0); }

//------------------------------------------------------------------------------
vtkSmartPointer<vtkBRDF> FromArchive(MaterialArchive archive) { return Load(archive, 0); }
} // namespace measuredbrdf
