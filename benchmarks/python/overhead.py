"""What Python adds to a live frame: processor time outside the renderer over processor time of whole calls.

    PYTHONPATH=build/release/python python3 benchmarks/python/overhead.py [--out FILE] [ATLAS EAST NORTH]

A frame of one bin goes through the same calls as one of 512 x 512, so that its time bounds what the calls themselves cost. Without an atlas a
small one is baked first.
"""

import argparse
import json
import os
import subprocess
import tempfile
import time

import sigmascape


def seconds_a_frame(ground, bins, place, frames):
    renderer = sigmascape.LiveRenderer(ground, beams=bins, ranges=bins, beam_step_rad=2e-4, range_step_m=3.0, threads=1)
    half_m, half_rad = 1.5 * bins, 1e-4 * bins
    pose = dict(position_m=(place[0], place[1] - 5000.0, 1300.0), first_azimuth_rad=-half_rad, first_range_m=5166.0 - half_m)
    for _ in range(3):
        renderer.render(**pose).amplitudes_m
        ground.wait()
    begin = time.process_time()
    for _ in range(frames):
        renderer.render(**pose).amplitudes_m
    return (time.process_time() - begin) / frames


def made_atlas(folder):
    """500 m of the paper's landscape, rays few: what stands in the texels has no bearing on the cost of a call."""
    sigmascape.bake(sigmascape.Scene.paper(scale=0.25), folder, azimuths=2, elevations_deg=[10.0, 20.0], texel_m=2.0, patch_texels=256, samples=2,
                    progress=False)
    return folder


def processor():
    with open("/proc/cpuinfo") as file:
        return next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), "unknown processor")


def measure(atlas, place, out):
    ground = sigmascape.LiveGround(atlas)
    smallest, whole = seconds_a_frame(ground, 1, place, 2000), seconds_a_frame(ground, 512, place, 10)
    print(f"frame of 512 x 512: {1e3 * whole:.2f} ms; of one bin: {1e6 * smallest:.1f} us; "
          f"calling from Python takes at most {100.0 * smallest / whole:.3f} %")
    if out:
        commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=os.path.dirname(os.path.abspath(__file__)),
                                capture_output=True, text=True).stdout.strip()
        os.makedirs(os.path.dirname(out) or ".", exist_ok=True)
        with open(out, "w") as file:
            for name, value, unit in [("python.call_us", 1e6 * smallest, "us"), ("python.overhead_percent", 100.0 * smallest / whole, "%")]:
                file.write(json.dumps({"name": name, "value": value, "unit": unit, "machine": f"{os.cpu_count()} hardware threads, {processor()}",
                                       "commit": commit}) + "\n")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("atlas", nargs="?")
    parser.add_argument("place", nargs="*", type=float)
    parser.add_argument("--out")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        measure(arguments.atlas or made_atlas(folder), tuple(arguments.place) or (0.0, 0.0), arguments.out)
