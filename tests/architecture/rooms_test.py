#!/usr/bin/env python3
"""Holds every #include under src/sigmascape against the room table in src/sigmascape/CMakeLists.txt.

Also holds that GDAL, GEOS and PROJ are known in geo alone and Embree in trace alone, that no type is defined twice in a room, and
that no file or folder is a drawer without a meaning.
"""
import re
import sys

from told_faults import tell

OUTSIDE = {
    "geo": re.compile(r"<(gdal|ogr|cpl_|geos|proj)"),
    "trace": re.compile(r"<embree"),
}
DRAWERS = re.compile(r"^(utils?|common|core|misc|helpers?)$")


def room_table(cmake_file):
    rows = re.findall(r"sigmascape_room\(NAME (\w+)([^)]*)\)", cmake_file.read_text())
    table = {}
    for name, rest in rows:
        uses = re.search(r"USES ([\w ]+?)(?:\s+(?:LINKS|PRIVATE_LINKS)|\s*$)", rest)
        table[name] = set(uses.group(1).split()) if uses else set()
    return table


def types_defined_twice(sources, table):
    """Two types of one name in one namespace link into each other's place without a word from the compiler."""
    for room in table:
        where = {}
        for header in sorted((sources / room).glob("*.h")):
            for name in re.findall(r"^(?:class|struct|enum class) (\w+)[^;]*?\{", header.read_text(), re.MULTILINE):
                if where.setdefault(name, header.name) != header.name:
                    yield f"{room}: {name} is defined in {where[name]} and in {header.name}"


def faults(root):
    sources = root / "src" / "sigmascape"
    table = room_table(sources / "CMakeLists.txt")
    if len(table) < 13:
        yield f"only {len(table)} rooms were read from the table"
    earlier = []
    for room, uses in table.items():
        for used in uses - set(earlier):
            yield f"room {room} uses {used}, which does not stand before it in the table"
        earlier.append(room)
    for folder in sorted(p.name for p in sources.iterdir() if p.is_dir()):
        if folder not in table:
            yield f"folder {folder} is not in the room table"
    yield from types_defined_twice(sources, table)
    for path in sorted(sources.rglob("*")):
        if DRAWERS.match(path.stem):
            yield f"{path.relative_to(root)}: a drawer without a meaning"
        if path.suffix not in {".h", ".cpp"}:
            continue
        room = path.relative_to(sources).parts[0]
        for number, line in enumerate(path.read_text().splitlines(), 1):
            where = f"{path.relative_to(root)}:{number}"
            included = re.match(r'#include "sigmascape/(\w+)/', line)
            if included and included.group(1) != room and included.group(1) not in table.get(room, set()):
                yield f"{where}: {room} may not include from {included.group(1)}"
            for owner, pattern in OUTSIDE.items():
                if line.startswith("#include") and pattern.search(line) and room != owner:
                    yield f"{where}: only {owner} may include {line.split()[1]}"


if __name__ == "__main__":
    sys.exit(tell("room table", faults))
