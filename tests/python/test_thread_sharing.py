"""Threads that wait for one another as a program ends, that read what a forked child wants, and that save what others change."""

import os
import subprocess
import sys

import pytest

# A crash or a hang is to fail one test alone.
MADE = """
import faulthandler, os, signal, sys, threading, time
import sigmascape
faulthandler.enable()
"""

# One thread waits for the bins in which the other draws; and who looks for signals waits for the GIL, in vain.
DAEMONS = """
tracer = sigmascape.LiveTracer(sigmascape.Scene.simple(side_m=96.0), beams=128, ranges=128, beam_step_rad=2e-4, range_step_m=0.5,
                               rays_per_cell=64)
place, pose = (0.0, -2900.0, 800.0), dict(first_azimuth_rad=-0.012, first_range_m=2960.0)
step = tracer.scan(place, **pose, first_beam=0, count=1)
def draw():
    while True:
        tracer.render(place, **pose)
def save():
    while True:
        try:
            step.save(sys.argv[1])
        except sigmascape.Error:
            pass  # the bins hold a later frame
for work in [draw, save]:
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.5)  # into the work
sys.setswitchinterval(100.0)
end = time.monotonic() + 0.2
while time.monotonic() < end:
    pass
"""

# On one processor the atlas takes long enough to read for most of the children to be made meanwhile.
FORK = """
os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
look = dict(azimuth_deg=0.0, elevation_deg=15.0, frequency_ghz=10.0)
expected = sigmascape.Atlas(sys.argv[1]).sigma0_at([3.0], [5.0], **look)
for _ in range(5):
    atlas = sigmascape.Atlas(sys.argv[1])
    reader = threading.Thread(target=atlas.load)
    reader.start()
    time.sleep(0.01)  # into the work
    child = os.fork()
    if child == 0:
        signal.alarm(60)  # a hang ends here
        assert (atlas.sigma0_at([3.0], [5.0], **look) == expected).all()
        os._exit(0)
    status = os.waitpid(child, 0)[1]
    assert status == 0, status
    reader.join()
print("alike")
"""

# A search for tqdm that takes long and finds nothing: while it goes on, its thread holds the lock of that import.
WITHOUT_TQDM = """
class NoTqdm:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == "tqdm":
            time.sleep(0.3)
            raise ModuleNotFoundError(name)
sys.meta_path.insert(0, NoTqdm())
scene = sigmascape.Scene.simple(side_m=96.0)
radar = sigmascape.Radar(range_resolution_m=4.0, beam_width_deg=0.05, cell_m=4.0)
radar.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0)
def layers():
    return sigmascape.layers(scene, radar, ["shadow"], lod=1, threads=1)["shadow"]
def work():
    while True:
        layers()
threading.Thread(target=work, daemon=True).start()
for _ in range(4):
    time.sleep(0.1)  # into the search
    child = os.fork()
    if child == 0:
        signal.alarm(60)  # a hang ends here
        assert layers().any()
        os._exit(0)
    status = os.waitpid(child, 0)[1]
    assert status == 0, status
print("alike", flush=True)
os._exit(0)
"""

METADATA = """
import json
import numpy as np
radar = sigmascape.Radar(range_resolution_m=4.0, beam_width_deg=0.05, cell_m=4.0)
radar.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0)
seen = sigmascape.render(sigmascape.Scene.simple(side_m=96.0), radar, samples=1, progress=False)
names = [f"name {i}" for i in range(1000)]
kinds = [dict.fromkeys(names, f"a text too long to be kept within its string, {kind}") for kind in "ab"]
seen.metadata = kinds[1]
def save():
    for i in range(50):
        seen.save(f"{sys.argv[1]}.{'npz' if i % 2 else 'png'}")
        if i % 2:
            told = json.loads(np.load(sys.argv[1] + ".npz")["description_json"].tobytes())
            assert len({told[name] for name in names}) == 1, "some of either"
    print("saved", flush=True)
saver = threading.Thread(target=save)
saver.start()
while saver.is_alive():
    for kind in kinds:
        seen.metadata = kind
"""


def ended(code, *arguments):
    process = subprocess.run([sys.executable, "-W", "ignore", "-c", MADE + code, *arguments], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, text=True, timeout=300, env=os.environ)
    return process.stdout, process.stderr, process.returncode


def test_a_process_ends_while_one_daemon_thread_waits_for_another(tmp_path):
    assert ended(DAEMONS, tmp_path / "frame.npy") == ("", "", 0)


@pytest.mark.skipif("tsan" in os.environ.get("LD_PRELOAD", ""), reason="the thread sanitizer ends processes that fork and make threads")
def test_a_forked_process_reads_an_atlas_that_a_thread_of_its_parent_was_at(atlas):
    assert ended(FORK, atlas.folder) == ("alike\n", "", 0)


@pytest.mark.skipif("tsan" in os.environ.get("LD_PRELOAD", ""), reason="the thread sanitizer ends processes that fork and make threads")
def test_a_forked_process_does_not_wait_for_what_a_thread_of_its_parent_imported():
    assert ended(WITHOUT_TQDM) == ("alike\n", "", 0)


def test_metadata_may_be_assigned_while_the_map_is_saved(tmp_path):
    assert ended(METADATA, tmp_path / "map") == ("saved\n", "", 0)


def test_a_thread_of_the_parent_does_not_import_numpy_while_it_forks():
    """In the child it would never be imported to the end. On a busy machine the test above hung so every third time."""
    said = subprocess.run([sys.executable, "-c", "import sigmascape, sys; print('numpy' in sys.modules)"], capture_output=True, text=True)
    assert (said.stdout, said.returncode) == ("True\n", 0)
