#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
# SPDX-License-Identifier: BSD-3-Clause
"""Puts small faults into the code, one at a time, and says which tests notice them.

The faults are in faults.py. Each one is written into a copy of the source tree, never into your own files; the copy is
built, the tests that cover the place run, and the text is restored. Exit status: 0 if at least 95 % of the faults were
noticed and all of them compile. Faults that are marked as equivalent do not count.
"""

import argparse
import collections
import filecmp
import fnmatch
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

from faults import COMPONENTS, FAULTS, FOLDERS

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FEWEST = 100
SHARE = 0.95
LIMIT = 900  # seconds for a fault's tests in one program; one that makes them run longer is noticed
# What lies in these folders is no source.
SKIPPED = (".git", "__pycache__", "output", "install")
OPTIONS = ("-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=ON", "-DMEASUREDBRDF_WRAP_PYTHON=OFF",
           "-DMEASUREDBRDF_WITH_QT=OFF", "-DMEASUREDBRDF_WARNINGS_AS_ERRORS=OFF",
           "-DMEASUREDBRDF_COMPILE_IN_GROUPS=OFF")
DISPLAY = ("xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset")


def read(path):
    return pathlib.Path(path).read_text(encoding="utf-8")


class Tests:
    """The tests in the GoogleTest sources, and the CMake targets that they belong to."""

    def __init__(self):
        self.targets = {}  # by test, as Suite.Name
        for folder in ("Unit", "Render"):
            self.add_folder(os.path.join(ROOT, "Testing", folder))

    def add_folder(self, folder):
        lists = re.sub(r"#[^\n]*", "", read(os.path.join(folder, "CMakeLists.txt")))
        for command in re.finditer(r"(?:add_(?:unit|internal|render)_test|target_sources)\s*\(\s*(\w+)([^)]*)\)",
                                   lists):
            for source in re.findall(r"(?<!\S)[\w/]+\.cxx", command.group(2)):
                path = os.path.join(folder, source)
                if not os.path.exists(path):
                    continue
                for suite, name in re.findall(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", read(path), re.MULTILINE):
                    self.targets.setdefault(f"{suite}.{name}", set()).add(command.group(1))

    def find(self, expression):
        """The tests that a regular expression finds, with the targets of each."""
        return {test: targets for test, targets in self.targets.items() if re.search(expression, test)}

    def find_targets(self, expression):
        return sorted(set().union(*self.find(expression).values()))


def find_problems(tests):
    """What is wrong with the list of faults, one line each."""
    problems = []
    if len(FAULTS) < FEWEST:
        problems.append(f"{len(FAULTS)} faults, expected at least {FEWEST}")
    counts = collections.Counter(fault.id for fault in FAULTS)
    problems += [f"{id}: {count} faults have this name" for id, count in counts.items() if count > 1]
    components = {fault.id.split(".")[0] for fault in FAULTS}
    problems += [f"{component}: no fault" for component in COMPONENTS if component not in components]
    for fault in FAULTS:
        component = fault.id.split(".")[0]
        folder = FOLDERS.get(component, f"Module/{component}/")
        if component not in COMPONENTS or not fault.file.startswith(folder):
            problems.append(f"{fault.id}: the name begins with the component of its file, one of {', '.join(COMPONENTS)}")
        if not os.path.exists(os.path.join(ROOT, fault.file)):
            problems.append(f"{fault.id}: there is no file {fault.file}")
            continue
        count = read(os.path.join(ROOT, fault.file)).count(fault.old)
        if count != 1:
            problems.append(f"{fault.id}: its text is {count} times in {fault.file}, expected once:\n{fault.old}")
        if fault.new == fault.old:
            problems.append(f"{fault.id}: changes nothing")
        for part in fault.tests.split("|"):
            if not tests.find_targets(part):
                problems.append(f"{fault.id}: no test matches {part}")
    return problems


class Copy:
    """A copy of the source tree and its build, in one folder."""

    def __init__(self, arguments):
        self.folder = os.path.abspath(arguments.build)
        self.source = os.path.join(self.folder, "source")
        self.build = os.path.join(self.folder, "build")
        self.jobs = str(arguments.jobs)
        os.makedirs(self.folder, exist_ok=True)

    def update(self):
        """Brings the copy to the state of the repository; equal files keep their time, so little is rebuilt."""

        def skip(folder, names):
            top = folder == ROOT
            return [name for name in names if name in SKIPPED or (top and name.startswith("build"))
                    or os.path.join(folder, name) == self.folder or os.path.islink(os.path.join(folder, name))]

        def copy(one, other):
            if not os.path.exists(other) or not filecmp.cmp(one, other, shallow=False):
                shutil.copy(one, other)

        shutil.copytree(ROOT, self.source, ignore=skip, copy_function=copy, dirs_exist_ok=True)
        for path in pathlib.Path(self.source).rglob("*"):  # what is no longer in the repository
            if path.is_file() and not os.path.exists(os.path.join(ROOT, path.relative_to(self.source))):
                path.unlink()

    def run(self, command, log, limit=None):
        """The exit status, None beyond the time limit; nothing of the command goes on after this returns."""
        with open(os.path.join(self.folder, log), "w", encoding="utf-8") as file:
            process = subprocess.Popen(command, cwd=self.folder, env=dict(os.environ, LIBGL_ALWAYS_SOFTWARE="1"),
                                       stdout=file, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                       start_new_session=True)
            try:
                return process.wait(limit)
            except subprocess.TimeoutExpired:
                return None
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
                    process.wait()

    def make(self, targets):
        """Whether the targets could be built."""
        return self.run(["cmake", "--build", self.build, "-j", self.jobs, "--target", *targets], "build.log") == 0

    def test(self, tests, targets, limit, every):
        """The names of the failed tests, or of the first one; ["time limit"] if they did not end."""
        failed = []
        for target in targets:
            needs_display = target.startswith("Render") and not os.environ.get("DISPLAY")
            names = [name for name in tests if target in tests[name]]
            status = self.run([*(DISPLAY if needs_display else ()), os.path.join(self.build, "bin", target), "--gtest_brief=1",
                               "--gtest_filter=" + ":".join(f"{name}:*/{name}/*" for name in names),
                               *(() if every else ("--gtest_fail_fast",))], "test.log", limit)
            if status is None:
                return ["time limit"]
            log = pathlib.Path(self.folder, "test.log").read_text(encoding="utf-8", errors="replace")
            found = sorted(set(re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", log, re.MULTILINE)))
            failed += found or ([f"{target}, which ended with status {status}"] if status != 0 else [])
            if failed and not every:
                break
        return failed


def try_fault(copy, fault, tests, known):
    """("noticed", names of tests), ("MISSED", []) or ("does not compile", [])"""
    path = pathlib.Path(copy.source, fault.file)
    text = path.read_text(encoding="utf-8")
    targets = tests.find_targets(fault.tests)
    try:
        path.write_text(text.replace(fault.old, fault.new), encoding="utf-8")
        if not copy.make(targets):
            return "does not compile", []
        # A test that always fails must not be the last.
        failed = [name for name in copy.test(tests.find(fault.tests), targets, LIMIT, bool(known)) if name not in known]
        return ("noticed", failed) if failed else ("MISSED", [])
    finally:
        path.write_text(text, encoding="utf-8")


def get_failures(copy, faults, tests):
    """Tests that fail without a fault: they notice nothing."""
    expression = "|".join(sorted({part for fault in faults for part in fault.tests.split("|")}))
    targets = tests.find_targets(expression)
    print(f"Building {len(targets)} test programs and running their tests without a fault ...", flush=True)
    if copy.run(["cmake", "-S", copy.source, "-B", copy.build, "-G", "Ninja", *OPTIONS], "configure.log") != 0:
        sys.exit(f"cmake failed, see {os.path.join(copy.folder, 'configure.log')}")
    if not copy.make(targets):
        sys.exit(f"the code does not compile, see {os.path.join(copy.folder, 'build.log')}")
    failed = copy.test(tests.find(expression), targets, None, True)
    if failed:
        print("These fail without a fault and are left out: " + ", ".join(failed))
    return set(failed)


def report(results):
    """Prints the table; the exit status."""
    print(f"\n{'component':<12} {'noticed':>7} {'missed':>6}")
    counts = collections.Counter((fault.id.split(".")[0], verdict) for fault, verdict in results if not fault.equivalent)
    for component in sorted({component for component, _ in counts}):
        print(f"{component:<12} {counts[component, 'noticed']:>7} {counts[component, 'MISSED']:>6}")
    verdicts = collections.Counter(verdict for fault, verdict in results if not fault.equivalent)
    counted = verdicts["noticed"] + verdicts["MISSED"]
    share = verdicts["noticed"] / counted if counted else 1.0
    print(f"{verdicts['noticed']} of {counted} faults were noticed ({100.0 * share:.1f} %).")
    for verdict in ("MISSED", "does not compile"):
        names = [fault.id for fault, other in results if other == verdict and not fault.equivalent]
        if names:
            print(f"{verdict}: " + ", ".join(names))
    return 0 if share >= SHARE and not verdicts["does not compile"] else 1


def interrupt(*_):
    raise KeyboardInterrupt


def try_faults(faults, tests, arguments):
    signal.signal(signal.SIGTERM, interrupt)
    copy = Copy(arguments)
    results = []
    try:
        copy.update()
        known = get_failures(copy, faults, tests)
        for number, fault in enumerate(faults, 1):
            start = time.monotonic()
            verdict, names = try_fault(copy, fault, tests, known)
            results.append((fault, verdict))
            note = f" by {', '.join(names[:3])}" if names else ""
            if fault.equivalent:
                note += f" (marked as equivalent: {fault.equivalent})"
            print(f"[{number}/{len(faults)}] {fault.id}: {verdict}{note}, {time.monotonic() - start:.0f} s", flush=True)
    except KeyboardInterrupt:
        print("\nInterrupted; the copy is restored.")
        report(results)
        return 130
    return report(results)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("faults", nargs="*", metavar="ID", default=["*"],
                        help="names of faults, which may have * and ? in them, e.g. 'Lighting.*'; default: all")
    parser.add_argument("--build", default=os.path.join(ROOT, "build-mutation"), metavar="DIR",
                        help="folder for the copy and its build, used again the next time; default: build-mutation")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N",
                        help="compilers at once")
    parser.add_argument("--check", action="store_true",
                        help="only check that every fault fits the code and names tests that exist")
    parser.add_argument("--list", action="store_true", help="only print the faults, their tests and their targets")
    arguments = parser.parse_args()

    tests = Tests()
    faults = [fault for fault in FAULTS if any(fnmatch.fnmatchcase(fault.id, name) for name in arguments.faults)]
    if arguments.list:
        for fault in faults:
            print(f"{fault.id}  {fault.file}  {' '.join(tests.find_targets(fault.tests))}  {fault.tests}")
        return 0
    problems = find_problems(tests)
    if problems:
        print("\n".join(problems))
        return 1
    if arguments.check:
        print(f"{len(FAULTS)} faults fit the code")
        return 0
    if not faults:
        sys.exit("no fault has such a name; --list prints them all")
    return try_faults(faults, tests, arguments)


if __name__ == "__main__":
    sys.exit(main())
