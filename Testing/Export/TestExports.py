# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Today's exported files are those that MaterialX, OpenUSD and ParaView have read: TestExports.py WRITER CASES RECORDED."""

import hashlib
import json
import os
import subprocess
import sys
import tempfile


def main():
    writer, cases, recorded = sys.argv[1:]
    with open(recorded, encoding="ascii") as file:
        record = json.load(file)
    if (record["format"], record["version"]) != ("measured-brdf exports", 1):
        print(f"{recorded}: not of the format that this test reads")
        return 1
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([writer, cases, folder], check=True)
        written = {name for name in os.listdir(folder) if name.endswith((".mtlx", ".usda", ".py"))}
        for name in sorted(written | set(record["files"])):
            if name not in written or name not in record["files"]:
                failures += 1
                print(f"{name}: only {'written' if name in written else 'recorded'}")
                continue
            with open(os.path.join(folder, name), "rb") as file:
                if hashlib.sha256(file.read()).hexdigest() != record["files"][name]:
                    failures += 1
                    print(f"{name}: not what MaterialX {record['materialx']}, USD {record['usd']} and "
                          f"ParaView {record['paraview']} have read; run validate_exports.py")
    print(f"{len(record['files'])} files compared")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
