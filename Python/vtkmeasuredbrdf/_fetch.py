# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Downloads published materials and environments by pooch, from the list of `measured-brdf fetch` and into its folder."""

from __future__ import annotations

import functools
import importlib.util
import io
import os
import sys
from typing import Any

from ._errors import fail_to_find


@functools.lru_cache(maxsize=None)
def get_catalog() -> dict[str, dict[str, Any]]:
    """What can be downloaded, by name. What a file does not say itself, its collection says for all."""
    import json

    with open(os.path.join(os.path.dirname(__file__), "FetchCatalog.json"), encoding="utf-8") as file:
        collections = json.load(file)["collections"]
    catalog = {}
    for collection in collections:
        for own in collection["files"]:
            own = {"name": own} if isinstance(own, str) else own
            entry = {"begins_with": "", "sha256": "", **collection, **own}
            for key in ("entry", "file", "url", "page"):
                entry[key] = entry[key].replace("{name}", own["name"])
            catalog[entry["entry"]] = entry
    return catalog


def get_folder() -> str:
    """Where files are kept: on Linux the folder of the C++ program `measured-brdf`, which finds them there."""
    try:
        import pooch
    except ImportError:
        raise ImportError("vtkmeasuredbrdf.fetch needs pooch: pip install pooch tqdm") from None
    return os.path.join(pooch.os_cache("vtkMeasuredBRDF"), "vtkMeasuredBRDF-files")


def find_fetched(name: str, kind: str, embedded: list[str]) -> str:
    """The file of a published "material" or "environment". Raises ValueError where it was not downloaded."""
    published = {key: entry for key, entry in get_catalog().items() if entry["kind"] == kind}
    if name not in published:
        fail_to_find(name, [*embedded, *published], f"neither a file nor the name of an embedded or published {kind}")
    path = os.path.join(get_folder(), published[name]["file"])
    if not os.path.exists(path):
        raise ValueError(f"{name!r} was not downloaded yet; vtkmeasuredbrdf.fetch({name!r}) does that "
                         f"({published[name]['licence']}, {published[name]['page']})")
    return path


def fetch(name: str, *, sha256: str = "", trust_first: bool = False) -> str:
    """Downloads a published material or environment, once, and returns the path of its file.

        >>> satin = vtkmeasuredbrdf.fetch("satin_purple")

    Afterwards `Material("satin_purple")` and `measured-brdf render satin_purple` find it, too. Needs pooch, and tqdm for
    a progress bar. The licence is said before the download.

    Parameters
    ----------
    name
        A name of `measured-brdf fetch --list`, or its file's.
    sha256
        Your own checksum in place of the list's.
    trust_first
        Take what comes first of a file whose checksum nobody knows, and check against that from then on.

    Raises
    ------
    ValueError
        There is no such name, the checksum is not known or is wrong, or what came is no such file.
    OSError
        The download failed.
    """
    catalog = get_catalog()
    names = {entry["file"]: name for name, entry in catalog.items()}
    name = names.get(name, name)
    if name not in catalog:
        fail_to_find(name, list(catalog), "no published material or environment")
    entry, folder = catalog[name], get_folder()
    path = os.path.join(folder, entry["file"])
    record = path + ".sha256"
    known = sha256.lower() or entry["sha256"]
    if not known and os.path.exists(record):
        with open(record, encoding="ascii") as file:
            known = file.read(64)
    if not known and not trust_first:
        raise ValueError(f"{name}: nobody knows the SHA-256 of {entry['url']}, so a wrong file could not be told from the "
                         "right one. Give it by sha256, or choose trust_first")
    if not known and os.path.exists(path):
        os.remove(path)  # it was not finished: its sum would stand beside it
    import pooch

    if not os.path.exists(path):
        pooch.get_logger().info("%s, %s\n  Licence: %s, %s\n  %s",
                                *(entry[key] for key in ("title", "page", "licence", "licence_url", "terms")))
    store = pooch.create(folder, "", registry={entry["file"]: known or None}, urls={entry["file"]: entry["url"]},
                         retry_if_failed=2)
    store.fetch(entry["file"], downloader=functools.partial(_download, entry))
    if not known:
        with open(record, "w", encoding="ascii") as file:
            file.write(f"{pooch.file_hash(path)}  {entry['file']}\n")
    return path


class _Bounded(io.FileIO):
    """A file that grows no further than to its limit."""

    limit = 0

    def write(self, data: Any) -> int:
        if self.tell() + len(data) > self.limit:
            raise OSError(f"the server sends more than the {self.limit} bytes expected")
        return super().write(data)


def _download(entry: dict[str, Any], url: str, path: str, store: Any) -> None:
    """What pooch calls."""
    import pooch

    with _Bounded(path, "w+") as file:
        file.limit = entry.get("size", entry["limit"])
        pooch.HTTPDownloader(progressbar=importlib.util.find_spec("tqdm") is not None)(url, file, store)
        size = file.tell()
        if size != entry.get("size", size):
            raise OSError(f"{url}: {size} bytes came, expected {entry['size']}")
        file.seek(0)
        begin = entry["begins_with"].encode()
        if file.read(len(begin)) != begin:
            raise OSError(f"{url}: what came does not begin with {entry['begins_with']!r}")


def main(arguments: list[str]) -> None:
    """`measured-brdf fetch`."""
    import argparse

    parser = argparse.ArgumentParser("measured-brdf fetch", description="Download published materials and environments.")
    parser.add_argument("names", metavar="NAME", nargs="*")
    parser.add_argument("--list", action="store_true", help="print what there is; with NAMEs, what has them in its name")
    parser.add_argument("--sha256", default="", help="your own checksum in place of the list's")
    parser.add_argument("--trust-first", action="store_true", help="take a file whose checksum nobody knows")
    options = parser.parse_args(arguments)
    if options.list:
        for name, entry in get_catalog().items():
            if not options.names or any(part in name for part in options.names):
                print(f"{name:34} {entry['kind']:12} {'' if entry['sha256'] else 'no checksum':12} {entry['title']}")
        return
    if not options.names:
        parser.error("expected a NAME, or --list")
    for name in options.names:
        try:
            print(fetch(name, sha256=options.sha256, trust_first=options.trust_first))
        except (ImportError, OSError, ValueError) as error:
            sys.exit(f"measured-brdf fetch: {error}")
