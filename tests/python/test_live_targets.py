"""Targets of live frames, however they are drawn: in the bins that geometry puts them into."""

import numpy as np
import pytest

import sigmascape

PLACE = (0.0, -2900.0, 800.0)
POSE = dict(first_azimuth_rad=-0.03, first_range_m=2960.0)
BINS = dict(content="powers", beams=30, ranges=40, beam_step_rad=2e-3, range_step_m=3.0)


@pytest.fixture(params=["LiveRenderer", "LiveTracer", "LiveFlight"])
def live(request, scene, atlas):
    ground = sigmascape.LiveGround(atlas.folder, cache_mib=64)
    if request.param == "LiveTracer":
        return sigmascape.LiveTracer(scene, rays_per_cell=1, **BINS)
    if request.param == "LiveFlight":
        return sigmascape.LiveFlight(scene, ground, rays_per_cell=1, **BINS)
    renderer = sigmascape.LiveRenderer(ground, **BINS)
    renderer.render(PLACE, **POSE)
    ground.wait()
    return renderer


def brightest(frame):
    return np.unravel_index(np.argmax(frame.powers_m2[..., 0]), frame.powers_m2.shape[:2])


def bin_of(x_m, y_m, altitude_m):
    east, north = x_m - PLACE[0], y_m - PLACE[1]
    slant_range_m = np.sqrt(east**2 + north**2 + (altitude_m - PLACE[2]) ** 2)
    return (int((np.arctan2(east, north) - POSE["first_azimuth_rad"]) / BINS["beam_step_rad"]),
            int((slant_range_m - POSE["first_range_m"]) / BINS["range_step_m"]))


def test_a_target_answers_where_it_stands(live):
    without = live.render(PLACE, **POSE)
    assert without.targets == 0
    ground_m2 = without.powers_m2[..., 0].sum(dtype=np.float64)
    live.set_targets([sigmascape.Target((20.0, -30.0), rcs_dbsm=60.0, altitude_m=12.0)])
    frame = live.render(PLACE, **POSE)
    assert frame.targets == 1 and brightest(frame) == bin_of(20.0, -30.0, 12.0)
    assert frame.powers_m2[..., 0].sum(dtype=np.float64) - ground_m2 == pytest.approx(1e6, rel=1e-3)  # over the bins it has a share in
    live.set_targets([])
    assert live.render(PLACE, **POSE).targets == 0


def test_a_target_stands_on_the_ground(live, atlas):
    ground = sigmascape.LiveGround(atlas.folder, cache_mib=64)
    live.set_targets([sigmascape.Target((-15.0, -40.0), rcs_dbsm=60.0, height_m=15.0)])
    assert brightest(live.render(PLACE, **POSE)) == bin_of(-15.0, -40.0, ground.height_at(-15.0, -40.0) + 15.0)


def test_what_moves_has_moved_on_by_the_frames_time(live):
    live.set_targets([sigmascape.Target((-20.0, -30.0), rcs_dbsm=60.0, altitude_m=12.0, speed_mps=30.0, heading_deg=90.0)])
    assert brightest(live.render(PLACE, **POSE)) == bin_of(-20.0, -30.0, 12.0)
    assert brightest(live.render(PLACE, **POSE, time_s=1.0)) == bin_of(10.0, -30.0, 12.0)


def test_scans_draw_targets_of_their_beams(live):
    live.set_targets([sigmascape.Target((20.0, -30.0), rcs_dbsm=60.0, altitude_m=12.0)])
    beam, _ = bin_of(20.0, -30.0, 12.0)
    assert live.scan(PLACE, **POSE, first_beam=0, count=beam - 2).targets == 0
    step = live.scan(PLACE, **POSE, first_beam=beam - 1, count=3)
    assert step.targets == 1 and brightest(step) == bin_of(20.0, -30.0, 12.0)


def test_what_fluctuates_does_so_by_dwells(live):
    live.set_targets([sigmascape.Target((20.0, -30.0), rcs_dbsm=60.0, altitude_m=12.0, swerling=1)])
    powers = [live.render(PLACE, **POSE, dwell=dwell, pulse=pulse).powers_m2[..., 0].max()
              for dwell, pulse in ((1, 0), (2, 0), (1, 0), (1, 5))]
    assert powers[1] != powers[0] and powers[2] == powers[3] == powers[0]


def test_a_target_outside_the_terrain_is_named(live):
    live.set_targets([sigmascape.Target((20.0, -30.0), rcs_dbsm=60.0, altitude_m=12.0)])
    with pytest.raises(sigmascape.Error, match="lorry: has a place at .* outside the terrain"):
        live.set_targets([sigmascape.Target((1e6, 0.0), name="lorry")])
    assert live.render(PLACE, **POSE).targets == 1  # those before


def test_targets_of_the_scene_answer_besides(tmp_path):
    (tmp_path / "dem.asc").write_text("ncols 60\nnrows 60\nxllcorner 500000\nyllcorner 4800000\ncellsize 4\n" + ("0 " * 60 + "\n") * 60)
    (tmp_path / "scene.toml").write_text('[terrain]\nfile = "dem.asc"\ncrs = "EPSG:25830"\n'
                                         '[[point_targets]]\nposition_m = [20.0, -40.0]\nheight_m = 2.0\nrcs_dbsm = 60.0\n')
    tracer = sigmascape.LiveTracer(sigmascape.Scene.read(tmp_path / "scene.toml"), rays_per_cell=1, **BINS)
    frame = tracer.render(PLACE, **POSE)
    assert frame.targets == 1 and brightest(frame)[0] == bin_of(20.0, -40.0, 2.0)[0]
    tracer.set_targets([sigmascape.Target((-15.0, -40.0), rcs_dbsm=60.0, height_m=15.0)])
    assert tracer.render(PLACE, **POSE).targets == 2
    tracer.set_targets([])
    assert tracer.render(PLACE, **POSE).targets == 1
