"""What a radar sees of a landscape.

    import sigmascape

    scene = sigmascape.Scene.read("town.toml")
    radar = sigmascape.Radar.read("radar.toml")
    traced = sigmascape.render(scene, radar)                   # path-traced: minutes

    sigmascape.bake(scene, "atlas")                            # once
    atlas = sigmascape.Atlas("atlas")
    baked = sigmascape.render(scene, radar, atlas=atlas)       # milliseconds
    baked.save("map.tif")                                      # or baked.save("map.png")
    baked.vv                                                   # float32 [row, column], linear sigma0
    print(sigmascape.compare(baked, traced))
    sigmascape.received_power(scene, radar, atlas=atlas).save("power.tif", db=True)   # dBW at the antenna's terminals

    radar.velocity_mps = (150, 0, 0)
    pulses = sigmascape.phase_history(atlas, radar)            # I/Q: complex64 [pulse, range, polarization]
    pulses.save("pulses.h5")

    radar.mode = "spotlight"
    sharp = sigmascape.render(None, radar, atlas=atlas, targets=[sigmascape.Target((10, 20), rcs_dbsm=30)])
    sigmascape.layers(scene, radar, ["shadow", "layover"])["shadow"]   # float32 [row, column]
    sigmascape.make_dataset("spec.toml", "samples")            # labelled images by the thousand

Scenes come from scene files, or are made up (Scene.simple, Scene.paper). LiveGround and LiveRenderer make radar frames for
simulators as I/Q, LiveTracer those of small areas from the whole scene, LiveFlight whichever of the two a pose needs;
LiveReceiver says in watts what a radar hears of them. The local frame has x east and y north in metres; heights are above
mean sea level; azimuths count clockwise from the frame's north, which is true at its origin; maps are [row, column] with
row 0 the northernmost; sigma0 is linear. Names say their unit. Long calls let other Python threads run and end on Ctrl-C.
What cannot be used raises sigmascape.Error, which says why, and what is of a wrong type TypeError.
"""

# By the first call that makes an array it might be in a thread, for which a process forked meanwhile would wait for ever.
import numpy as _numpy  # noqa: F401

from . import _progress
from ._native import (
    Atlas,
    BakeReport,
    CellComparison,
    DatasetReport,
    Error,
    Frame,
    GroundMap,
    Layers,
    LiveFlight,
    LiveGround,
    LiveReceiver,
    LiveRenderer,
    LiveTracer,
    PhaseHistory,
    PowerMap,
    Radar,
    RangeDopplerImage,
    Scene,
    StripmapImage,
    Target,
    Texture,
    __version__,
    antenna_gain_db,
    bake,
    class_names,
    compare,
    layers,
    make_dataset,
    material_names,
    material_sigma0,
    phase_history,
    plot,
    range_doppler,
    range_response_db,
    read_targets,
    received_power,
    render,
    stripmap,
    trihedral_rcs_dbsm,
)

__all__ = [
    "Atlas",
    "BakeReport",
    "CellComparison",
    "DatasetReport",
    "Error",
    "Frame",
    "GroundMap",
    "Layers",
    "LiveFlight",
    "LiveGround",
    "LiveReceiver",
    "LiveRenderer",
    "LiveTracer",
    "PhaseHistory",
    "PowerMap",
    "Radar",
    "RangeDopplerImage",
    "Scene",
    "StripmapImage",
    "Target",
    "Texture",
    "antenna_gain_db",
    "bake",
    "class_names",
    "compare",
    "layers",
    "make_dataset",
    "material_names",
    "material_sigma0",
    "phase_history",
    "plot",
    "range_doppler",
    "range_response_db",
    "read_targets",
    "received_power",
    "render",
    "stripmap",
    "trihedral_rcs_dbsm",
]
