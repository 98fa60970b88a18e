// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @struct  vtkBRDFShaderInputs
 * @brief   GLSL text, uniforms and textures with which a shader evaluates a BRDF
 *
 * Plain data without GL, made by vtkBRDF::GetShaderInputs and used by the mappers. The GLSL text of
 * each term defines `vec3 brdfTermINSTANCE(vec3 i, vec3 o)`, the twin of vtkBRDF::Evaluate for unit
 * i and o above the horizon of the local frame (tangent, bitangent, normal). INSTANCE is replaced
 * by the term's number, also in the names of uniforms and textures, so that one shader can hold
 * several terms of the same kind. Put it into every name that the text declares. The text may add
 * `vec3 brdfTermSoftINSTANCE(vec3 i, vec3 o, float spread)`, the twin of vtkBRDF::EvaluateSoft;
 * without it soft lights are hard.
 *
 * Integrators use the same struct (vtkRadianceIntegrator::GetShaderInputs); there the text of each
 * term defines `vec3 brdfEnvironmentINSTANCE(mat3 frame, vec3 o)`: the outgoing radiance; frame has
 * the tangent, bitangent and normal in the environment's coordinates as columns.
 *
 * The text may use the definitions of shaders/vtkBRDFCommon.glsl. Text that does not compile gives
 * one error, and the surface is drawn as the mapper's superclass draws it.
 */

#ifndef vtkBRDFShaderInputs_h
#define vtkBRDFShaderInputs_h

#include <array>      // for dimensions
#include <cstddef>    // for size_t
#include <cstdint>    // for texels
#include <functional> // for hash
#include <string>     // for names
#include <vector>     // for data

struct vtkBRDFShaderInputs
{
  struct Uniform
  {
    std::string Name;          // without INSTANCE
    std::vector<float> Values; // 1 or 3 floats
  };

  struct Texture
  {
    std::string Name; // sampler, without INSTANCE
    std::array<int, 3> Dimensions = { 1, 1, 1 };
    bool ThreeD = false;                                  // for a sampler3D, even of depth 1
    int Components = 3;                                   // 1, 3 or 4
    bool HalfFloat = false;                               // stored as 16-bit float on the GPU
    std::array<bool, 3> Repeat = { false, false, false }; // else clamp to edge
    bool Mipmaps = false;                                 // its means are drawn from afar
    std::vector<float> Data;                              // x fastest, components interleaved
    // In place of Data, where it is not empty: RGB >= 0 in 32 bits a texel (GL_RGB9_E5, see
    // Floats.h); Components and HalfFloat then do not count.
    std::vector<std::uint32_t> SharedExponents;
    // Whether it is stored with a fourth component: true for 2D textures of 32 bits, because
    // software renderers then fetch them faster (7 % of a radiance table's frame).
    bool IsPadded() const { return Components == 3 && !HalfFloat && !ThreeD; }
    std::size_t GetBytes() const
    {
      const std::size_t bytes = Data.size() * (HalfFloat ? 2 : 4) * (Mipmaps ? 4 : 3) / 3;
      return 4 * SharedExponents.size() + (IsPadded() ? bytes / 3 * 4 : bytes);
    }
  };

  // A word of the GLSL text and what replaces it: sizes of arrays and loops.
  struct Constant
  {
    std::string Name;
    std::string Value;
  };

  struct Term
  {
    std::string Shader;     // name of the text in messages, e.g. "vtkBRDFLambert"
    std::string Source;     // GLSL text
    std::string SoftSource; // more text, with brdfTermSoftINSTANCE; may be empty
    bool IsTested = false;  // false: the mapper first compiles the text alone, for a clear error
    int Fetches = 0;        // of textures, for one evaluation at most; an integrator's: for a pixel
    int Evaluations = 0;    // of the material, for a pixel; an integrator's only
    std::vector<Constant> Constants;
    std::vector<Uniform> Uniforms;
    std::vector<Texture> Textures;
  };

  /// Set by the caller: whether soft lights are drawn. If not, data for soft lights is left out.
  bool SoftLights = false;

  std::vector<Term> Terms; // summed

  /// Relative L2 error (both cosines as weights) by resampling; 0 where nothing was resampled.
  double ResamplingError = 0.0;
  /// Largest relative error of a stored value by texture precision: 2^-9 of the largest component
  /// for shared exponents, 2^-11 for 16-bit floats, 2^-23 for 32-bit; 0 without textures.
  double QuantizationError = 0.0;
  /// One line for readers: sizes, precision, reason.
  std::string Description;

  std::size_t GetTextureBytes() const
  {
    std::size_t bytes = 0;
    for (const Term& term : this->Terms)
    {
      for (const Texture& texture : term.Textures)
      {
        bytes += texture.GetBytes();
      }
    }
    return bytes;
  }

  /// Texture fetches of a pixel, of an integrator's inputs with those of the material that lights
  /// need, or with none. Where lamps are evaluated near the lobe's axis only, these are of one
  /// turn: a pixel takes one for each lamp that is near, or for each of its parts (Lamps.h).
  int CountFetches(const vtkBRDFShaderInputs& material) const
  {
    int once = 0;
    for (const Term& term : material.Terms)
    {
      once += term.Fetches;
    }
    int all = 0;
    for (const Term& term : this->Terms)
    {
      all += term.Fetches + term.Evaluations * once;
    }
    return all;
  }

  /// Inputs with the same key have the same shader text; they differ in uniforms and textures only.
  std::string GetShaderKey() const
  {
    std::string key;
    for (const Term& term : this->Terms)
    {
      key += term.Shader + (term.SoftSource.empty() ? "" : ",soft");
      if (!term.IsTested)
      {
        key += "," + std::to_string(std::hash<std::string>()(term.Source + term.SoftSource));
      }
      for (const Constant& constant : term.Constants)
      {
        key += "," + constant.Name + "=" + constant.Value;
      }
      key += ";";
    }
    return key;
  }
};

#endif
