// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEnvironmentReader
 * @brief   a lat-long image of any format OpenImageIO reads -> vtkEnvironment
 *
 * Float formats are taken as linear; integer formats (8 and 16 bit) as sRGB-encoded unless the file
 * says it is linear. One-channel images become grey; alpha and further channels are dropped. Any
 * size from 1x1; an aspect other than 2:1 is kept and noted. Negative and non-finite values are set
 * to 0, counted (vtkEnvironment) and noted.
 */

#ifndef vtkEnvironmentReader_h
#define vtkEnvironmentReader_h

#include "vtkEnvironment.h"        // for GetEnvironment
#include "vtkMeasuredBRDFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for Environment

#include <string> // for names

class VTKMEASUREDBRDF_EXPORT vtkEnvironmentReader : public vtkObject
{
public:
  static vtkEnvironmentReader* New();
  vtkTypeMacro(vtkEnvironmentReader, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file.
   */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  /**
   * Read. Returns whether it worked; if not, an error event and GetErrorMessage name the file and
   * what is wrong, and the environment that was read before stays.
   */
  bool Read();

  /**
   * The last environment that was read without error (a new object at each Read); null before.
   */
  vtkEnvironment* GetEnvironment() { return this->Environment; }

  ///@{
  /**
   * About the last Read.
   */
  vtkGetMacro(ErrorMessage, std::string);
  vtkGetMacro(Notes, std::string);
  ///@}

protected:
  vtkEnvironmentReader() = default;
  ~vtkEnvironmentReader() override = default;

  std::string FileName;
  std::string ErrorMessage;
  std::string Notes;
  vtkSmartPointer<vtkEnvironment> Environment;

private:
  vtkEnvironmentReader(const vtkEnvironmentReader&) = delete;
  void operator=(const vtkEnvironmentReader&) = delete;
};

#endif
