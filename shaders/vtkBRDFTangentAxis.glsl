// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  // No tangents in the data: turn around the environment's up axis.
  brdfFrame = brdfFrameAbout(normalVCVSOutput, cross(vec3(0.0, 1.0, 0.0) * envMatrix, normalVCVSOutput));
