// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDF
 * @brief   a material as its bidirectional reflectance distribution function
 *
 * The BRDF f(i,o) in 1/sr, linear RGB with Rec. 709 primaries, *without* the cosine. It has no
 * graphics state. Several mappers may share it; they update when its MTime changes.
 *
 * Local frame of every direction: z = shading normal, x = tangent; i points to the light, o to the
 * viewer; both are unit vectors (they are normalized here, so lengths other than 1 do no harm).
 * theta is the polar angle from z, phi the azimuth from x.
 *
 * The queries (Evaluate, Sample, Pdf, ...) may be called from many threads at once as long as no
 * thread changes the object. After a change call Prepare() first: it builds the data that is
 * otherwise built on demand.
 */

#ifndef vtkBRDF_h
#define vtkBRDF_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Renderable

#include <limits> // for GetMaximumArraySize
#include <memory> // for Lobe
#include <string> // for Name, Source
#include <vector> // for SetLobe

class vtkBRDFExchange;
class vtkDataArray;
struct vtkBRDFShaderInputs;

class VTKMEASUREDBRDF_EXPORT vtkBRDF : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkBRDF, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material's name and the source of its data (paper, database, file). Both are empty by
   * default. Readers set them and writers store them; they have no other effect.
   */
  vtkSetMacro(Name, std::string);
  vtkGetMacro(Name, std::string);
  vtkSetMacro(Source, std::string);
  vtkGetMacro(Source, std::string);
  ///@}

  /**
   * f(i,o) in 1/sr, RGB. Zero when i or o is at or below the horizon (z <= 0). Never negative, NaN
   * or infinite, whatever the data hold.
   */
  void Evaluate(const double i[3], const double o[3], double f[3]);

  /**
   * f(i,o) blurred over i: the mean over light that is spread about i as a von Mises-Fisher
   * distribution of concentration 1/spread (spread >= 0; 0: Evaluate). This is an approximation for
   * lobes about the half vector: their width in h grows by that of the light, and their integral
   * stays. Materials without such lobes give f(i,o), but their GetRenderable() may have one. Like
   * Evaluate, it is never negative, NaN or infinite.
   */
  void EvaluateSoft(const double i[3], const double o[3], double spread, double f[3]);

  /**
   * Draw i given o from two uniform numbers in [0,1). Returns false, with i = 0, where the draw
   * fell below the horizon: such a sample counts as zero. E[f(i,o) cos(theta_i) / Pdf(i,o)] over
   * the draws is the directional albedo.
   */
  bool Sample(const double o[3], double u1, double u2, double i[3]);

  /**
   * Probability density of Sample in 1/sr (solid angle of i). Its integral over the upper
   * hemisphere is 1 minus the share of draws that fall below the horizon.
   */
  double Pdf(const double i[3], const double o[3]);

  /**
   * Directional albedo a(o) = integral of f(i,o) cos(theta_i) di over the upper hemisphere, RGB.
   * An adaptive cubature that begins with 2^14 directions and looks closely where f varies, about
   * the mirror direction, about o and where Sample draws. Each channel is within 1e-3, relative, of
   * the integral, but where a lobe narrower than 1 degree lies elsewhere, or values jump at so many
   * places that 2^16 parts of the hemisphere do not suffice.
   */
  virtual void GetDirectionalAlbedo(const double o[3], double albedo[3]);

  /**
   * Directional-hemispherical reflectance r(i) = integral of f(i,o) cos(theta_o) do, RGB: the share
   * of light from i that is reflected. As exact; equal to the albedo where f is reciprocal.
   */
  virtual void GetDirectionalReflectance(const double i[3], double reflectance[3]);

  ///@{
  /**
   * Evaluate, Sample, Pdf and GetDirectionalAlbedo of n directions or pairs in one call, on several
   * threads (vtkSMPTools). Prepare() is called first.
   *
   * i and o have 3 components, u (two uniform numbers in [0,1)) has 2. Each has n tuples, or one,
   * which serves for all. Their type is any; float and double are fastest. The result, of type
   * float or double, is resized to n tuples of 3 components (pdf: 1). It may be one of the inputs.
   * Its values are those of the calls for single directions, rounded where it holds floats.
   * SampleArray gives i = 0 where Sample returns false.
   *
   * Returns false with an error event, the result unchanged, where an array is missing, or has
   * another number of components or tuples, or the result is of another type.
   */
  bool EvaluateArray(vtkDataArray* i, vtkDataArray* o, vtkDataArray* f);
  bool SampleArray(vtkDataArray* o, vtkDataArray* u, vtkDataArray* i);
  bool PdfArray(vtkDataArray* i, vtkDataArray* o, vtkDataArray* pdf);
  bool GetDirectionalAlbedoArray(vtkDataArray* o, vtkDataArray* albedo);
  ///@}

  /**
   * Whether f only depends on the difference of the azimuths.
   */
  virtual bool IsIsotropic() { return true; }

  /**
   * Whether f(i,o) = f(o,i) holds by construction. Measured tables may break it.
   */
  virtual bool IsReciprocal() { return true; }

  /**
   * Build the data that Evaluate, Sample and Pdf otherwise build on demand. Not thread safe where
   * there is something to build; a further call, with nothing changed, changes nothing.
   */
  virtual void Prepare() {}

  ///@{
  /**
   * Largest relative L2 error (weighted by both cosines) that GetShaderInputs may add by resampling
   * and by its texture precision; default 0.01, clamped to [1e-5, 0.5]. Only representations that
   * have to be resampled or stored in textures use it. The shader inputs hold the actual error.
   */
  virtual void SetResamplingTolerance(double resamplingTolerance);
  vtkGetMacro(ResamplingTolerance, double);
  ///@}

  /**
   * The BRDF that the shader inputs evaluate: this object, unless its representation has no GLSL
   * form. It is then the BRDF into which this one is resampled, cached until this object changes.
   */
  virtual vtkBRDF* GetRenderable() { return this; }

  /**
   * Whether GetRenderable() is this object: the representation has a GLSL form. Override it
   * together with GetRenderable().
   */
  virtual bool IsRenderable() { return true; }

  /**
   * A fast substitute for GetRenderable(): the same object if it exists or costs nothing, else a
   * coarse one, made in about a hundredth of a second, with an error of some percent that is not
   * measured. Default: GetRenderable(); override it where that is slow. The caller has to release
   * the result.
   */
  VTK_NEWINSTANCE virtual vtkBRDF* NewQuickRenderable();

  /**
   * GLSL text, uniforms and textures that evaluate GetRenderable() on the GPU. The GLSL form of
   * EvaluateSoft is included only if inputs.SoftLights requests it.
   */
  virtual void GetShaderInputs(vtkBRDFShaderInputs& inputs) = 0;

  /**
   * A copy that shares no data that either object may change, so that another thread may use it
   * while this thread changes the original. The caller has to release it. Null if the class does
   * not support copies (NewCopy).
   */
  VTK_NEWINSTANCE vtkBRDF* NewSnapshot();

  ///@{
  /**
   * For files: the model's name ("Lambert"), and its parameters, each named once, so that they can
   * be saved, loaded and printed. A program's own model overrides both and is given to
   * vtkBRDFModels::Register. Default: no name, not stored. Name, Source and ResamplingTolerance are
   * stored without being named.
   */
  virtual std::string GetModelName() { return ""; }
  VTK_WRAPEXCLUDE virtual void ExchangeData(vtkBRDFExchange& vtkNotUsed(exchange)) {}
  ///@}

  /**
   * The most values that one array of the model's data may have. Readers refuse larger ones before
   * they allocate memory. Default: no limit but the file's size.
   */
  virtual double GetMaximumArraySize() { return std::numeric_limits<double>::infinity(); }

protected:
  vtkBRDF();
  ~vtkBRDF() override;

  /**
   * f(i,o) for unit i, o above the horizon. The result may be negative, NaN or infinite for bad
   * data: Evaluate replaces such values.
   */
  virtual void EvaluateAbove(const double i[3], const double o[3], double f[3]) = 0;

  /**
   * The same for light of the given spread, in (0, 1e6]; default: EvaluateAbove.
   */
  virtual void EvaluateSoftAbove(const double i[3], const double o[3], double spread, double f[3]);

  ///@{
  /**
   * Sampling for unit o above the horizon; default: by the density of SetLobe, which Prepare may
   * set, or else a cosine-weighted hemisphere.
   */
  virtual bool SampleAbove(const double o[3], double u1, double u2, double i[3]);
  virtual double PdfAbove(const double i[3], const double o[3]);
  ///@}

  ///@{
  /**
   * A density of half vectors to draw from, for tables. weights: relative density per steradian of
   * h in each cell of a grid of nTheta x nPhi (theta fastest), uniform in the square root of
   * theta_h and in phi_h; none: the mean of f cos(theta_i) over the difference angles. share: of
   * the draws that use it; the rest is cosine-weighted. ResetLobe is for changed data.
   */
  void SetLobe(int nTheta, int nPhi, double share, const std::vector<double>& weights = {});
  void ResetLobe() { this->Lobe.reset(); }
  bool HasLobe() const { return this->Lobe != nullptr; }
  ///@}

  /**
   * A new object of the same class with the same parameters, except those of this base class, which
   * the caller copies; default: null, no copies. An object of another class is not used: a subclass
   * has to override this itself.
   */
  virtual vtkBRDF* NewCopy() { return nullptr; }

  std::string Name;
  std::string Source;
  double ResamplingTolerance = 0.01;

private:
  vtkBRDF(const vtkBRDF&) = delete;
  void operator=(const vtkBRDF&) = delete;

  struct HalfVectors;
  std::shared_ptr<const HalfVectors> Lobe;
};

#endif
