#!/usr/bin/env bash
# `pip install .` as docs/python.md has it: offline, into a fresh environment that sees Debian's packages; then a first map.
# Usage: pip_install_test.sh SOURCES. 77: skipped.
set -euo pipefail
sources=$1
/usr/bin/python3 -c 'import venv, ensurepip, setuptools, wheel' 2> /dev/null || { echo "python3-venv, -setuptools or -wheel is missing"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
/usr/bin/python3 -m venv --system-site-packages "$folder/venv"
"$folder/venv/bin/pip" install --no-index --no-build-isolation --quiet "$sources"
cd "$folder"
env -u PYTHONPATH venv/bin/python - <<'PYTHON'
import pathlib
import sigmascape

assert pathlib.Path(sigmascape.__file__).parts[-5:-2] == ("lib", "python%d.%d" % __import__("sys").version_info[:2], "site-packages")
assert (pathlib.Path(sigmascape.__file__).parent / "__init__.pyi").exists()
radar = sigmascape.Radar()
radar.see_from(azimuth_deg=180.0, elevation_deg=30.0, slant_range_m=2000.0)
made = sigmascape.render(sigmascape.Scene.simple(side_m=50.0), radar, samples=2, progress=False)
made.save("map.tif")
assert made.vv.max() > 0.0 and sigmascape.GroundMap.read("map.tif").shape == made.shape
print("installed sigmascape", sigmascape.__version__)
PYTHON
