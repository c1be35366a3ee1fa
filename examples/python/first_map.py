"""From a landscape to a radar map, to pulses, to a live frame, step by step.

    python3 first_map.py [FOLDER]

Cells begin with # %% and can be run one by one in an editor that knows them, or in a notebook.
"""

# %% A landscape. Here a made-up town; your own is `sigmascape.Scene.read("town.toml")`.
import pathlib
import sys

import numpy as np

import sigmascape

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/first_map")
folder.mkdir(parents=True, exist_ok=True)
scene = sigmascape.Scene.paper(scale=0.1)
print(scene, "is", scene.extent_m[2] - scene.extent_m[0], "m wide and has", scene.info()["buildings"], "buildings")

# %% A radar, and where it stands: seen from the middle of the scene, in the south-east, 20 degrees above the horizon.
radar = sigmascape.Radar(name="first", frequency_hz=10e9, range_resolution_m=3.0, beam_width_deg=0.065, cell_m=3.0)
radar.see_from(azimuth_deg=130.0, elevation_deg=20.0, slant_range_m=4000.0)

# %% The map as rays see it: slow and right.
traced = sigmascape.render(scene, radar, samples=8)
traced.save(folder / "traced.png")

# %% The same landscape baked into textures, once for all radars at 10 GHz, and the map made from them.
sigmascape.bake(scene, folder / "atlas", azimuths=4, elevations_deg=[10.0, 20.0, 35.0], texel_m=2.0, patch_texels=256, samples=8)
atlas = sigmascape.Atlas(folder / "atlas")
baked = sigmascape.render(scene, radar, atlas=atlas)
baked.save(folder / "baked.png")
baked.save(folder / "baked.tif")
for row in sigmascape.compare(baked, traced, cells_m=[6.0, 12.0]):
    print("at cells of", row.cell_m, "m:", row)

# %% The numbers: sigma0, linear, [row, column], one array a polarization, without a copy.
print("brightest cell in VV:", 10.0 * np.log10(np.nanmax(baked.vv)), "dB")
print("share of the map in shadow:", np.mean(baked.db("sum") < -35.0))

# %% Pulses: what the receiver records before any processing. The radar has to fly for that.
radar.velocity_mps = (120.0, 120.0, 0.0)
radar.pulse_repetition_hz = 2000.0
pulses = sigmascape.phase_history(atlas, radar, interval_s=0.01)
pulses.save(folder / "pulses.h5")
print("pulses, ranges, polarizations:", pulses.samples.shape, {name: len(values) for name, values in pulses.axes.items()})

# %% A live frame, as a simulator asks for it many times a second. The first call only says which pages are wanted.
ground = sigmascape.LiveGround(folder / "atlas")
renderer = sigmascape.LiveRenderer(ground, beams=64, ranges=64, beam_step_rad=1e-3, range_step_m=4.0)
pose = dict(position_m=(0.0, -3000.0, 1000.0), first_azimuth_rad=-0.032, first_range_m=3030.0)
renderer.render(**pose)
ground.wait()
frame = renderer.render(**pose)
print("mean cross-section of a bin in VV:", np.mean(np.abs(frame.amplitudes_m[..., 0]) ** 2), "m2")
