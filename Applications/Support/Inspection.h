// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `info` and the explorer say of a material, of what it lets through, and of a mesh.
 */

#ifndef Inspection_h
#define Inspection_h

#include "Inputs.h"

#include "vtkBTDF.h"

#include <nlohmann/json.hpp>

#include <array>
#include <string>

namespace tool
{
/// Model, range, albedo by angle, reciprocity, negative values, transmission and more, measured:
/// what `info --json` prints. Takes about a second, transmission a few more. Throws Error.
nlohmann::ordered_json InspectMaterial(const Material& material);

enum class TransmissionRole
{
  View,     // of a white sky on the other side, seen from that angle
  Light,    // of light from that angle
  BackLight // the same of light on the back
};

/// RGB at a polar angle in degrees: at azimuth 0; of anisotropic materials the mean over 8
/// azimuths, as the albedos of `info`. Throws Error where this thread's work is stopped.
std::array<double, 3> MeasureTransmittance(
  vtkBTDF* transmission, double degrees, TransmissionRole role);

/// At the angles of info["reflectance_per_angle"], which is InspectMaterial's; and whether light
/// that is reflected and transmitted is more than what comes.
nlohmann::ordered_json InspectTransmission(
  vtkBTDF* transmission, const nlohmann::ordered_json& info);

/// Points, triangles, bounds, and the predicted error of leaving occlusion out, for a matte and a
/// glossy material under each built-in map: what `info MESH --json` prints. Throws Error.
nlohmann::ordered_json InspectMesh(const std::string& file);
} // namespace tool

#endif
