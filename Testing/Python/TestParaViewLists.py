# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""The lists in the ParaView plugin's panels are the module's: built-in materials and environments, endings of files."""
import os
import re
import xml.etree.ElementTree as ElementTree

from vtkmeasuredbrdf import vtkBRDFFormats, vtkEmbeddedEnvironments, vtkEmbeddedMaterials

FOLDER = os.path.join(os.path.dirname(__file__), "..", "..", "Hosts", "ParaView", "Plugin", "Module")
MATERIALS = [vtkEmbeddedMaterials.GetName(k) for k in range(vtkEmbeddedMaterials.GetNumberOfMaterials())]
ENVIRONMENTS = [vtkEmbeddedEnvironments.GetName(k) for k in range(vtkEmbeddedEnvironments.GetNumberOfEnvironments())]
EXPECTED = {
    "Material": ["File", *MATERIALS],
    "MeasuredMaterial": ["File", *MATERIALS],
    "MeasuredEnvironment": ["Automatic", "View", "File", *ENVIRONMENTS],
}

ENDINGS = sorted(re.findall(r"\.(\w+)", vtkBRDFFormats.GetExtensions()))
assert {"bsdf", "xompt", "astm"} <= set(ENDINGS), ENDINGS

seen = 0
choosers = 0
for proxy in ElementTree.parse(os.path.join(FOLDER, "MeasuredMaterials.xml")).iter():
    for prop in proxy.findall("StringVectorProperty"):
        chooser = prop.find("Hints/FileChooser")
        if chooser is not None and chooser.get("file_description") == "Measured materials":
            assert sorted(chooser.get("extensions").split()) == ENDINGS, (chooser.get("extensions"), ENDINGS)
            choosers += 1
        domain = prop.find("StringListDomain")
        if domain is None:
            continue
        values = [string.get("value") for string in domain.findall("String")]
        assert values == EXPECTED[prop.get("name")], (prop.get("name"), values)
        assert prop.get("default_values") in values, prop.get("name")
        seen += 1
assert seen == 3, seen
assert choosers == 2, choosers
