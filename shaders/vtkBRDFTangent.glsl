// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
  brdfFrame = brdfFrameAbout(normalVCVSOutput, brdfTangentVCVSOutput);
