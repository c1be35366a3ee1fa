"""Live classes between threads, whose calls queue up, and between processes, which make their own."""

import os
import subprocess
import sys

import pytest

# A crash or a hang is to fail one test alone.
MADE = """
import faulthandler, gc, os, signal, sys, threading
import numpy as np
import sigmascape
faulthandler.enable()
scene = sigmascape.Scene.simple(side_m=96.0)
bins = dict(content="powers", beams=20, ranges=30, beam_step_rad=2e-3, range_step_m=3.0)
place, pose = (0.0, -2900.0, 800.0), dict(first_azimuth_rad=-0.02, first_range_m=2960.0)
def radar():
    return sigmascape.Radar.from_keys(dict(radar=dict(frequency_ghz=10.0, range_resolution_m=6.0, beam_width_deg=0.2), map=dict(cell_m=3.0)))
def opened():
    return sigmascape.LiveGround(sys.argv[1], cache_mib=64)
def made(name, ground):
    if name == "LiveRenderer":
        return sigmascape.LiveRenderer(ground, **bins)
    if name == "LiveTracer":
        return sigmascape.LiveTracer(scene, rays_per_cell=4, lattice_m=1.0, **bins)
    return sigmascape.LiveFlight(scene, ground, rays_per_cell=4, **bins)
"""

THREADS = """
threads, calls = 4, 12
ground = opened()
alone, shared = (made(sys.argv[2], ground) for _ in range(2))
if sys.argv[2] == "LiveRenderer":
    for live in (alone, shared):
        live.render(place, **pose)
    ground.wait()
rays, lit = [], []
def render():
    for _ in range(calls):
        frame = shared.render(place, **pose)
        rays.append(frame.rays_per_cell)
        lit.append(frame.lit)
team = [threading.Thread(target=render) for _ in range(threads)]
for thread in team:
    thread.start()
for thread in team:
    thread.join()
expected = [alone.render(place, **pose) for _ in range(threads * calls)]
assert sorted(rays) == [frame.rays_per_cell for frame in expected], rays
assert set(lit) == {frame.lit for frame in expected}
np.testing.assert_array_equal(shared.render(place, **pose).powers_m2, alone.render(place, **pose).powers_m2)
print("alike")
"""

HEARD = """
ground = opened()
renderers = [sigmascape.LiveRenderer(ground, **(bins | dict(ranges=ranges))) for ranges in (30, 300)]
def frames():
    return [renderer.render(place, **pose) for renderer in renderers]
frames()
ground.wait()
shared, drawn = sigmascape.LiveReceiver(radar()), frames()
expected = [sigmascape.LiveReceiver(radar()).hear(frame).copy() for frame in drawn]
told = []
def hear(number):
    for _ in range(25):
        heard = shared.hear(drawn[number])
        # Others may hear into the array of as many bins, and the same frame alone.
        told.append(heard.shape == expected[number].shape and np.array_equal(heard, expected[number]))
team = [threading.Thread(target=hear, args=(number,)) for number in (0, 1)]
for thread in team:
    thread.start()
for thread in team:
    thread.join()
assert len(told) == 50 and all(told), told
print("alike")
"""

FORK = """
ground = opened()
live = {name: made(name, ground) for name in ["LiveRenderer", "LiveTracer", "LiveFlight"]}
for one in live.values():
    one.render(place, **pose)
ground.wait()
receiver, frame = sigmascape.LiveReceiver(radar()), live["LiveRenderer"].render(place, **pose)
receiver.hear(frame)
def refusal(action):
    try:
        action()
    except sigmascape.Error as error:
        return str(error)
child = os.fork()
if child == 0:
    signal.alarm(60)  # a hang ends here
    told = {name: refusal(lambda: one.render(place, **pose)) for name, one in live.items()}
    told["LiveGround"] = refusal(ground.wait)
    told["LiveReceiver"] = refusal(lambda: receiver.hear(frame))
    for name, words in told.items():
        assert words == name + ": was made in another process; make it in this one", words
    assert "LiveFlight" in refusal(live["LiveFlight"].explained)
    assert "LiveGround" in refusal(lambda: made("LiveRenderer", ground))
    live.clear()
    del ground, one, receiver, frame
    gc.collect()
    own = opened()
    renderer = made("LiveRenderer", own)
    renderer.render(place, **pose)
    own.wait()
    frame = renderer.render(place, **pose)
    assert frame.lit > 0
    assert np.isfinite(sigmascape.LiveReceiver(radar()).hear(frame)).all()
    print("its own", flush=True)
    os._exit(0)
assert os.waitpid(child, 0)[1] == 0
assert live["LiveRenderer"].render(place, **pose).lit > 0
assert np.isfinite(receiver.hear(live["LiveRenderer"].render(place, **pose))).all()
"""

DAEMON = """
import time
work = {
    "short frames": lambda live=made("LiveRenderer", opened()): live.render(place, **pose),
    "long frames": lambda live=sigmascape.LiveTracer(scene, beams=128, ranges=128, beam_step_rad=2e-4, range_step_m=0.5, rays_per_cell=64):
        live.render(place, **pose),
    "a map": lambda radar=sigmascape.Radar(cell_m=0.2): (radar.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0),
        sigmascape.render(scene, radar, samples=2000, progress=lambda *told: None)),
    "a scene": lambda: sigmascape.Scene.paper(scale=5.0),
}[sys.argv[2]]
def go_on():
    while True:
        work()
threading.Thread(target=go_on, daemon=True).start()
time.sleep(0.5)  # into the work
print("end", flush=True)
"""


def told_by(code, *arguments):
    return subprocess.run([sys.executable, "-c", MADE + code, *arguments], stdout=subprocess.PIPE, text=True, timeout=300,
                          env=os.environ).stdout


@pytest.mark.parametrize("name", ["LiveRenderer", "LiveTracer", "LiveFlight"])
def test_calls_of_several_threads_queue_up(atlas, name):
    assert told_by(THREADS, atlas.folder, name) == "alike\n"


def test_frames_are_heard_by_several_threads_in_turn(atlas):
    assert told_by(HEARD, atlas.folder) == "alike\n"


@pytest.mark.skipif("tsan" in os.environ.get("LD_PRELOAD", ""), reason="the thread sanitizer ends processes that fork and make threads")
def test_a_forked_process_makes_its_own(atlas):
    assert told_by(FORK, atlas.folder) == "its own\n"


@pytest.mark.parametrize("work", ["short frames", "long frames", "a map", "a scene"])
def test_a_process_ends_while_a_daemon_thread_is_at_work(atlas, work):
    ended = subprocess.run([sys.executable, "-W", "ignore", "-c", MADE + DAEMON, atlas.folder, work], stdout=subprocess.PIPE,
                           stderr=subprocess.PIPE, text=True, timeout=300, env=os.environ)
    assert (ended.stdout, ended.stderr, ended.returncode) == ("end\n", "", 0)
