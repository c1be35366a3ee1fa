import os
import pathlib
import subprocess
import sys


import pytest

EXAMPLES = pathlib.Path(os.environ["SIGMASCAPE_SOURCE_DIR"]) / "examples" / "python"
MADE = {"first_map.py": (["traced.png", "baked.png", "baked.tif", "pulses.h5"], "mean cross-section"),
        "labelled_samples.py": (["spotlight.png", "layers.tif", "samples/contact_sheet.png", "grass.svg"], "boxes in all samples")}


@pytest.mark.parametrize("name", MADE)
def test_example(name, tmp_path):
    files, words = MADE[name]
    run = subprocess.run([sys.executable, EXAMPLES / name, tmp_path], check=True, capture_output=True, text=True)
    for file in files:
        assert (tmp_path / file).stat().st_size > 1000, file
    assert words in run.stdout


def test_every_example_is_run():
    assert {path.name for path in EXAMPLES.glob("*.py")} == set(MADE)
