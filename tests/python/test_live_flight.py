import numpy as np
import pytest

import sigmascape

SETTINGS = dict(content="powers", beams=20, ranges=30, beam_step_rad=2e-3)
PLACE = (0.0, -2900.0, 800.0)
POSE = dict(first_azimuth_rad=-0.02, first_range_m=2960.0)


@pytest.fixture
def ground(atlas):
    return sigmascape.LiveGround(atlas.folder, cache_mib=64)


def test_a_small_area_is_traced(scene, ground):
    flight = sigmascape.LiveFlight(scene, ground, range_step_m=3.0, rays_per_cell=4, **SETTINGS)
    frame = flight.render(PLACE, **POSE)
    assert flight.textured_share == 0.0 and frame.rays_per_cell == 4
    assert frame.powers_m2.shape == (20, 30, 4) and frame.powers_m2.max() > 0.0
    assert "level of detail 0" in flight.explained()


def test_in_bins_wider_than_any_shadow_it_is_of_textures(scene, ground):
    settings = dict(SETTINGS, range_step_m=400.0, beam_step_rad=0.15)
    flight = sigmascape.LiveFlight(scene, ground, **settings)
    renderer = sigmascape.LiveRenderer(ground, **settings)
    for live in flight, renderer:
        live.render(PLACE, **POSE)
    ground.wait()
    frame = flight.render(PLACE, **POSE)
    assert flight.textured_share == 1.0 and frame.rays_per_cell == 0
    np.testing.assert_array_equal(frame.powers_m2, renderer.render(PLACE, **POSE).powers_m2)


@pytest.mark.parametrize("bins", [dict(range_step_m=3.0), dict(range_step_m=400.0, beam_step_rad=0.15)])
def test_a_scan_shows_its_beams_at_the_level_they_need(scene, ground, bins):
    settings = dict(SETTINGS, rays_per_cell=4, bounces=1) | bins
    flight, scanning = (sigmascape.LiveFlight(scene, ground, **settings) for _ in range(2))
    scanning.render(PLACE, first_azimuth_rad=0.0, first_range_m=2960.0)
    ground.wait()
    flight.render(PLACE, first_azimuth_rad=0.01, first_range_m=2960.0)
    ground.wait()
    whole = flight.render(PLACE, **POSE).powers_m2.copy()
    for beam in range(0, 20, 8):
        frame = scanning.scan(PLACE, **POSE, first_beam=beam, count=8)
    assert scanning.textured_share == (0.0 if bins["range_step_m"] == 3.0 else 1.0)
    np.testing.assert_array_equal(frame.powers_m2, whole)


def test_wrong_settings_are_refused(scene, ground):
    with pytest.raises(TypeError, match="scene: sigmascape.Scene"):
        sigmascape.LiveFlight(None, ground)
    with pytest.raises(sigmascape.Error, match="content"):
        sigmascape.LiveFlight(scene, ground, content="colours")
    with pytest.raises(sigmascape.Error, match="rays"):
        sigmascape.LiveFlight(scene, ground, rays_per_cell=0)
