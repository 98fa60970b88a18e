// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBRDFExchange
 * @brief   carries a material's parameters to or from a vtkBRDFData
 *
 * A model names each of its parameters once, in vtkBRDF::ExchangeData, with its present value and
 * the function that sets it. When the material is saved the values are read; when it is loaded the
 * functions are called with what the data hold. Names are in lower camel case.
 *
 * A problem ends the exchange by an exception (Fail), which vtkBRDFModels reports. A material that
 * was loaded with a problem is discarded, so it does not matter how much of it was set.
 */

#ifndef vtkBRDFExchange_h
#define vtkBRDFExchange_h

#include "vtkBRDFData.h"           // for LoadArray
#include "vtkMeasuredBRDFModule.h" // for export macro

#include <cstddef>    // for LoadArray
#include <functional> // for setters
#include <string>     // for names
#include <vector>     // for arrays

class vtkBRDF;

class VTKMEASUREDBRDF_EXPORT vtkBRDFExchange
{
public:
  vtkBRDFExchange(vtkBRDFData& data, bool loading);
  virtual ~vtkBRDFExchange();
  vtkBRDFExchange(const vtkBRDFExchange&) = delete;
  void operator=(const vtkBRDFExchange&) = delete;

  /// Whether the material gets its parameters from the data; otherwise the data get the material's.
  bool IsLoading() const { return this->Loading; }

  /// The model's name in the data.
  const std::string& GetModelName() const { return this->Data.Model; }

  ///@{
  /**
   * A number, or a triple of them; member has to be the variable that set changes. Values that are
   * not finite, and values that set refuses or clamps, are problems.
   */
  void Number(
    const std::string& name, const double& member, const std::function<void(double)>& set);
  void Number(
    const std::string& name, double&& member, const std::function<void(double)>& set) = delete;
  void Triple(const std::string& name, const double (&member)[3],
    const std::function<void(const double*)>& set);
  ///@}

  ///@{
  /**
   * One of a few choices, by its index, or "off" and "on"; other texts in the data are problems.
   */
  void Flag(const std::string& name, bool value, const std::function<void(bool)>& set);
  void Option(const std::string& name, const std::vector<std::string>& choices, int value,
    const std::function<void(int)>& set);

  /// When saving: an array. Its shape has the slowest axis first; channels (1 or 3) interleave.
  void SaveArray(const std::string& name, const std::vector<int>& shape, int channels,
    const std::vector<float>& values);

  /// When loading: take an array with that number of axes and channels out of the data.
  vtkBRDFData::Array LoadArray(const std::string& name, std::size_t axes, int channels);

  /**
   * For a model that has no parameters: it says so. One that names none and does not say so has
   * forgotten to override vtkBRDF::ExchangeData, which is a problem.
   */
  void NoParameters() { this->Named = true; }
  bool HasNamed() const { return this->Named; }

  /// The materials of which this one is made; add is called for each one that was loaded.
  void Terms(
    const std::vector<vtkBRDF*>& terms, int maximum, const std::function<void(vtkBRDF*)>& add);

  ///@{
  /**
   * Throw std::runtime_error "MODEL: problem" (Check: unless the problem is empty).
   */
  [[noreturn]] void Fail(const std::string& problem) const;
  void Check(const std::string& problem) const;
  ///@}

protected:
  ///@{
  /**
   * For Terms.
   */
  virtual void SaveTerm(vtkBRDF* term, vtkBRDFData& data) = 0;
  virtual void LoadTerm(vtkBRDFData& data, const std::function<void(vtkBRDF*)>& add) = 0;
  ///@}

private:
  /// set: takes the numbers; a problem where member then differs.
  void Numbers(const std::string& name, const double* member, std::size_t count,
    const std::function<void(const double*)>& set);

  vtkBRDFData& Data;
  const bool Loading;
  bool Named = false;
};

#endif
