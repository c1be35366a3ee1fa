import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import sigmascape


def test_the_atlas_has_the_axes_that_were_baked(atlas, scene):
    assert list(atlas.azimuths_deg) == [0.0, 90.0, 180.0, 270.0]
    assert list(atlas.elevations_deg) == [15.0, 35.0]
    assert list(atlas.frequencies_ghz) == [10.0]
    assert atlas.texel_m == 1.0 and atlas.scene_hash == scene.hash
    assert atlas.info()["looks_done"] == atlas.info()["looks"] == len(atlas.patches) * 8
    assert atlas.terrain_m.dtype == np.float32 and not atlas.terrain_m.flags.owndata


def test_an_atlas_opens_in_a_folder_whose_name_is_not_utf_8(atlas, tmp_path):
    link = tmp_path / os.fsdecode(b"atl\xe4s")
    link.symlink_to(os.path.abspath(atlas.folder), target_is_directory=True)
    assert repr(sigmascape.Atlas(link)) == f"<sigmascape.Atlas '{link}'>"


def test_textures_are_half_floats_without_a_copy(atlas):
    texture = atlas.texture((0, -1), azimuth_deg=180.0, elevation_deg=15.0, frequency_ghz=10.0)
    level = texture.levels[0]
    assert level.dtype == np.float16 and level.shape == (256, 256, 4)
    assert not level.flags.owndata and np.shares_memory(level, texture.levels[0])
    sigma0 = texture.sigma0()
    assert sigma0.dtype == np.float32
    assert np.array_equal(sigma0, level.astype(np.float32) * np.float32(texture.scale))
    assert sigma0[..., 0].max() > 0.1  # the side of the cylinder that faces the radar
    level[0, 0, 0] = 7.0
    assert texture.levels[0][0, 0, 0] == 7.0
    del texture
    assert level[0, 0, 0] == 7.0  # the array keeps its memory alive


def test_sigma0_at_the_middle_of_a_texel_is_the_texel(atlas):
    look = dict(azimuth_deg=90.0, elevation_deg=35.0, frequency_ghz=10.0)
    texels = atlas.texture((0, 0), **look).sigma0()
    # Patch (0, 0) has its south-western corner at the origin; row 0 is the northernmost.
    rows, columns = np.mgrid[246:256, 10:40]
    found = atlas.sigma0_at(columns + 0.5, 256.0 - (rows + 0.5), **look)
    assert found.shape == (10, 30, 4) and found.dtype == np.float32
    assert np.allclose(found, texels[246:256, 10:40], rtol=1e-5, atol=1e-9)
    assert found.any()


def test_sigma0_at_bare_ground_is_that_of_the_ground(tmp_path):
    """Whether it is baked into textures or kept apart from them, it is the same where nothing shadows or stands on it."""
    landscape = sigmascape.Scene.paper(scale=0.1)
    x, y = np.meshgrid(np.arange(5.0, 195.0, 4.0), np.arange(5.0, 195.0, 4.0))

    def sigma0(shadows):
        sigmascape.bake(landscape, tmp_path / shadows, azimuths=4, elevations_deg=[15.0, 35.0], frequencies_ghz=[10.0], texel_m=2.0,
                        patch_texels=256, samples=8, shadows=shadows, progress=False)
        return sigmascape.Atlas(tmp_path / shadows).sigma0_at(x, y, azimuth_deg=90.0, elevation_deg=35.0, frequency_ghz=10.0)[..., 0]

    apart, within = sigma0("run-time"), sigma0("baked")
    of_objects = sigmascape.Atlas(tmp_path / "run-time").texture((0, 0), azimuth_deg=90.0, elevation_deg=35.0, frequency_ghz=10.0).sigma0()
    rows, columns = (255 - y // 2).astype(int), (x // 2).astype(int)
    beside = [of_objects[rows + down, columns + right, 0] for down in (-1, 0, 1) for right in (-1, 0, 1)]
    bare = (np.max(beside, axis=0) == 0.0) & (apart > 0.0) & (within > 0.3 * apart)  # nothing stands there or shadows it
    assert bare.mean() > 0.05, "of a landscape with a forest, a town and water"
    # Half in a shadow, or lit by a wall, some are not.
    assert np.median(within[bare] / apart[bare]) == pytest.approx(1.0, abs=0.01)
    assert np.isclose(apart[bare], within[bare], rtol=0.1).mean() > 0.6


def test_north_is_north_from_either_side(atlas):
    looks = [atlas.texture((0, 0), azimuth_deg=azimuth_deg, elevation_deg=15.0, frequency_ghz=10.0).sigma0()
             for azimuth_deg in (0.0, -1e-10, 360.0 - 1e-10)]
    assert np.array_equal(looks[0], looks[1], equal_nan=True) and np.array_equal(looks[0], looks[2], equal_nan=True)


def test_a_look_that_was_not_baked_is_refused(atlas):
    with pytest.raises(sigmascape.Error, match="elevation_deg"):
        atlas.texture((0, 0), azimuth_deg=0.0, elevation_deg=20.0, frequency_ghz=10.0)
    with pytest.raises(sigmascape.Error, match="patch: is \\(-5, 0\\)"):
        atlas.texture((-5, 0), azimuth_deg=0.0, elevation_deg=15.0, frequency_ghz=10.0)
    with pytest.raises(sigmascape.Error):
        atlas.sigma0_at([0.0], [0.0], azimuth_deg=0.0, elevation_deg=20.0, frequency_ghz=35.0)
    for wrong in (float("nan"), float("inf")):
        with pytest.raises(sigmascape.Error, match="azimuth_deg: is"):
            atlas.texture((0, 0), azimuth_deg=wrong, elevation_deg=15.0, frequency_ghz=10.0)
    look = dict(azimuth_deg=0.0, elevation_deg=15.0, frequency_ghz=10.0, level=0.0)
    for name in ("azimuth_deg", "elevation_deg", "level"):
        with pytest.raises(sigmascape.Error, match=f"{name}: is nan"):
            atlas.sigma0_at([0.0], [0.0], **(look | {name: float("nan")}))


def test_sigma0_at_no_place_is_refused_and_nothing_outside_the_atlas(atlas):
    look = dict(azimuth_deg=90.0, elevation_deg=35.0, frequency_ghz=10.0)
    for wrong in (float("nan"), float("inf"), 1e300):
        with pytest.raises(sigmascape.Error, match="^x_m: is "):
            atlas.sigma0_at([0.0, wrong], [0.0, 0.0], **look)
        with pytest.raises(sigmascape.Error, match="^y_m: is "):
            atlas.sigma0_at(0.0, wrong, **look)
    assert not atlas.sigma0_at([1e7, -1e7], [0.0, 1e7], **look).any()
    assert atlas.sigma0_at([], [], **look).shape == (0, 4)


def test_a_bake_goes_on_where_it_stopped_and_tells_its_progress(tmp_path):
    scene = sigmascape.Scene.simple(side_m=96.0, ground_material="grass")
    options = dict(azimuths=2, elevations_deg=[30.0], texel_m=2.0, patch_texels=256, samples=2)
    told = []
    first = sigmascape.bake(scene, tmp_path, **options, progress=lambda *report: told.append(report))
    looks = float(first.looks)
    assert [report for report in told if report[0] == "bake"][-1] == ("bake", looks, looks, "looks")
    again = sigmascape.bake(scene, tmp_path, **options, progress=False)
    assert (first.already, again.already) == (0, first.looks)
    assert first.relative_standard_error > 0.0 and again.relative_standard_error is None
    assert 0.0 < first.part_of_all < 1.0 and first.above_target is None
    info = sigmascape.Atlas(tmp_path).info()
    assert (info["relative_standard_error"], info["part_of_all"]) == (first.relative_standard_error, first.part_of_all)
    assert info["above_target"] is None


def test_what_is_in_doubt_is_shared_or_left_where_it_fell(scene, tmp_path):
    options = dict(azimuths=1, elevations_deg=[30.0], texel_m=2.0, patch_texels=256, samples=4, digits="all", progress=False)
    levels = {}
    for noise in ["shared", "own"]:
        sigmascape.bake(scene, tmp_path / noise, noise=noise, **options)
        atlas = sigmascape.Atlas(tmp_path / noise)
        textures = [atlas.texture(patch, azimuth_deg=0.0, elevation_deg=30.0, frequency_ghz=10.0) for patch in atlas.patches]
        levels[noise] = np.stack([texture.levels[0].astype(float) * texture.scale for texture in textures])
    assert not np.array_equal(levels["shared"], levels["own"])
    # Each number is rounded to a half, one part in 2048.
    assert levels["shared"].sum() == pytest.approx(levels["own"].sum(), rel=5e-4)
    with pytest.raises(sigmascape.Error, match="noise: is 'loud'; give 'own' or 'shared'"):
        sigmascape.bake(scene, tmp_path / "loud", noise="loud", **options)
    assert not (tmp_path / "loud").exists()


def test_buildings_that_are_kept_apart_are_in_maps_and_in_live_frames_where_they_are_baked_too(tmp_path):
    town = sigmascape.Scene.paper(scale=0.1, materials="itu")
    options = dict(azimuths=1, elevations_deg=[30.0], texel_m=2.0, patch_texels=256, samples=8, bounces=1, progress=False)
    radar = sigmascape.Radar(range_resolution_m=2.0, beam_width_deg=0.1, cell_m=2.0)
    radar.see_from(azimuth_deg=0.0, elevation_deg=30.0, slant_range_m=2500.0)
    power, info = {}, {}
    for buildings in ["baked", "apart", "both"]:
        sigmascape.bake(town, tmp_path / buildings, buildings=buildings, **options)
        info[buildings] = sigmascape.Atlas(tmp_path / buildings).info()
        map_of_town = sigmascape.render(town, radar, atlas=sigmascape.Atlas(tmp_path / buildings), progress=False)
        power[buildings] = np.nansum(map_of_town.vv)
    assert (tmp_path / "apart" / "buildings.glb").exists() and not (tmp_path / "baked" / "buildings.glb").exists()
    assert power["apart"] == pytest.approx(power["baked"], rel=0.05)
    assert power["both"] == power["apart"]
    assert info["baked"]["buildings"] is None and info["apart"]["buildings"] == {"faults": [], "textures": None}
    textures = info["both"]["buildings"]["textures"]
    assert textures["files"] == textures["files_done"] == len(list((tmp_path / "both" / "buildings").rglob("az*GHz.tif")))
    assert sigmascape.LiveGround(tmp_path / "both")
    with pytest.raises(sigmascape.Error, match="keeps its buildings apart"):
        sigmascape.LiveGround(tmp_path / "apart")
    with pytest.raises(sigmascape.Error, match="buildings: is 'away'; give 'baked', 'apart' or 'both'"):
        sigmascape.bake(town, tmp_path / "away", buildings="away", **options)


def test_what_a_progress_listener_raises_ends_the_bake(scene, tmp_path):
    def refuse(*_):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        sigmascape.bake(scene, tmp_path, azimuths=2, elevations_deg=[30.0], texel_m=2.0, patch_texels=256, samples=2, progress=refuse)


def test_an_atlas_without_looks_has_no_error_to_tell(scene, tmp_path):
    def refuse(*_):
        raise LookupError("enough")

    options = dict(azimuths=8, elevations_deg=[30.0], texel_m=1.0, patch_texels=256, samples=16)
    with pytest.raises(LookupError):
        sigmascape.bake(scene, tmp_path, **options, progress=refuse)
    info = sigmascape.Atlas(tmp_path).info()
    assert info["looks_done"] == 0 and info["relative_standard_error"] is None


def test_other_threads_run_during_a_bake(scene, tmp_path):
    ticks, done = [], threading.Event()

    def tick():
        while not done.wait(0.005):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    before = time.monotonic()
    sigmascape.bake(scene, tmp_path, azimuths=2, elevations_deg=[30.0], texel_m=1.0, patch_texels=256, samples=16, progress=False)
    after = time.monotonic()
    done.set()
    thread.join()
    assert len([t for t in ticks if before < t < after]) > 5


ENDLESS = """
import sys, sigmascape
scene = sigmascape.Scene.simple()
try:
    sigmascape.bake(scene, sys.argv[1], azimuths=8, texel_m=0.25, patch_texels=512, samples=64, progress=False)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_ctrl_c_ends_a_bake_that_calls_no_python(tmp_path):
    process = subprocess.Popen([sys.executable, "-c", ENDLESS, tmp_path / "atlas"], stdout=subprocess.PIPE, text=True, env=os.environ)
    try:
        # The atlas' description is the first thing that a bake writes; its looks would take minutes.
        give_up = time.monotonic() + 60.0
        while not (tmp_path / "atlas" / "collection.json").exists() and time.monotonic() < give_up:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        told, _ = process.communicate(timeout=60.0)
    finally:
        process.kill()
    assert told == "interrupted\n" and process.returncode == 0


def test_rays_are_given_by_number_or_by_the_error_that_they_are_to_bring(scene, tmp_path):
    for also in (dict(target_db=1.0), dict(most_samples=64)):
        with pytest.raises(sigmascape.Error, match=f"{next(iter(also))}: is given, and samples says how many rays a texel gets; leave out"):
            sigmascape.bake(scene, tmp_path / "atlas", samples=2, progress=False, **also)
    for target_db in (0.0, 11.0, float("nan")):
        with pytest.raises(sigmascape.Error, match="target_db: is .*; give a number from 0.01 to 10"):
            sigmascape.bake(scene, tmp_path / "atlas", target_db=target_db, progress=False)
    assert not (tmp_path / "atlas").exists()


def test_a_bake_does_not_write_over_files_of_others(scene, tmp_path):
    (tmp_path / "terrain.tif").write_bytes(b"of others")
    with pytest.raises(sigmascape.Error, match="holds terrain.tif, which is of no atlas, and a bake would write over it; choose an empty folder"):
        sigmascape.bake(scene, tmp_path, samples=2, progress=False)
    assert [file.name for file in tmp_path.iterdir()] == ["terrain.tif"] and (tmp_path / "terrain.tif").read_bytes() == b"of others"


def test_a_bake_of_no_looks_is_refused(scene, tmp_path):
    empty, numberless = "has no values", "give a whole number from 1 to 3600"
    for none, words in (
        (dict(azimuths=0), numberless),
        (dict(azimuths=2**31), numberless),
        (dict(elevations_deg=[]), empty),
        (dict(frequencies_ghz=[]), empty),
    ):
        with pytest.raises(sigmascape.Error, match=words):
            sigmascape.bake(scene, tmp_path / "atlas", texel_m=2.0, patch_texels=256, samples=2, progress=False, **none)
    assert not (tmp_path / "atlas").exists()
