// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The materials that the charts have beside the one that is shown. No widgets.
 */

#ifndef Comparison_h
#define Comparison_h

#include "Curves.h"
#include "Session.h"

#include "vtkBRDF.h"
#include "vtkSmartPointer.h"

#include <QObject>

#include <string>
#include <vector>

namespace explorer
{
struct ComparedMaterial
{
  std::string File;
  std::string Name;
  vtkSmartPointer<vtkBRDF> BRDF; // prepared
  Curve Albedo;
  ModelValues Values;                              // of a model
  vtkSmartPointer<vtkBTDF> Transmission = nullptr; // null: none
  Curve Transmittance = {};                        // empty: none
};

/// Reads in the background what State::Compared names; what cannot be read is taken out of it, with
/// a message.
class Comparison : public QObject
{
  Q_OBJECT

public:
  Comparison(Session* session, Jobs* jobs, QObject* parent = nullptr);

  /// Take a material in or out. Above MostCompared: a message, and nothing changes.
  void SetCompared(const std::string& file, bool isCompared);
  bool IsCompared(const std::string& file) const;

  /// Those that have been read, as State::Compared has them.
  const std::vector<ComparedMaterial>& GetMaterials() const { return this->Materials; }

signals:
  void changed();

private:
  void Update();
  void Read(const std::string& file, const ModelStates& models, const Jobs::Post& post);
  void Take(const ComparedMaterial& material);

  Session* Model;
  Jobs* Background;
  std::vector<ComparedMaterial> Materials;
};
} // namespace explorer

#endif
