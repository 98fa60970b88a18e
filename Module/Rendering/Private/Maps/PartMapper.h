// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Draws a part of a surface that a material map divides.
 */

#ifndef PartMapper_h
#define PartMapper_h

#include "BlockStyle.h"
#include "MaterialParts.h"
#include "RecentlyUsed.h"
#include "SelectedMaterials.h"
#include "ShadedMapper.h"
#include "WeightImages.h"
#include "vtkMaterialMap.h"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkOpenGLRenderWindow;

namespace measuredbrdf
{
class PartMapper : public ShadedMapper<vtkOpenGLPolyDataMapper>
{
public:
  static PartMapper* New();
  vtkTypeMacro(PartMapper, ShadedMapper<vtkOpenGLPolyDataMapper>);

  /// drawing: of the mapper that users know.
  void SetDrawing(std::shared_ptr<MaterialDrawing> drawing) { this->Drawing = std::move(drawing); }

  /// Draw this part from now on. parts: of all of them, which outlive this mapper's renders.
  void SetPart(const MaterialParts* parts, MaterialPart part, vtkMaterialMap* map);

  /// Of the block that the part belongs to; null (default): there are no blocks.
  void SetStyle(const BlockStyle* style) { this->Style = style; }

  /// Of the images of weights on the graphics card.
  vtkIdType GetImageBytes() const
  {
    return this->Images ? static_cast<vtkIdType>(this->Images->GetBytes()) : 0;
  }

  void RenderPieceDraw(vtkRenderer* ren, vtkActor* actor) override;

protected:
  /// In this program, which draws some pixels of polygons only: those of a part of the Nearest
  /// kind; negative: it draws all.
  virtual int GetSlot() const
  {
    return this->Part.Kind == MixtureKind::Nearest ? this->Part.Slot : -1;
  }

  /// Whether what is drawn now has weights.
  virtual bool HasWeights() const { return !this->Attributes.empty(); }

  /// For the fragment shader, of parts that have weights: declarations, and what fills brdfWeights.
  /// drawn: which of the part's members have a share; the others' is divided among them. What is
  /// not this part's is discarded.
  MixtureText MakeMixtureText(const std::vector<bool>& drawn) const;

  PartMapper() = default;
  ~PartMapper() override = default;

  std::vector<MaterialUse> GetMaterialUses() override { return this->Uses; }
  bool IsPart() override { return true; }
  void ReplaceShaderPositionVC(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;

  void SetPropertyShaderParameters(
    vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* actor) override;

private:
  PartMapper(const PartMapper&) = delete;
  void operator=(const PartMapper&) = delete;

  bool NeedsWeights(const vtkOpenGLHelper* cellBO);
  bool IsOthers(const vtkOpenGLHelper* cellBO);
  void DrawMixture(vtkRenderer* ren, vtkActor* actor);
  std::vector<std::size_t> ChooseMembers(vtkRenderer* ren);
  std::string GetWeightDeclarations() const;
  std::string GetWeightText(int slot) const;
  std::string GetWeightCode(const std::vector<bool>& drawn) const;

  static constexpr std::size_t MostWindows = 16; // whose images stay while others are drawn

  const MaterialParts* Parts = nullptr;
  MaterialPart Part;
  std::vector<MaterialUse> Uses;
  vtkSmartPointer<vtkMaterialMap> Map;
  std::vector<int> ImageComponents;                               // of each image of weights
  std::vector<std::pair<std::string, std::string>> Attributes;    // of the weights: names and types
  std::vector<std::pair<std::size_t, std::array<float, 4>>> Hats; // of the members drawn now
  std::shared_ptr<WeightTextures> Images;                         // of the window drawn last
  RecentlyUsed<vtkOpenGLRenderWindow*, std::shared_ptr<WeightTextures>> ImagesOf{ MostWindows };
  const BlockStyle* Style = nullptr;
};
} // namespace measuredbrdf

#endif
