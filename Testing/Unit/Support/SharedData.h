// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Real materials and environments, where they lie beside the checkout.
 */

#ifndef SharedData_h
#define SharedData_h

#include <string>

const std::string SharedData = MEASUREDBRDF_SHARED_DATA;

#endif
