# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every property of every class is printed, and copies have every property.

A property is a pair of methods SetX and GetX that the module's own classes define. The test finds
them by itself: a new one that PrintSelf or a copy forgets makes it fail.
"""
import re
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from TestArguments import get_classes

import vtkmeasuredbrdf as module

# What PrintSelf shows in another way: data of any size, a switch of a running call, and properties
# that take a further argument.
NOT_PRINTED = {
    ("vtkBTDF", "Folded"),
    ("vtkBasisBRDF", "Coefficients"),
    ("vtkCompositeMeasuredBRDFMapper", "BlockBRDF"),
    ("vtkEnvironment", "Pixels"),
    ("vtkMaterialMap", "BRDF"),
    ("vtkMaterialMap", "Name"),
    ("vtkMaterialMap", "WeightArrayName"),
    ("vtkTabulatedBRDF", "Volume"),
    ("vtkTracedRadianceIntegrator", "SurfaceBRDF"),
}
SWITCHES = {"Abort", "AbortPlanning"}
VALUES = (True, False, 2, 3, 5, 17, 0.25, 0.75, 0.03, 40.0, 1, 0, "text")


def change(obj, name):
    """Sets a property of one number, switch or text to another value; returns whether it could."""
    try:
        before = getattr(obj, "Get" + name)()
    except TypeError:
        return False  # it takes an argument
    if not isinstance(before, (bool, int, float, str)):
        return False
    for value in VALUES:
        try:
            getattr(obj, "Set" + name)(value)
        except TypeError:
            continue
        if getattr(obj, "Get" + name)() != before:
            return True
    return False


problems = []
printed = copied = 0
for cls, obj, own in get_classes(module):
    name = cls.__name__
    obj.AddObserver("ErrorEvent", lambda *_: None)  # of values that a setter refuses
    obj.AddObserver("WarningEvent", lambda *_: None)
    properties = sorted(key[3:] for key in own if key.startswith("Set") and "Get" + key[3:] in own)
    shown = {line.split(":")[0].strip().replace(" ", "") for line in str(obj).splitlines() if ":" in line}
    for prop in properties:
        if prop not in SWITCHES and (name, prop) not in NOT_PRINTED:
            printed += 1
            # Integrators print their sizes by name: "rows" is NumberOfRows.
            size = re.sub("^(Maximum)?NumberOf", "", prop).lower()
            if prop not in shown and size not in shown:
                problems.append(f"{name}: PrintSelf does not show {prop}")
    if hasattr(obj, "NewSnapshot"):
        make_copy = obj.NewSnapshot
    elif hasattr(obj, "NewCopy"):
        make_copy = obj.NewCopy
    elif hasattr(obj, "ShallowCopy") and "Mapper" in name:
        def make_copy(cls=cls, obj=obj):
            other = cls()
            other.ShallowCopy(obj)
            return other
    else:
        continue
    changed = [prop for prop in properties if prop not in SWITCHES and change(obj, prop)]
    other = make_copy()
    if other is None:
        continue  # a material without snapshots
    for prop in changed:
        copied += 1
        if getattr(other, "Get" + prop)() != getattr(obj, "Get" + prop)():
            problems.append(f"{name}: a copy does not have {prop}")
for name, prop in sorted(NOT_PRINTED):
    if not hasattr(getattr(module, name), "Set" + prop):
        problems.append(f"{name}: there is no {prop} any more")
print(f"{printed} properties are printed, {copied} are copied")
assert printed > 150 and copied > 50, (printed, copied)
if problems:
    sys.exit("\n".join(problems))
