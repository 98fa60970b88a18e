// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFModels
 * @brief   the BRDF models that files may hold
 *
 * Each one is an object that serves as a model for others. Those of the module: Lambert,
 * BlinnPhong, AshikhminShirley, Distribution, Tabulated, Basis, AdaptiveWarp, Sum. A program adds
 * its own by Register: from then on readers and writers of OpenEXR materials know it, also as a
 * term of a sum. A model need not be here to be drawn. Any thread may call these methods.
 */

#ifndef vtkBRDFModels_h
#define vtkBRDFModels_h

#include "vtkBRDF.h"               // for models
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for models

#include <string> // for names
#include <vector> // for models

struct vtkBRDFData;

class VTKMEASUREDBRDF_EXPORT vtkBRDFModels : public vtkObject
{
public:
  static vtkBRDFModels* New();
  vtkTypeMacro(vtkBRDFModels, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add a model, or take one away that was added. The object is only asked for its name and for new
   * ones of its class (NewInstance: the class needs vtkTypeMacro and New). Returns whether it
   * worked: Register refuses null and a name that is taken or is not of letters, digits and
   * hyphens, by an error event; the module's own models stay.
   */
  static bool Register(vtkBRDF* model);
  static bool Unregister(vtkBRDF* model);
  ///@}

  /// All of them.
  static std::vector<vtkSmartPointer<vtkBRDF>> GetModels();

  /// The names in one line, for messages: "Lambert, Basis or Sum".
  static std::string GetNames();

  /**
   * The material as data. Returns "", or what cannot be stored: an object whose own class is not
   * among the models, or parameters that are not finite.
   */
  static std::string Save(vtkBRDF* brdf, vtkBRDFData& data);

  /**
   * A material of the data, whose arrays it takes. Returns "", or the name of the field that is
   * missing or out of range; brdf is null then.
   */
  static std::string Load(vtkBRDFData& data, vtkSmartPointer<vtkBRDF>& brdf);

  /**
   * 32 hexadecimal digits that identify the material by its model, parameters and data (not by Name
   * and Source). By them a plan finds what an earlier plan of an equal material has prepared. "" if
   * the material cannot be stored: each plan then prepares all of it.
   */
  static std::string GetContentKey(vtkBRDF* brdf);

  /// The most values that an array of a model may have (vtkBRDF::GetMaximumArraySize); infinity for
  /// names that are not known.
  static double GetMaximumArraySize(const std::string& name);

protected:
  vtkBRDFModels() = default;
  ~vtkBRDFModels() override = default;

private:
  vtkBRDFModels(const vtkBRDFModels&) = delete;
  void operator=(const vtkBRDFModels&) = delete;
};

#endif
