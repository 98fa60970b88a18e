# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""No wrapped method crashes, hangs or takes all memory, whatever its arguments are.

    TestArguments.py           all classes, each method on an object of its own; exit status 1 where one does not survive
    TestArguments.py CLASS...  these

The calls run in a child process; where it ends, its last line names the call, and another child goes on behind it.
"""
import faulthandler
import itertools
import math
import os
import resource
import subprocess
import sys

SECONDS = 60  # of a call
BYTES = 6 << 30  # of address space
HUGE = 2**31 - 1
# One argument of each kind in each place; of two and more, all alike, and numbers in other orders.
VALUES = (None, math.nan, math.inf, -1, 0, 1, HUGE, -HUGE - 1, 1e308, "", "no such name", (), (math.nan,) * 3)
NUMBERS = (math.nan, -math.inf, -1, 0, 64, HUGE)
# VTK's macro makes them for every class; they end with None.
LEFT_OUT = {"GetNumberOfGenerationsFromBase", "GetNumberOfGenerationsFromBaseType", "IsA", "IsTypeOf"}
# No base of ours: VTK's own, from here on.
FOREIGN = ("vtkObject", "vtkObjectBase", "vtkActor2D", "vtkImageAlgorithm", "vtkPassInputTypeAlgorithm",
           "vtkPolyDataAlgorithm", "vtkPolyDataMapper", "vtkTableAlgorithm", "vtkOpenGLPolyDataMapper",
           "vtkCompositePolyDataMapper", "vtkCompositePolyDataMapper2", "object")


def get_arguments():
    yield ()
    for value in VALUES:
        for count in range(1, 5):
            yield (value,) * count
    for first, second in itertools.permutations(NUMBERS, 2):
        yield (first, second)


def get_classes(module):
    """(class, an object of it, names that it and its bases of ours define), in a fixed order."""
    for name in sorted(dir(module)):
        cls = getattr(module, name)
        if not isinstance(cls, type) or not name.startswith("vtk"):
            continue
        try:
            made = cls()
        except (TypeError, NotImplementedError):
            continue  # abstract
        if not hasattr(made, "AddObserver"):
            continue  # a plain structure
        own = set()
        for base in cls.__mro__:
            if base.__name__.split(".")[-1] in FOREIGN:
                break
            own |= {key for key in base.__dict__ if not key.startswith("__")}
        yield cls, made, own


def call_all(first, classes):
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (the renderer)
    from vtkmodules.vtkCommonCore import vtkObject

    import vtkmeasuredbrdf as module

    vtkObject.GlobalWarningDisplayOff()
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    calls = [(cls, method) for cls, _, own in get_classes(module) for method in sorted(own - LEFT_OUT)
             if not classes or cls.__name__ in classes]
    number = 0
    for cls, method in calls:
        if number + 1000 < first:  # each has fewer calls
            number += 1000
            continue
        function = getattr(cls(), method, None)  # VTK 9.6 has properties that can only be set
        for index, arguments in enumerate(get_arguments() if callable(function) else ()):
            if number + index < first:
                continue
            print(number + index, f"{cls.__name__}.{method}{arguments}", flush=True)
            faulthandler.dump_traceback_later(SECONDS, exit=True)
            try:
                function(*arguments)
            except (TypeError, ValueError, OverflowError, AttributeError):
                pass  # of another type
            faulthandler.cancel_dump_traceback_later()
        number += 1000
    print("end")


def main(classes):
    first, failed, calls = 0, [], 0
    while len(failed) < 20:
        child = subprocess.run([sys.executable, "-B", __file__, "--from", str(first), *classes], check=False,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")
        lines = child.stdout.splitlines()
        calls += len(lines)
        if lines and lines[-1] == "end":
            break
        if not lines or not lines[-1].split(" ")[0].isdigit():
            sys.exit(f"the child ended with {child.returncode}:\n{child.stdout[-2000:]}\n{child.stderr[-2000:]}")
        number, call = lines[-1].split(" ", 1)
        failed.append(f"{call}: ended with status {child.returncode}")
        first = (int(number) // 1000 + 1) * 1000  # the next method
    print(f"{calls} calls")
    print("\n".join(failed))
    assert classes or calls > 20000, calls
    return 1 if failed else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--from"]:
        call_all(int(sys.argv[2]), sys.argv[3:])
        sys.stdout.flush()
        os._exit(0)  # what unused objects leave at the end is another test's
    sys.exit(main(sys.argv[1:]))
