import json

import numpy as np
import pytest

import sigmascape

POSE = dict(first_azimuth_rad=-0.03, first_range_m=2960.0)
PLACE = (0.0, -2900.0, 800.0)


def renderer_of(atlas, **settings):
    ground = sigmascape.LiveGround(atlas.folder, cache_mib=64)
    renderer = sigmascape.LiveRenderer(ground, beams=30, ranges=40, beam_step_rad=2e-3, range_step_m=3.0, **settings)
    renderer.render(PLACE, **POSE)
    ground.wait()
    return renderer


def test_a_frame_is_a_view_of_the_renderers_memory(atlas):
    renderer = renderer_of(atlas)
    frame = renderer.render(PLACE, **POSE)
    bins = frame.amplitudes_m
    assert bins.shape == (30, 40, 4) and bins.dtype == np.complex64 and frame.powers_m2 is None
    assert not bins.flags.owndata and not bins.flags.writeable and np.shares_memory(bins, frame.amplitudes_m)
    assert frame.lit > 0 and np.abs(bins[..., 0]).max() > 0.0
    kept = bins.copy()
    assert np.shares_memory(renderer.render((0.0, -2900.0, 500.0), **POSE).amplitudes_m, bins)
    assert not np.array_equal(kept, bins)  # the next frame takes the place of the last
    del renderer, frame
    assert np.isfinite(bins).all()  # the array keeps the renderer alive


def test_powers_are_the_mean_of_amplitudes(atlas):
    powers = renderer_of(atlas, content="powers").render(PLACE, **POSE).powers_m2
    assert powers.dtype == np.float32 and powers.shape == (30, 40, 4)
    seeds = [renderer_of(atlas, seed=seed).render(PLACE, **POSE).amplitudes_m[..., 0].copy() for seed in range(24)]
    mean = np.mean(np.abs(seeds) ** 2, axis=0)
    lit = powers[..., 0] > 0.0
    assert lit.sum() > 300
    # Each is the mean of 24 exponentials. Beside what is bright some have more: a scatterer lies anywhere in its cell.
    assert np.median(mean[lit] / powers[..., 0][lit]) == pytest.approx(1.0, abs=0.05)
    assert mean.sum() == pytest.approx(powers[..., 0].sum(), rel=0.2)  # a bin or two have most of it


def test_a_scan_renders_its_beams_alone(atlas):
    renderer = renderer_of(atlas)
    before = renderer.render(PLACE, **POSE).amplitudes_m.copy()
    after = renderer.scan((0.0, -2900.0, 700.0), **POSE, first_beam=10, count=5).amplitudes_m
    changed = (after != before).any(axis=(1, 2))
    assert changed[10:15].any() and not changed[:10].any() and not changed[15:].any()


def test_wrong_settings_are_refused(atlas):
    ground = sigmascape.LiveGround(atlas.folder, cache_mib=64)
    with pytest.raises(sigmascape.Error, match="content"):
        sigmascape.LiveRenderer(ground, content="colours")
    with pytest.raises(sigmascape.Error):
        sigmascape.LiveGround(atlas.folder, frequency_ghz=94.0)
    with pytest.raises(sigmascape.Error, match="cache_mib: is 17592186044416; give a whole number from 0 to 17592186044415"):
        sigmascape.LiveGround(atlas.folder, cache_mib=2**44)
    for loaders in (0, 257):
        with pytest.raises(sigmascape.Error, match=f"loaders: is {loaders}; give a whole number from 1 to 256"):
            sigmascape.LiveGround(atlas.folder, loaders=loaders)
    for name in ("beams", "ranges", "seed", "threads"):
        with pytest.raises(sigmascape.Error, match=f"{name}: is -1; give a whole number from [01] to [0-9]+$"):
            sigmascape.LiveRenderer(ground, **{name: -1})
    with pytest.raises(sigmascape.Error, match="y_m: is nan"):
        ground.height_at(0.0, float("nan"))


def test_steps_of_a_scan_begin_with_a_beam_that_there_is(atlas, scene):
    settings = dict(beams=30, ranges=40, beam_step_rad=2e-3, range_step_m=3.0)
    ground = sigmascape.LiveGround(atlas.folder, cache_mib=64)
    for live in (sigmascape.LiveRenderer(ground, **settings), sigmascape.LiveTracer(scene, **settings),
                 sigmascape.LiveFlight(scene, ground, **settings)):
        with pytest.raises(sigmascape.Error, match="first_beam: is 30, and there are 30 beams; give 0 to 29"):
            live.scan(PLACE, **POSE, first_beam=30, count=1)
        with pytest.raises(sigmascape.Error, match="count: is 0"):
            live.scan(PLACE, **POSE, first_beam=0, count=0)


def test_a_frame_is_saved_before_the_next_is_drawn(atlas, tmp_path):
    renderer = renderer_of(atlas)
    first = renderer.render(PLACE, **POSE)
    first.save(tmp_path / "first.npy", frequency_ghz=10.0)
    second = renderer.scan(PLACE, **POSE, first_beam=3, count=2)
    with pytest.raises(sigmascape.Error, match="again.npy: .*before the next is drawn"):
        first.save(tmp_path / "again.npy", frequency_ghz=10.0)
    assert not (tmp_path / "again.npy").exists()
    for refused in (lambda: renderer.scan(PLACE, **POSE, first_beam=3, count=0),
                    lambda: renderer.render((np.nan, 0.0, 0.0), **POSE)):
        with pytest.raises(sigmascape.Error):
            refused()
    second.save(tmp_path / "second.npy", frequency_ghz=10.0)


def test_a_scanned_frame_is_saved_with_a_place_for_each_beam(atlas, tmp_path):
    renderer = renderer_of(atlas)
    renderer.render(PLACE, **POSE).save(tmp_path / "whole.npz")
    assert np.load(tmp_path / "whole.npz")["platform_position_m"].tolist() == [list(PLACE)]
    there = (PLACE[0] + 5.0, PLACE[1], PLACE[2])
    renderer.scan(there, **POSE, first_beam=3, count=2, velocity_mps=(50.0, 0.0, 0.0)).save(tmp_path / "scanned.npz")
    scanned = np.load(tmp_path / "scanned.npz")
    beams = len(scanned["azimuth_rad"])
    assert scanned["platform_position_m"].tolist() == [list(there if beam in (3, 4) else PLACE) for beam in range(beams)]
    assert scanned["platform_velocity_mps"][:, 0].tolist() == [50.0 if beam in (3, 4) else 0.0 for beam in range(beams)]


def test_a_frame_is_saved_with_its_own_frequency(atlas, tmp_path):
    frame = renderer_of(atlas).render(PLACE, **POSE)
    frame.save(tmp_path / "frame.npy")
    assert np.array_equal(np.load(tmp_path / "frame.npy"), frame.amplitudes_m)
    told = json.loads((tmp_path / "frame.json").read_text())
    assert told["scene"] == "simple scene" and told["seed"] == "1" and "+proj=tmerc" in told["crs"]
    assert told["scene_hash"] == sigmascape.Scene.simple(side_m=96.0).hash and told["frequency_hz"] == 10e9
    for wrong in (float("nan"), 0.0, 35.0):
        with pytest.raises(sigmascape.Error, match="frequency_ghz: is"):
            frame.save(tmp_path / "wrong.npy", frequency_ghz=wrong)
    assert not (tmp_path / "wrong.npy").exists()
