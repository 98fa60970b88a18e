// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRadianceMethods
 * @brief   the methods that integrate an environment's light which this program knows
 *
 * A method is a vtkRadianceIntegrator that serves as a model for others. Those of the module come
 * first: table, hybrid, light-set, filtered, reference.
 * A program adds its own by Register. Planners, mappers and every program that asks here then know
 * it, at once. Any thread may call these methods.
 */

#ifndef vtkRadianceMethods_h
#define vtkRadianceMethods_h

#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkRadianceIntegrator.h" // for methods
#include "vtkSmartPointer.h"       // for methods

#include <string> // for names
#include <vector> // for methods

class VTKMEASUREDBRDF_EXPORT vtkRadianceMethods : public vtkObject
{
public:
  static vtkRadianceMethods* New();
  vtkTypeMacro(vtkRadianceMethods, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add a method, or take one away that was added. The integrator must not be changed any more; it
   * is only asked and copied (NewCopy). Returns whether it worked: Register refuses null and a name
   * that is taken or is not of lower case letters, digits and hyphens, by an error event; the
   * module's own methods stay.
   */
  static bool Register(vtkRadianceIntegrator* method);
  static bool Unregister(vtkRadianceIntegrator* method);
  ///@}

  /// All of them.
  static std::vector<vtkSmartPointer<vtkRadianceIntegrator>> GetMethods();

  /// Whether the method is the module's own.
  static bool IsBuiltIn(const std::string& name);

  /// A new integrator of the method with that name, which the caller has to release; null where
  /// there is none.
  VTK_NEWINSTANCE static vtkRadianceIntegrator* NewIntegrator(const std::string& name);

  /// The names in one line, for messages: "table, hybrid or light-set".
  static std::string GetNames();

protected:
  vtkRadianceMethods() = default;
  ~vtkRadianceMethods() override = default;

private:
  vtkRadianceMethods(const vtkRadianceMethods&) = delete;
  void operator=(const vtkRadianceMethods&) = delete;
};

#endif
