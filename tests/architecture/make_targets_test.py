#!/usr/bin/env python3
"""What `make` configures for a target needs no more packages than it installs for it: tests need some of their own."""

import os
import re
import subprocess
import sys

from told_faults import tell


def commands(root, target):
    # Of the make that runs this test nothing is to be taken.
    environment = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    done = subprocess.run(["make", "--dry-run", "--no-print-directory", "--directory", root, target], check=True,
                          capture_output=True, text=True, env=environment)
    return done.stdout.splitlines()


def faults(root):
    targets = re.findall(r"^([a-z-]+):(?!=).*", (root / "Makefile").read_text(), re.MULTILINE)
    if "demo" not in targets:
        yield "Makefile: has no target demo, or this test does not find it"
    for target in targets:
        lines = commands(root, target)
        has_build_alone = "tools/install_packages build" in lines
        has_all = "tools/install_packages" in lines
        for line in (line for line in lines if line.startswith("cmake --preset")):
            if "-DSIGMASCAPE_TESTS=OFF" not in line and not has_all:
                yield f"Makefile: {target} configures tests, and installs " + (
                    "the packages of [build] alone" if has_build_alone else "no packages")


if __name__ == "__main__":
    sys.exit(tell("make targets", faults))
