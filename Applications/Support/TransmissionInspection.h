// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What `info` and the explorer say of what a material lets through.
 */

#ifndef TransmissionInspection_h
#define TransmissionInspection_h

#include "vtkBTDF.h"

#include <nlohmann/json.hpp>

#include <array>
#include <string>

namespace tool
{
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

/// The same for people.
std::string FormatTransmission(const nlohmann::ordered_json& transmission);
} // namespace tool

#endif
