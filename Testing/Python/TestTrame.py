# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Examples/Python/trame_materials.py draws what its page asks for, and says what is wrong. trame itself is a stand-in."""

import importlib.util
import os
import sys
import types
from unittest import mock

for module in ("pyvista", "PIL"):
    if importlib.util.find_spec(module) is None:
        print(f"Skipped: {module} is not installed")
        sys.exit(77)

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class State(types.SimpleNamespace):
    """What the page and the server share."""

    def update(self, values):
        vars(self).update(values)

    def change(self, *names):
        assert set(names) <= set(vars(self)), names
        return lambda function: function


def load_example():
    trame = {name: mock.MagicMock() for name in ("trame", "trame.app", "trame.ui", "trame.ui.vuetify3", "trame.widgets")}
    trame["trame.app"].get_server.return_value.state = State()
    path = os.path.join(ROOT, "Examples", "Python", "trame_materials.py")
    spec = importlib.util.spec_from_file_location("trame_materials", path)
    example = importlib.util.module_from_spec(spec)
    sys.modules.update(trame)
    spec.loader.exec_module(example)
    return example


example = load_example()
state = example.state
pictures = []
for material in ("blue-car-paint", "nickel", "missing.bsdf", "gold-paint"):
    state.material = material
    example.draw()
    if material == "missing.bsdf":
        assert material in state.problem, state.problem
        continue
    assert not state.problem and "predicted error" in state.error and state.plan, vars(state)
    assert state.picture.startswith("data:image/jpeg"), state.picture[:40]
    pictures.append(state.picture)
assert len(set(pictures)) == 3
print(state.error)
