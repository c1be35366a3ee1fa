"""Targets, modes, layers and a dataset, step by step.

    python3 labelled_samples.py [FOLDER]

Cells begin with # %% as in first_map.py.
"""

# %% A landscape, its atlas and a radar that flies to the north-east.
import io
import json
import pathlib
import sys
import tarfile

import numpy as np

import sigmascape

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/labelled_samples")
folder.mkdir(parents=True, exist_ok=True)
(folder / "place.toml").write_text("[paper]\nscale = 0.1\n")
scene = sigmascape.Scene.read(folder / "place.toml")
sigmascape.bake(scene, folder / "atlas", azimuths=4, elevations_deg=[8.0, 21.0], texel_m=2.0, patch_texels=256, samples=2)
atlas = sigmascape.Atlas(folder / "atlas")
radar = sigmascape.Radar(name="side looking", range_resolution_m=3.0, beam_width_deg=2.0, cell_m=3.0)
radar.see_from(azimuth_deg=130.0, elevation_deg=15.0, slant_range_m=5000.0)
radar.velocity_mps, radar.pulse_repetition_hz = (100.0, 80.0, 0.0), 2000.0

# %% Two vehicles in a spotlight image: the one that drives is not where it is seen.
radar.mode, radar.looks = "spotlight", 2
vehicles = [sigmascape.Target((120.0, 60.0), name="parked", rcs_dbsm=30.0, size_m=(6.0, 2.5, 3.0)),
            sigmascape.Target((70.0, 120.0), name="driving", rcs_dbsm=30.0, heading_deg=130.0, speed_mps=0.5)]
sharp = sigmascape.render(scene, radar, atlas=atlas, targets=vehicles)
sharp.save(folder / "spotlight.png")
print("mode:", sharp.metadata["mode"], "resolution:", sharp.metadata["along_resolution_m"], "m")

# %% What lies where in the same map, and how often the echoes of each cell have bounced.
layers = sigmascape.layers(scene, radar, ["shadow", "layover", "incidence", "bounce1", "bounce2"], samples=4)
print("in shadow:", np.mean(layers["shadow"]), "laid over:", np.mean(layers["layover"]))
layers.save(folder / "layers.tif")

# %% A dataset of such maps with labels; NumPy and json load it.
(folder / "radar.toml").write_text("[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.02\n"
                                   "[position]\nazimuth_deg = 0\nelevation_deg = 13\nslant_range_km = 15\n")
(folder / "spec.toml").write_text("""
[dataset]
scene = "place.toml"
atlas = "atlas"
radar = "radar.toml"
count = 8
cells = 64
layers = ["shadow", "class", "height"]
files = "webdataset"
[view]
azimuth_deg = [0, 360]
elevation_deg = [8, 21]
slant_range_km = [14, 16]
[[targets]]
name = "vehicle"
number = [1, 3]
rcs_dbsm = [35, 45]
""")
print(sigmascape.make_dataset(folder / "spec.toml", folder / "samples"))
with tarfile.open(folder / "samples" / "shard-000000.tar") as shard:
    sigma0 = np.load(io.BytesIO(shard.extractfile("000003.map.npy").read()))
boxes = json.loads((folder / "samples" / "annotations.json").read_text())["annotations"]
print("map:", sigma0.shape, "boxes in all samples:", len(boxes))

# %% A curve: how grass answers by grazing angle.
angle_deg = np.linspace(1.0, 89.0, 89)
grass = sigmascape.material_sigma0("grass", angle_deg)
sigmascape.plot(folder / "grass.svg", {"VV": (angle_deg, 10 * np.log10(grass[:, 0])), "HV": (angle_deg, 10 * np.log10(grass[:, 2]))},
                x_label="grazing angle [°]", y_label="σ0 [dB]")
