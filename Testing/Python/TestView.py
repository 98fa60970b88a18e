# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of vtkmeasuredbrdf.view, without a browser: changes of its state change the pictures, and faults are said."""

import asyncio
import base64
import importlib.util
import io
import sys

for module in ("pyvista", "PIL", "trame", "trame_vuetify"):
    if importlib.util.find_spec(module) is None:
        print(f"Skipped: {module} is not installed")
        sys.exit(77)

import numpy as np
from PIL import Image

from vtkmeasuredbrdf import view


def decode(picture):
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(picture.partition(",")[2]))))


async def change(page, **values):
    """Asks for something and waits for the pictures."""
    with page.state:
        page.state.update(values)
    await asyncio.sleep(1.0)
    while page.mapper.GetPlanPending():
        await asyncio.sleep(0.1)
    await asyncio.sleep(0.2)
    state = page.state
    return {name: state[name] for name in ("picture", "lobe", "charts", "plan", "error", "problems")}


async def main():
    page = view.app("missing.bsdf", environment="hall", mesh="sphere", tolerance=0.1)
    await page.ui.ready
    found = await change(page)
    assert len(found["problems"]) == 1 and "missing.bsdf" in found["problems"][0], found["problems"]
    first = await change(page, material="gold-paint")
    picture = decode(first["picture"])
    assert picture[330, 440].max() > 60 and picture.std() > 20, picture[330, 440]
    assert not first["problems"] and "predicted error" in first["error"] and first["plan"], first
    assert decode(first["lobe"]).std() > 20 and first["charts"].count("<polyline") == 17, first["charts"]

    last = first
    for values, changed in (
        ({"material": "nickel"}, {"picture", "lobe", "charts", "plan"}),
        ({"angle": 60}, {"lobe", "charts"}),
        ({"rotation": 90}, {"picture"}),
        ({"environment": "sky"}, {"picture", "plan"}),
        ({"mesh": "vase"}, {"picture"}),
        ({"azimuth": 100}, {"picture"}),
        ({"material": "gold-paintt", "mesh": "missing.ply"}, {"problems"}),
        ({"material": "nickel", "mesh": "vase"}, {"problems"}),
    ):
        found = await change(page, **values)
        differs = {name for name in found if found[name] != last[name]}
        assert changed <= differs and (changed != {"problems"} or "picture" not in differs), (values, differs)
        last = found
    assert not last["problems"], last["problems"]
    print(last["error"])
    await page.server.stop()


asyncio.run(main())
