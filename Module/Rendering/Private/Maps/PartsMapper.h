// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws all parts of a surface that a material map divides.
 *
 * They have the vertex buffers in common. Each part has indices of its own triangles, and a shader
 * that evaluates and mixes its own materials.
 */

#ifndef PartsMapper_h
#define PartsMapper_h

#include "DrawnMaterial.h"
#include "MaterialParts.h"
#include "RecentlyUsed.h"
#include "ShadedMapper.h"
#include "WeightImages.h"
#include "vtkMaterialMap.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkOpenGLHelper;
class vtkOpenGLIndexBufferObject;
class vtkOpenGLRenderWindow;

namespace measuredbrdf
{
/// What a composite data set says of a block.
struct BlockStyle
{
  bool IsVisible = true;
  bool IsOpaque = true;
  double Opacity = 1.0;
  bool OverridesColor = false;
  double AmbientColor[3] = { 1.0, 1.0, 1.0 };
  double DiffuseColor[3] = { 1.0, 1.0, 1.0 };
};

class PartsMapper : public ShadedMapper<vtkOpenGLPolyDataMapper>
{
public:
  static PartsMapper* New();
  vtkTypeMacro(PartsMapper, ShadedMapper<vtkOpenGLPolyDataMapper>);

  /// drawing: of the mapper that users know.
  void SetDrawing(std::shared_ptr<MaterialDrawing> drawing) { this->Drawing = std::move(drawing); }

  /// Draw these from now on; they outlive this mapper's renders. colorsOfMap: whether the scalars
  /// that color the surface are those that choose its materials, which they do not color then.
  void SetParts(const MaterialParts* parts, vtkMaterialMap* map, bool colorsOfMap);

  /// Of the block that the surface is; null (default): there are no blocks.
  void SetStyle(const BlockStyle* style) { this->Style = style; }

  /// Of the images of weights on the graphics card.
  vtkIdType GetImageBytes() const
  {
    std::set<const vtkTextureObject*> counted;
    return this->Images ? static_cast<vtkIdType>(this->Images->CountBytes(counted)) : 0;
  }

  void RenderPieceDraw(vtkRenderer* ren, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  PartsMapper();
  ~PartsMapper() override;

  std::vector<vtkBRDF*> GetBRDFs() override { return this->BRDFs; }
  bool IsPart() override { return true; }
  bool IgnoresScalars() override;
  void ShowOnly(int part) override;
  void BuildIBO(vtkRenderer* ren, vtkActor* actor, vtkPolyData* surface) override;
  void UpdateShaders(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void ReplaceShaderPositionVC(Shaders shaders, vtkRenderer* ren, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;
  void SetPropertyShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;

private:
  PartsMapper(const PartsMapper&) = delete;
  void operator=(const PartsMapper&) = delete;

  struct Part
  {
    MaterialPart Data;
    std::vector<std::size_t> Uses;                       // its members' places among all
    vtkSmartPointer<vtkOpenGLIndexBufferObject> Indices; // of its triangles
    int FirstPrimitive = 0;                              // counted over all parts
  };

  bool ReadyImages(vtkRenderer* ren);
  void SelectMaterials(const Part& part, vtkRenderer* ren);
  std::vector<std::size_t> ChooseMembers(const Part& part, vtkRenderer* ren);
  MixtureText MakeMixtureText(const MaterialPart& part, const std::vector<bool>& drawn) const;
  std::string GetWeightText(const MaterialPart& part, int slot) const;
  std::vector<std::pair<std::string, std::string>> GetAttributes(const MaterialPart& part) const;
  bool IsRest(const vtkOpenGLHelper* cellBO) const;
  bool NeedsWeights(const vtkOpenGLHelper* cellBO) const;

  // Deletes OpenGL objects in the window that they are in, whichever is current.
  template <typename Release>
  void InOwnWindow(const Release& release);
  void ReleaseIndices();
  void UseShadersOf(const std::string& key);
  void DropShaders(vtkWindow* window);

  static constexpr std::size_t MostWindows = 16; // whose images stay while others are drawn

  const MaterialParts* Owner = nullptr;
  unsigned long Revision = 0; // of the owner's parts
  std::vector<Part> Parts;
  const Part* Shown = nullptr; // null: all are
  std::vector<vtkBRDF*> BRDFs;
  bool AreColorsOfMap = false;
  const BlockStyle* Style = nullptr;
  vtkSmartPointer<vtkMaterialMap> Map;
  std::vector<int> ImageComponents;       // of each image of weights
  std::shared_ptr<ShaderTextures> Images; // of the window drawn last
  RecentlyUsed<vtkOpenGLRenderWindow*, std::shared_ptr<ShaderTextures>> ImagesOf{ MostWindows };
  bool AreBuilt = false;                           // the parts' indices
  vtkWeakPointer<vtkOpenGLRenderWindow> OwnWindow; // in which they and the shaders are
  // Of all primitives, while a part is shown.
  std::array<vtkOpenGLIndexBufferObject*, PrimitiveEnd> Whole{};
  vtkSmartPointer<vtkOpenGLIndexBufferObject> Nothing;
  // What VTK's class keeps for shaders that are not in use now; the key of the one that is.
  std::map<std::string, std::unique_ptr<vtkOpenGLHelper>> OtherShaders;
  std::string ShadersInUse;
};
} // namespace measuredbrdf

#endif
