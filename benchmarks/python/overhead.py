"""What Python adds to a live frame: processor time outside the renderer over processor time of whole calls.

    PYTHONPATH=build/release/python python3 benchmarks/python/overhead.py ATLAS [EAST NORTH]

A frame of one bin goes through the same calls as one of 512 x 512, so that its time bounds what the calls themselves cost.
"""

import sys
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


if __name__ == "__main__":
    ground = sigmascape.LiveGround(sys.argv[1])
    place = tuple(float(word) for word in sys.argv[2:4]) or (0.0, 0.0)
    smallest, whole = seconds_a_frame(ground, 1, place, 2000), seconds_a_frame(ground, 512, place, 10)
    print(f"frame of 512 x 512: {1e3 * whole:.2f} ms; of one bin: {1e6 * smallest:.1f} us; "
          f"calling from Python takes at most {100.0 * smallest / whole:.3f} %")
