// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * vtkLODActor and vtkQuadricLODActor draw levels of detail that they make themselves with mappers
 * of their own, which know no material. A mapper is told by the actor it is drawn with.
 */

#ifndef StockLevels_h
#define StockLevels_h

class vtkActor;
class vtkMapper;
class vtkRenderer;

namespace measuredbrdf
{
/**
 * The class that draws stock levels of detail of what the mapper draws with this actor now; null
 * where none does, or where its property is physically based already (fitted, that is). Cheap where
 * the actor is the mapper's own; else it looks through the renderer's actors.
 */
const char* FindStockLevels(vtkRenderer* renderer, vtkActor* actor, vtkMapper* mapper);
} // namespace measuredbrdf

#endif
