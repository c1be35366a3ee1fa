import os
import pathlib
import subprocess
import sys


def test_the_first_map(tmp_path):
    script = pathlib.Path(os.environ["SIGMASCAPE_SOURCE_DIR"]) / "examples" / "python" / "first_map.py"
    run = subprocess.run([sys.executable, script, tmp_path], check=True, capture_output=True, text=True)
    for name in ["traced.png", "baked.png", "baked.tif", "pulses.h5"]:
        assert (tmp_path / name).stat().st_size > 1000, name
    assert "mean cross-section" in run.stdout
