"""Runs the pages of docs/tasks and the example of docs/datasets.md as a reader would: files are written under the name that stands behind
the language of a block, blocks of sh and python run one after another, in a folder of their own."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import ingredients

ROOT = pathlib.Path(os.environ["SIGMASCAPE_SOURCE_DIR"])
BLOCK = re.compile(r"^```(\w+)?(?: +(\S+))?\n(.*?)^```", re.MULTILINE | re.DOTALL)

# What has to be there when a page has run.
PROMISED = {
    "tasks/dem_and_osm.md": ["traced.tif", "traced.png", "traced.pgw", "power.tif", "atlas/collection.json", "baked.tif", "layers.tif"],
    "tasks/make_a_dataset.md": ["samples/shard-000002.tar", "samples/manifest.json", "samples/contact_sheet.png"],
    "tasks/read_iq.md": ["pulses.h5", "pulses.npy", "pulses.json", "pulses.sigmf-data"],
    "tasks/link_the_library.md": ["live.png", "prefix/lib/cmake/sigmascape/sigmascape-config.cmake"],
    "tasks/plots.md": ["sigma0.svg", "antenna.png", "pulse.svg", "beam.svg", "aspects.svg", "over_elevation.png", "powers.svg",
                       "amplitudes.png", "grass.png"],
    "datasets.md": ["out/paper_tenth_samples/contact_sheet.png", "out/paper_tenth_samples/samples/000003/shadow.npy"],
}


def environment():
    program = pathlib.Path(os.environ["SIGMASCAPE_CLI"])
    return os.environ | {"PATH": f"{program.parent}:{os.environ['PATH']}", "SIGMASCAPE_BUILD": str(program.parent.parent.parent)}


def run(language, text, folder):
    command = {"sh": ["bash", "-euc", text], "python": [sys.executable, "-c", text]}[language]
    done = subprocess.run(command, cwd=folder, env=environment(), capture_output=True, text=True)
    assert done.returncode == 0, f"{text}\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}"
    return done.stdout


def test_every_task_is_tried():
    tasks = {f"tasks/{page.name}" for page in (ROOT / "docs" / "tasks").glob("*.md")} - {"tasks/README.md"}
    assert tasks <= set(PROMISED)
    index = (ROOT / "docs" / "tasks" / "README.md").read_text()
    assert all(task.removeprefix("tasks/") in index for task in tasks)


@pytest.mark.parametrize("page", PROMISED)
def test_page(page, tmp_path):
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    if page == "tasks/dem_and_osm.md":
        ingredients.elevation(tmp_path / "dem.tif")
        ingredients.extract(tmp_path / "extract.osm")
    ran = 0
    for language, name, text in BLOCK.findall((ROOT / "docs" / page).read_text()):
        if name:
            (tmp_path / name).write_text(text)
        elif language in ("sh", "python"):
            run(language, text, tmp_path)
            ran += 1
    assert ran > 0
    for promised in PROMISED[page]:
        assert (tmp_path / promised).stat().st_size > 0, promised
