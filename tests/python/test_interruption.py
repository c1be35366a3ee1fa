"""Ctrl-C ends every long call within a second, and other threads run meanwhile."""

import os
import signal
import subprocess
import sys
import time

import pytest

import sigmascape

# Left alone, most of these take minutes, the map from an atlas 0.4 s on a fast machine. The radar sees 96 x 96 m, so that work comes from
# resolution and from rays.
PREPARED = """
import sys, sigmascape
scene = sigmascape.Scene.simple(side_m=96.0)
radar = sigmascape.Radar(range_resolution_m=2.0, beam_width_deg=0.05, cell_m=2.0)
radar.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0)
radar.velocity_mps, radar.pulse_repetition_hz = (100.0, 0.0, 0.0), 4000.0
atlas = sigmascape.Atlas(sys.argv[1])
atlas.load()
try:
    print("ready", flush=True)
    {call}
    print("went through", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""

CALLS = {
    "trace": "radar.cell_m = 0.1; sigmascape.render(scene, radar, samples=400, progress=False)",
    "baked": "radar.range_resolution_m, radar.cell_m = 0.05, 0.05; sigmascape.render(scene, radar, atlas=atlas, threads=1)",
    "focused": "sigmascape.range_doppler(atlas, radar, interval_s=0.05, scatterer_spacing_m=0.03, threads=1)",
    "pulses": "radar.range_resolution_m = 0.2; sigmascape.phase_history(atlas, radar, interval_s=10.0)",
    "layers": "radar.cell_m = 0.1; sigmascape.layers(scene, radar, ['bounce1'], samples=400, progress=False)",
    "scene": "sigmascape.Scene.paper(scale=5.0)",
    "dataset": "sigmascape.make_dataset(sys.argv[2], sys.argv[3], progress=False)",
}

SPEC = """
[dataset]
scene = "scene.toml"
radar = "radar.toml"
count = 1000
cells = 48
cell_m = 4.0
samples_per_cell = 400
[view]
azimuth_deg = [0, 360]
elevation_deg = [20, 30]
slant_range_km = [5, 6]
"""


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends(name, atlas, tmp_path):
    (tmp_path / "scene.toml").write_text("[paper]\nscale = 0.1\n")
    (tmp_path / "radar.toml").write_text("[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.02\n"
                                         "[position]\nazimuth_deg = 0\nelevation_deg = 20\nslant_range_km = 5\n")
    (tmp_path / "spec.toml").write_text(SPEC)
    process = subprocess.Popen([sys.executable, "-c", PREPARED.replace("{call}", CALLS[name]), atlas.folder, tmp_path / "spec.toml",
                                tmp_path / "samples"], stdout=subprocess.PIPE, text=True, env=os.environ)
    try:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.1)  # into the work
        process.send_signal(signal.SIGINT)
        begin = time.monotonic()
        told, _ = process.communicate(timeout=60.0)
        print(f"{name}: {time.monotonic() - begin:.2f} s")
    finally:
        process.kill()
    assert told == "interrupted\n"


def test_ctrl_c_ends_the_reading_of_a_large_scene(gdal, tmp_path):
    side = 3000
    raster = gdal.GetDriverByName("GTiff").Create(str(tmp_path / "dem.tif"), side, side, 1, gdal.GDT_Float32)
    raster.SetGeoTransform((500_000.0, 10.0, 0.0, 4_800_000.0, 0.0, -10.0))
    raster.SetProjection("EPSG:25830")
    raster = None  # written
    # Smoothing goes over nine million heights a hundred times.
    (tmp_path / "scene.toml").write_text('[terrain]\nfile = "dem.tif"\nsmooth_within_m = 1.0\n')
    code = ("import sys, sigmascape\nprint('ready', flush=True)\ntry:\n    sigmascape.Scene.read(sys.argv[1])\n"
            "    print('went through', flush=True)\nexcept KeyboardInterrupt:\n    print('interrupted', flush=True)\n")
    process = subprocess.Popen([sys.executable, "-c", code, tmp_path / "scene.toml"], stdout=subprocess.PIPE, text=True, env=os.environ)
    try:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        begin = time.monotonic()
        told, _ = process.communicate(timeout=60.0)
        print(f"reading: {time.monotonic() - begin:.2f} s")
    finally:
        process.kill()
    assert told == "interrupted\n"


def test_tqdm_shows_a_bar_where_it_is_installed(scene, radar, monkeypatch):
    """With a stand-in for tqdm: made with the task's name and total, updated to the end, and closed."""
    told = []

    class Bar:
        def __init__(self, **options):
            self.n = 0.0
            told.append(("made", options["desc"], options["total"]))

        def update(self, step):
            self.n += step
            told.append(("at", self.n))

        def close(self):
            told.append(("closed",))

    import types
    auto = types.ModuleType("tqdm.auto")
    auto.tqdm = Bar
    monkeypatch.setitem(sys.modules, "tqdm.auto", auto)
    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm"))
    # Whether it is installed was looked up before.
    monkeypatch.setattr(sigmascape._progress, "_tqdm", sigmascape._progress._tqdm.__wrapped__)
    sigmascape.render(scene, radar, samples=64)
    assert told[0][0] == "made" and told[-1] == ("closed",) and told[-2] == ("at", told[0][2])
    told.clear()
    sigmascape.render(scene, radar, samples=2, progress=False)
    assert not told
