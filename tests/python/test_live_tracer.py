import json

import numpy as np
import pytest

import sigmascape

POSE = dict(first_azimuth_rad=-0.02, first_range_m=2960.0)
PLACE = (0.0, -2900.0, 800.0)


def tracer_of(scene, **settings):
    return sigmascape.LiveTracer(scene, beams=20, ranges=30, beam_step_rad=2e-3, range_step_m=3.0, lattice_m=1.0, **settings)


def test_calls_add_rays_until_the_pose_changes(scene):
    tracer = tracer_of(scene, content="powers", rays_per_cell=4)
    first = tracer.render(PLACE, **POSE)
    assert first.powers_m2.shape == (20, 30, 4) and first.rays_per_cell == 4 and first.powers_m2.max() > 0.0
    early = first.median_error_db
    for _ in range(15):
        frame = tracer.render(PLACE, **POSE)
    assert frame.rays_per_cell == 64 and 0.0 < frame.median_error_db < early
    assert tracer.render((0.0, -2900.0, 801.0), **POSE).rays_per_cell == 4


def test_a_scan_traces_its_beams_alone(scene):
    tracer = tracer_of(scene, content="powers", rays_per_cell=4, bounces=1)
    whole = tracer.render(PLACE, **POSE)
    cells, before = whole.cells, whole.powers_m2.copy()
    scanning = tracer_of(scene, content="powers", rays_per_cell=4, bounces=1)
    for beam in range(0, 20, 6):
        step = scanning.scan(PLACE, **POSE, first_beam=beam, count=6)
        assert step.cells < cells
    np.testing.assert_array_equal(step.powers_m2, before)
    after = scanning.scan((0.0, -2900.0, 790.0), **POSE, first_beam=6, count=6).powers_m2
    changed = (after != before).any(axis=(1, 2))
    assert changed[6:12].any() and not changed[:6].any() and not changed[12:].any()


def test_a_traced_frame_is_like_one_from_textures(scene, atlas):
    settings = dict(content="powers", beams=20, ranges=30, beam_step_rad=2e-3, range_step_m=3.0)
    ground = sigmascape.LiveGround(atlas.folder, cache_mib=64)
    renderer = sigmascape.LiveRenderer(ground, **settings)
    renderer.render(PLACE, **POSE)
    ground.wait()
    baked = renderer.render(PLACE, **POSE).powers_m2[..., 0]
    traced = sigmascape.LiveTracer(scene, rays_per_cell=32, lattice_m=1.0, **settings).render(PLACE, **POSE).powers_m2[..., 0]
    # Bins whose ground lies well within the scene: the atlas goes on beyond it.
    inner = np.s_[5:15, 10:20]
    assert 10 * np.log10(traced[inner].sum() / baked[inner].sum()) == pytest.approx(0.0, abs=1.5)


def test_the_choice_is_level_0_for_a_small_area(scene):
    assert tracer_of(scene).advised_detail(PLACE, **POSE) == 0


def test_wrong_settings_are_refused(scene):
    with pytest.raises(TypeError, match="scene: sigmascape.Scene"):
        sigmascape.LiveTracer(None)
    with pytest.raises(sigmascape.Error, match="content"):
        tracer_of(scene, content="colours")
    with pytest.raises(sigmascape.Error, match="rays"):
        tracer_of(scene, rays_per_cell=0)
    with pytest.raises(sigmascape.Error, match="above the scene"):
        tracer_of(scene).render((0.0, -100.0, 1.0), first_azimuth_rad=-0.02, first_range_m=90.0)


def test_files_say_whom_to_credit(tmp_path, radar):
    (tmp_path / "dem.asc").write_text("ncols 60\nnrows 60\nxllcorner 500000\nyllcorner 4800000\ncellsize 4\n" + ("0 " * 60 + "\n") * 60)
    (tmp_path / "scene.toml").write_text('[scene]\nattribution = "(c) Somebody, CC BY 4.0"\n'
                                         '[terrain]\nfile = "dem.asc"\ncrs = "EPSG:25830"\n')
    scene = sigmascape.Scene.read(tmp_path / "scene.toml")
    tracer_of(scene, rays_per_cell=1).render(PLACE, **POSE).save(tmp_path / "frame.npy")
    assert json.loads((tmp_path / "frame.json").read_text())["attribution"] == "(c) Somebody, CC BY 4.0"
    layers = sigmascape.layers(scene, radar, ["shadow"])
    layers.save(tmp_path / "layers.tif")
    assert b"(c) Somebody, CC BY 4.0" in (tmp_path / "layers.tif").read_bytes()
