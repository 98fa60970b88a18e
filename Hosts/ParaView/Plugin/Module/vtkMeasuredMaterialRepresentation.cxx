// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeasuredMaterialRepresentation.h"
#include "vtkMath.h"

#include "MaterialFiles.h"

#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkCompositeMeasuredBRDFMapper.h"
#include "vtkDataAssembly.h"
#include "vtkDataAssemblyUtilities.h"
#include "vtkDataObjectTree.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMaterialMap.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkPolyDataNormals.h"
#include "vtkProcessModule.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace measuredmaterials;

vtkStandardNewMacro(vtkMeasuredMaterialRepresentation);

namespace
{
const char* const File = "File";
constexpr int Weights = 3; // modes of material maps: 0 none, 1 classes, 2 values
constexpr int Images = 4;
using Rows = std::vector<std::pair<std::string, std::string>>; // of the panel's tables

/// Gives surfaces without point normals some (vtkPolyDataNormals) and passes all others. Cell
/// normals do not count: ParaView makes some for all flat cells.
class MissingNormalsFilter : public vtkPolyDataAlgorithm
{
public:
  static MissingNormalsFilter* New();
  vtkTypeMacro(MissingNormalsFilter, vtkPolyDataAlgorithm);
  vtkSetMacro(Enabled, bool);
  vtkGetMacro(Enabled, bool);
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0); // in degrees: sharper edges stay sharp

protected:
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
    vtkPolyData* output = vtkPolyData::GetData(outputVector);
    const bool hasSurface = input->GetNumberOfPolys() > 0 || input->GetNumberOfStrips() > 0;
    if (!this->Enabled || !hasSurface || input->GetPointData()->GetNormals())
    {
      output->ShallowCopy(input);
      return 1;
    }
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(input);
    normals->SetFeatureAngle(this->FeatureAngle);
    normals->ConsistencyOff(); // what is one surface and what is its outside is the data's to say
    normals->Update();
    output->ShallowCopy(normals->GetOutput());
    return 1;
  }

  bool Enabled = true;
  double FeatureAngle = 30.0;
};
vtkStandardNewMacro(MissingNormalsFilter);

//------------------------------------------------------------------------------
// Flat indices of the blocks of each selector.
std::vector<std::vector<unsigned int>> GetIndices(vtkDataObject* data, const Rows& rows)
{
  std::vector<std::vector<unsigned int>> indices(rows.size());
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  vtkNew<vtkDataAssembly> hierarchy;
  if (!rows.empty() && blocks && vtkDataAssemblyUtilities::GenerateHierarchy(blocks, hierarchy))
  {
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
      indices[k] = vtkDataAssemblyUtilities::GetSelectedCompositeIds({ rows[k].first }, hierarchy);
    }
  }
  return indices;
}

//------------------------------------------------------------------------------
// Whether all surfaces have what a map reads: the array, or texture coordinates for images.
bool CanRead(vtkDataObject* data, int mode, const std::string& array)
{
  const auto surfaces = vtkCompositeDataSet::GetDataSets<vtkDataSet>(data);
  return data && std::all_of(surfaces.begin(), surfaces.end(),
                   [&](vtkDataSet* surface)
                   {
                     return surface->GetNumberOfCells() == 0 ||
                            (mode == Images ? surface->GetPointData()->GetTCoords() != nullptr
                                            : surface->GetPointData()->HasArray(array.c_str()) ||
                                                surface->GetCellData()->HasArray(array.c_str()));
                   });
}

//------------------------------------------------------------------------------
std::string ToText(const char* text) { return text ? text : ""; }

//------------------------------------------------------------------------------
// Turns an environment by an angle about one of the world's axes, which points up, on top of the
// rotation that the original has of its own.
void Turn(vtkEnvironment* turned, vtkEnvironment* original, double degrees, int upAxis)
{
  // Rows: the environment's axes in world coordinates; its y points up.
  const double axes[3][3][3] = { { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },
    { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } } };
  const double angle = vtkMath::RadiansFromDegrees(degrees); // as vtkEnvironment::SetRotationY
  const double turn[3][3] = { { std::cos(angle), 0.0, -std::sin(angle) }, { 0.0, 1.0, 0.0 },
    { std::sin(angle), 0.0, std::cos(angle) } };
  double matrix[3][3];
  original->GetWorldToEnvironment(&matrix[0][0]);
  vtkMath::Multiply3x3(matrix, turn, matrix);
  vtkMath::Multiply3x3(matrix, axes[upAxis], matrix);
  turned->SetWorldToEnvironment(&matrix[0][0]);
}
}

//------------------------------------------------------------------------------
struct vtkMeasuredMaterialRepresentation::Internals
{
  vtkNew<MissingNormalsFilter> Normals;

  // The properties; those of mappers are the first mapper's.
  std::string Material = "gold-paint";
  std::string MaterialFile;
  Rows BlockNames; // selector, material
  int MapMode = 0;
  std::string MapArray;
  Rows MapNames; // value, material
  std::vector<std::string> ImageNames;
  std::string Environment = "Automatic";
  std::string EnvironmentFile;
  double Rotation = 0.0;
  int UpAxis = 1;
  bool ViewLights = false;
  bool Modulates = true;
  bool Background = true;
  int Occlusion = vtkMeasuredBRDFMapper::OCCLUSION_AUTO;
  std::string NormalArray = "None"; // of the superclass's property

  bool IsDistributed = false;     // several processes have parts of the surface
  bool HasWarned = false;         // of that
  bool IsModeled = false;         // what "Auto" said of the last picture
  vtkMTimeType OcclusionTime = 0; // of that picture's data
  std::set<std::string> Said;     // errors, each once

  // What the names gave.
  bool IsFound = false;
  vtkSmartPointer<vtkBRDF> BRDF;
  std::vector<vtkSmartPointer<vtkBRDF>> Blocks, MapMaterials; // of the tables' rows
  std::vector<vtkSmartPointer<vtkImageData>> MapImages;
  vtkSmartPointer<vtkMaterialMap> Map;
  bool MapChanged = true;
  vtkSmartPointer<vtkEnvironment> Light;  // of the environment's name; null: the view's own
  vtkSmartPointer<vtkEnvironment> Turned; // its copy in another orientation, if any
  vtkMTimeType BlocksTime = 0;            // of the data whose blocks have their materials
  bool BlocksChanged = true;

  // "" for the view's own. "Automatic" needs the stand-in at hand.
  std::string GetEnvironmentName() const
  {
    return this->Environment == "View"        ? ""
           : this->Environment == "Automatic" ? "room"
           : this->Environment == File        ? this->EnvironmentFile
                                              : this->Environment;
  }

  void Say(vtkObject* self, const std::string& error)
  {
    if (!error.empty() && this->Said.insert(error).second)
    {
      vtkErrorWithObjectMacro(self, << error);
    }
  }

  // Collective with a controller: the same calls on each process, in one order.
  void FindAll(vtkObject* self, vtkMultiProcessController* controller)
  {
    const auto take = [&](auto found)
    {
      this->Say(self, found.Error);
      return found.Object;
    };
    const auto takeAll = [&](const Rows& rows, std::vector<vtkSmartPointer<vtkBRDF>>& materials)
    {
      materials.clear();
      for (const auto& row : rows)
      {
        materials.push_back(take(FindMaterial(row.second, controller)));
      }
    };
    const bool isFile = this->Material == File;
    this->BRDF = take(FindMaterial(isFile ? this->MaterialFile : this->Material, controller));
    takeAll(this->BlockNames, this->Blocks);
    takeAll(this->MapNames, this->MapMaterials);
    this->MapImages.clear();
    for (const std::string& path : this->ImageNames)
    {
      this->MapImages.push_back(take(FindWeightImage(path, controller)));
    }
    const auto environment = take(FindEnvironment(this->GetEnvironmentName(), controller));
    if (environment != this->Light)
    {
      this->Light = environment;
      this->Turned = nullptr;
    }
    if (!this->Light && this->Environment != "View") // black would look like a result
    {
      this->BRDF = nullptr;
      std::fill(this->Blocks.begin(), this->Blocks.end(), nullptr);
      std::fill(this->MapMaterials.begin(), this->MapMaterials.end(), nullptr);
    }
    this->IsFound = true;
    this->BlocksChanged = true;
    this->MapChanged = true;
  }

  // Null where there is no map, or where something cannot be read that the weights of the others
  // depend on: one that is left out would give its weights to the others. Classes and values of
  // materials that cannot be read are left out.
  vtkMaterialMap* GetMap(vtkObject* self)
  {
    if (!std::exchange(this->MapChanged, false))
    {
      return this->Map;
    }
    this->Map = nullptr;
    if (this->MapMode == 0)
    {
      return nullptr;
    }
    bool isWhole = true;
    std::map<double, std::pair<vtkBRDF*, std::string>> rows; // weights go by their order
    for (std::size_t k = 0; k < std::min(this->MapNames.size(), this->MapMaterials.size()); ++k)
    {
      const auto& [value, name] = this->MapNames[k];
      double number = 0.0; // not by strtod, which follows the host's locale
      const char* const end = value.data() + value.size();
      const auto read = std::from_chars(value.data(), end, number);
      const bool isNumber = read.ec == std::errc() && read.ptr == end && std::isfinite(number);
      if (!isNumber)
      {
        this->Say(self, "Map Materials: found \"" + value + "\", expected a number.");
      }
      if (isNumber && this->MapMaterials[k]) // what cannot be read has been said
      {
        rows[number] = { this->MapMaterials[k], name };
      }
      isWhole = isWhole && isNumber && this->MapMaterials[k];
    }
    const int modes[] = { vtkMaterialMap::CLASSES, vtkMaterialMap::VALUES, vtkMaterialMap::WEIGHTS,
      vtkMaterialMap::TEXTURES };
    vtkNew<vtkMaterialMap> map;
    map->SetMode(modes[this->MapMode - 1]);
    map->SetArrayName(this->MapArray);
    for (const auto& [number, row] : rows)
    {
      map->AddMaterial(row.first, number, row.second);
    }
    for (vtkImageData* image :
      this->MapMode == Images ? this->MapImages : decltype(this->MapImages)())
    {
      isWhole = isWhole && image;
      if (image)
      {
        map->AddWeightImage(image);
      }
    }
    this->Map = isWhole || this->MapMode < Weights ? map.Get() : nullptr;
    return this->Map;
  }

  // The first process says which selectors no process has. Collective, as FindAll is.
  void CheckSelectors(vtkObject* self, vtkDataObject* data, vtkMultiProcessController* controller)
  {
    if (this->BlockNames.empty())
    {
      return;
    }
    std::vector<int> have;
    for (const auto& indices : GetIndices(data, this->BlockNames))
    {
      have.push_back(indices.empty() ? 0 : 1);
    }
    std::vector<int> anyHave = have;
    if (controller)
    {
      controller->AllReduce(
        have.data(), anyHave.data(), static_cast<vtkIdType>(have.size()), vtkCommunicator::MAX_OP);
    }
    for (std::size_t k = 0;
         k < anyHave.size() && (!controller || controller->GetLocalProcessId() == 0); ++k)
    {
      if (!anyHave[k])
      {
        this->Say(self, "Block Materials: no block is called " + this->BlockNames[k].first +
                          ", expected a path such as /Root/Block.");
      }
    }
  }

  // Whether several processes have parts of the surface, of which each knows its own only.
  // Collective, as FindAll is.
  void CheckParts(vtkDataObject* data, vtkMultiProcessController* controller)
  {
    int own = 0;
    for (vtkPolyData* surface : vtkCompositeDataSet::GetDataSets<vtkPolyData>(data))
    {
      own = surface->GetNumberOfPolys() > 0 || surface->GetNumberOfStrips() > 0 ? 1 : own;
    }
    int all = 0;
    controller->AllReduce(&own, &all, 1, vtkCommunicator::SUM_OP);
    this->IsDistributed = all > 1;
  }

  bool IsLeftOut() const
  {
    return this->IsDistributed && this->Occlusion != vtkMeasuredBRDFMapper::OCCLUSION_OFF;
  }

  // One copy, which shares the pixels with what others use: plans and textures outlast its turns.
  vtkEnvironment* GetTurned()
  {
    if (this->Light && !this->Turned && (this->Rotation != 0.0 || this->UpAxis != 1))
    {
      this->Turned.TakeReference(this->Light->NewSnapshot());
    }
    if (this->Turned)
    {
      Turn(this->Turned, this->Light, this->Rotation, this->UpAxis);
    }
    return this->Turned ? this->Turned : this->Light;
  }
};

//------------------------------------------------------------------------------
vtkMeasuredMaterialRepresentation::vtkMeasuredMaterialRepresentation()
  : Impl(new Internals)
{
  for (vtkMapper** mapper :
    { &this->Mapper, &this->LODMapper, &this->BackfaceMapper, &this->LODBackfaceMapper })
  {
    (*mapper)->Delete();
    *mapper = vtkCompositeMeasuredBRDFMapper::New();
  }
  // As the superclass set them: selections are told without a conversion.
  auto* mapper = static_cast<vtkCompositeMeasuredBRDFMapper*>(this->Mapper);
  mapper->SetProcessIdArrayName("vtkProcessId");
  mapper->SetCompositeIdArrayName("vtkCompositeIndex");
  this->SetArrayIdNames(nullptr, nullptr);
  this->SetupDefaults();
}

//------------------------------------------------------------------------------
vtkMeasuredMaterialRepresentation::~vtkMeasuredMaterialRepresentation() = default;

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetupDefaults()
{
  this->Superclass::SetupDefaults();
  this->Impl->Normals->SetInputConnection(this->GeometryFilter->GetOutputPort());
  this->MultiBlockMaker->SetInputConnection(this->Impl->Normals->GetOutputPort());
}

//------------------------------------------------------------------------------
// Names change what is read: on several processes that is done with the next update, together.
#define measuredmaterialsSetNameMacro(Name, Member)                   \
  void vtkMeasuredMaterialRepresentation::Set##Name(const char* text) \
  {                                                                   \
    if (this->Impl->Member != ToText(text))                           \
    {                                                                 \
      this->Impl->Member = ToText(text);                              \
      this->NamesChanged();                                           \
    }                                                                 \
  }

measuredmaterialsSetNameMacro(MeasuredMaterial, Material);
measuredmaterialsSetNameMacro(MeasuredMaterialFile, MaterialFile);
measuredmaterialsSetNameMacro(MeasuredEnvironment, Environment);
measuredmaterialsSetNameMacro(MeasuredEnvironmentFile, EnvironmentFile);

#define measuredmaterialsRemoveAllMacro(Name, Member)       \
  void vtkMeasuredMaterialRepresentation::RemoveAll##Name() \
  {                                                         \
    if (!this->Impl->Member.empty())                        \
    {                                                       \
      this->Impl->Member.clear();                           \
      this->NamesChanged();                                 \
    }                                                       \
  }

measuredmaterialsRemoveAllMacro(BlockMaterials, BlockNames);
measuredmaterialsRemoveAllMacro(MapMaterials, MapNames);
measuredmaterialsRemoveAllMacro(WeightImages, ImageNames);

// The next picture is drawn so; nothing is read.
#define measuredmaterialsSetMacro(Name, Type, Member) \
  void vtkMeasuredMaterialRepresentation::Set##Name(Type value) { this->Impl->Member = value; }

// What is wrong is said by the first mapper, not by all of them.
#define measuredmaterialsForwardMacro(Name, Type)                                 \
  void vtkMeasuredMaterialRepresentation::Set##Name(Type value)                   \
  {                                                                               \
    static_cast<vtkCompositeMeasuredBRDFMapper*>(this->Mapper)->Set##Name(value); \
  }

measuredmaterialsForwardMacro(ErrorTolerance, double);
measuredmaterialsForwardMacro(MaximumCost, double);
measuredmaterialsForwardMacro(OcclusionBounce, bool);
measuredmaterialsSetMacro(ModulateByScalars, bool, Modulates);
measuredmaterialsSetMacro(MeasuredEnvironmentRotation, double, Rotation);
measuredmaterialsSetMacro(UseViewLights, bool, ViewLights);
measuredmaterialsSetMacro(PlanInBackground, bool, Background);

//------------------------------------------------------------------------------
template <typename Function>
void vtkMeasuredMaterialRepresentation::ForEachMapper(const Function& function)
{
  for (vtkMapper* mapper :
    { this->Mapper, this->BackfaceMapper, this->LODMapper, this->LODBackfaceMapper })
  {
    function(static_cast<vtkCompositeMeasuredBRDFMapper*>(mapper),
      mapper == this->LODMapper || mapper == this->LODBackfaceMapper);
  }
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::NamesChanged()
{
  this->Impl->IsFound = false;
  this->Impl->Said.clear();
  if (GetController())
  {
    this->MarkModified();
  }
}

// What is empty belongs to a row of the panel's table that is being written.
#define measuredmaterialsAddMacro(Function, Member)                                         \
  void vtkMeasuredMaterialRepresentation::Function(const char* place, const char* material) \
  {                                                                                         \
    if (!ToText(place).empty())                                                             \
    {                                                                                       \
      this->Impl->Member.emplace_back(place, ToText(material));                             \
      this->NamesChanged();                                                                 \
      this->MarkModified(); /* selectors of blocks are checked where the data are */        \
    }                                                                                       \
  }

measuredmaterialsAddMacro(SetBlockMaterial, BlockNames);
measuredmaterialsAddMacro(SetMapMaterial, MapNames);

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetMaterialMapMode(int mode)
{
  this->Impl->MapMode = std::clamp(mode, 0, 4);
  this->Impl->MapChanged = true;
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetMaterialMapArray(const char* name)
{
  this->Impl->MapArray = ToText(name);
  this->Impl->MapChanged = true;
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::AddWeightImage(const char* path)
{
  if (!ToText(path).empty())
  {
    this->Impl->ImageNames.emplace_back(path);
    this->NamesChanged();
  }
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetMeasuredEnvironmentUpAxis(int axis)
{
  this->Impl->UpAxis = std::clamp(axis, 0, 2);
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetOcclusionMode(int mode)
{
  this->Impl->Occlusion = std::clamp(mode, 0, 2);
  this->Impl->HasWarned = false;
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetGenerateMissingNormals(bool generate)
{
  this->Impl->Normals->SetEnabled(generate);
  this->SetPointArrayToProcess(0, this->Impl->NormalArray.c_str());
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetPointArrayToProcess(int index, const char* name)
{
  std::string array = ToText(name);
  if (index == 0) // normals; "None", as of data that have none, would take away those that are made
  {
    this->Impl->NormalArray = array;
    array = this->Impl->Normals->GetEnabled() && array == "None" ? "" : array;
  }
  this->Superclass::SetPointArrayToProcess(index, array.c_str());
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::SetMissingNormalsFeatureAngle(double degrees)
{
  this->Impl->Normals->SetFeatureAngle(degrees);
  this->MarkModified();
}

//------------------------------------------------------------------------------
int vtkMeasuredMaterialRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkMultiProcessController* controller = GetController();
  if (controller)
  {
    this->Impl->FindAll(this, controller);
  }
  const int success = this->Superclass::RequestData(request, inputVector, outputVector);
  if (inputVector[0]->GetNumberOfInformationObjects() > 0) // a client of a server has no input
  {
    vtkDataObject* data = this->MultiBlockMaker->GetOutputDataObject(0);
    this->Impl->CheckSelectors(this, data, controller);
    if (controller)
    {
      this->Impl->CheckParts(data, controller);
    }
  }
  return success;
}

//------------------------------------------------------------------------------
int vtkMeasuredMaterialRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* requestType, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(requestType, inInfo, outInfo))
  {
    return 0;
  }
  if (requestType == vtkPVView::REQUEST_RENDER())
  {
    this->WarnOfParts();
    this->UpdateMappers(
      vtkPVView::GetDeliveredPiece(inInfo, this), vtkPVView::GetDeliveredPieceLOD(inInfo, this));
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::UpdateMappers(
  vtkDataObject* data, vtkDataObject* levelOfDetail)
{
  if (!data || data->GetNumberOfElements(vtkDataObject::CELL) == 0)
  {
    return; // this process draws nothing: another one may have the files
  }
  Internals& impl = *this->Impl;
  const bool parallel = GetController() != nullptr;
  if (!impl.IsFound && !parallel)
  {
    impl.FindAll(this, nullptr);
  }

  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  vtkEnvironment* environment = impl.GetTurned();
  if (impl.Environment == "Automatic" && view && view->GetRenderer()->GetEnvironmentTexture())
  {
    environment = nullptr;
  }
  // The light kit stands for the light that a scene lacks, as VTK's automatic headlight does.
  const bool ownLights = view && !view->GetUseLightKit();
  // vtkPVRenderView asks its window for 5 frames a second while the user interacts.
  const bool interactive = view && view->GetRenderWindow()->GetDesiredUpdateRate() > 1.0;
  const int mode = impl.Background && interactive && !parallel ? vtkMeasuredBRDFMapper::BACKGROUND
                                                               : vtkMeasuredBRDFMapper::FOREGROUND;
  const int occlusion = this->FindOcclusionMode(data, interactive);
  vtkMaterialMap* map = impl.GetMap(this);
  // What stands for the surface while the camera moves is another one, whose arrays of occlusion do
  // not fit, which comes and goes, and which may lack the map's data.
  auto* first = static_cast<vtkCompositeMeasuredBRDFMapper*>(this->Mapper);
  const bool canLevelRead = map && CanRead(levelOfDetail, impl.MapMode, impl.MapArray);
  this->ForEachMapper(
    [&](vtkCompositeMeasuredBRDFMapper* mapper, bool isLevel)
    {
      mapper->SetOcclusionMode(isLevel ? vtkMeasuredBRDFMapper::OCCLUSION_OFF : occlusion);
      mapper->SetBRDF(impl.BRDF);
      mapper->SetMaterialMap(isLevel && !canLevelRead ? nullptr : map);
      mapper->SetEnvironment(environment);
      mapper->SetPlanningMode(mode);
      mapper->SetUseSceneLights(impl.ViewLights || ownLights);
      mapper->SetErrorTolerance(first->GetErrorTolerance());
      mapper->SetMaximumCost(first->GetMaximumCost());
      mapper->SetOcclusionBounce(first->GetOcclusionBounce());
      mapper->SetScalarColoringMode(
        impl.Modulates ? vtkMeasuredBRDFMapper::MODULATE : vtkMeasuredBRDFMapper::IGNORE_SCALARS);
    });
  this->UpdateBlocks(vtkDataObjectTree::SafeDownCast(data));
}

//------------------------------------------------------------------------------
// The first process speaks for all, also where it has no part of the surface itself.
void vtkMeasuredMaterialRepresentation::WarnOfParts()
{
  Internals& impl = *this->Impl;
  if (impl.Occlusion != vtkMeasuredBRDFMapper::OCCLUSION_ON || impl.HasWarned || !impl.IsLeftOut())
  {
    return;
  }
  impl.HasWarned = true;
  if (GetController()->GetLocalProcessId() == 0)
  {
    vtkWarningMacro("Self-Occlusion: the surface is drawn as if it hid nothing from itself, since "
                    "each process has a part of it only. The filter Aggregate Dataset gathers it.");
  }
}

//------------------------------------------------------------------------------
// A mapper's "Auto" leaves a surface alone that changes in every frame, from the fourth one on. Of
// an animation that would be seen: where its last picture was modeled, the next one is.
int vtkMeasuredMaterialRepresentation::FindOcclusionMode(vtkDataObject* data, bool interactive)
{
  Internals& impl = *this->Impl;
  if (impl.Occlusion == vtkMeasuredBRDFMapper::OCCLUSION_OFF)
  {
    return impl.Occlusion;
  }
  if (impl.IsDistributed)
  {
    return vtkMeasuredBRDFMapper::OCCLUSION_ARRAYS; // of whoever knew the whole surface
  }
  auto* mapper = static_cast<vtkCompositeMeasuredBRDFMapper*>(this->Mapper);
  if (mapper->GetOcclusionMode() == vtkMeasuredBRDFMapper::OCCLUSION_AUTO)
  {
    impl.IsModeled = mapper->GetPlan().find("%), modeled") != std::string::npos;
  }
  const bool changed = impl.OcclusionTime != data->GetMTime();
  impl.OcclusionTime = data->GetMTime();
  return impl.IsModeled && changed && !interactive ? vtkMeasuredBRDFMapper::OCCLUSION_ON
                                                   : impl.Occlusion;
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::UpdateBlocks(vtkDataObjectTree* data)
{
  Internals& impl = *this->Impl;
  if (!data || (!impl.BlocksChanged && impl.BlocksTime == data->GetMTime()))
  {
    return;
  }
  impl.BlocksChanged = false;
  impl.BlocksTime = data->GetMTime();
  std::map<unsigned int, vtkBRDF*> brdfs; // by flat index; later rows go before earlier ones
  const auto indices = GetIndices(data, impl.BlockNames);
  for (std::size_t k = 0; k < std::min(indices.size(), impl.Blocks.size()); ++k)
  {
    for (unsigned int index : indices[k])
    {
      brdfs[index] = impl.Blocks[k];
    }
  }
  this->ForEachMapper(
    [&brdfs](vtkCompositeMeasuredBRDFMapper* mapper, bool)
    {
      mapper->RemoveBlockBRDFs();
      for (const auto& [index, brdf] : brdfs)
      {
        mapper->SetBlockBRDF(index, brdf);
      }
    });
}

//------------------------------------------------------------------------------
const char* vtkMeasuredMaterialRepresentation::GetPlan()
{
  // A client that drew before the server did keeps its mapper's plan.
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  const bool serverDraws = view && view->GetUseDistributedRenderingForRender() &&
                           vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_CLIENT;
  this->Plan =
    serverDraws ? "" : static_cast<vtkCompositeMeasuredBRDFMapper*>(this->Mapper)->GetPlan();
  if (this->Impl->IsLeftOut() && !this->Plan.empty())
  {
    this->Plan += "; occlusion is left out on several processes";
  }
  return this->Plan.c_str();
}

//------------------------------------------------------------------------------
void vtkMeasuredMaterialRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const Internals& impl = *this->Impl;
  os << indent << "MeasuredMaterial: " << impl.Material << "\n";
  os << indent << "MeasuredMaterialFile: " << impl.MaterialFile << "\n";
  os << indent << "MaterialMapMode: " << impl.MapMode << "\n";
  os << indent << "MeasuredEnvironment: " << impl.Environment << "\n";
  os << indent << "MeasuredEnvironmentFile: " << impl.EnvironmentFile << "\n";
  os << indent << "MeasuredEnvironmentRotation: " << impl.Rotation << "\n";
  os << indent << "OcclusionMode: " << impl.Occlusion << "\n";
  for (const Rows& rows : { impl.BlockNames, impl.MapNames })
  {
    for (const auto& [place, material] : rows)
    {
      os << indent << "Material of " << place << ": " << material << "\n";
    }
  }
}
