# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every property of every class is printed, and copies have every property.

A property is a pair of methods SetX and GetX that the module's own classes define. The test finds
them by itself: a new one that PrintSelf or a copy forgets makes it fail. No method crashes where None
is given for its arguments.
"""
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
from vtkmodules.vtkCommonCore import vtkObject

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
    ("vtkAnisotropicTabulatedBRDF", "Volume"),
    ("vtkTabulatedBRDF", "Volume"),
    ("vtkTracedRadianceIntegrator", "SurfaceBRDF"),
}
SWITCHES = {"Abort", "AbortPlanning"}
# No base of ours: VTK's own, from here on.
FOREIGN = {
    "vtkObject",
    "vtkObjectBase",
    "vtkActor2D",
    "vtkImageAlgorithm",
    "vtkPassInputTypeAlgorithm",
    "vtkPolyDataAlgorithm",
    "vtkPolyDataMapper",
    "vtkTableAlgorithm",
    "vtkOpenGLPolyDataMapper",
    "vtkCompositePolyDataMapper",
    "vtkCompositePolyDataMapper2",
    "object",
}
VALUES = (True, False, 2, 3, 5, 17, 0.25, 0.75, 0.03, 40.0, 1, 0, "text")


def get_classes():
    for name in sorted(dir(module)):
        cls = getattr(module, name)
        if isinstance(cls, type) and name.startswith("vtk"):
            try:
                obj = cls()
            except (TypeError, NotImplementedError):
                continue  # abstract
            if hasattr(obj, "AddObserver"):  # else a plain structure
                yield name, cls, obj


def get_properties(cls):
    own = set()
    for base in cls.__mro__:
        if base.__name__.split(".")[-1] in FOREIGN:
            break
        own |= set(base.__dict__)
    return sorted(f[3:] for f in own if f.startswith("Set") and "Get" + f[3:] in own)


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


def call_with_none():
    """A crash ends the test: its output ends with the method."""
    vtkObject.GlobalWarningDisplayOff()
    count = 0
    for name, cls, obj in get_classes():
        stock = {k for base in cls.__mro__ if base.__name__.split(".")[-1] in FOREIGN for k in dir(base)}
        for method in sorted(set(dir(cls)) - stock):
            function = getattr(obj, method, None)  # VTK 9.6 has properties that can only be set
            for arguments in range(1, 5):
                if callable(function):
                    print(f"{name}.{method}({', '.join(['None'] * arguments)})", flush=True)
                    try:
                        function(*[None] * arguments)
                        count += 1
                    except (TypeError, ValueError):
                        pass  # of a type that None is not
    vtkObject.GlobalWarningDisplayOn()
    return count


problems = []
printed = copied = 0
for name, cls, obj in get_classes():
    obj.AddObserver("ErrorEvent", lambda *_: None)  # of values that a setter refuses
    obj.AddObserver("WarningEvent", lambda *_: None)
    properties = get_properties(cls)
    shown = {line.split(":")[0].strip().replace(" ", "") for line in str(obj).splitlines() if ":" in line}
    for prop in properties:
        if prop not in SWITCHES and (name, prop) not in NOT_PRINTED:
            printed += 1
            if prop not in shown:
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
taken = call_with_none()
print(f"{taken} calls took None")
assert taken > 50, taken
