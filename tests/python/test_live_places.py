import math

import pytest

import sigmascape


@pytest.fixture
def ground(atlas):
    return sigmascape.LiveGround(atlas.folder, cache_mib=64)


def test_degrees_become_metres_and_turn_back(ground, scene):
    assert scene.origin_deg == (0.0, 0.0) and ground.crs == scene.crs
    # A degree of the meridian from the equator, on the WGS 84 ellipsoid.
    assert ground.place_in_frame(1.0, 0.0) == pytest.approx((0.0, 110574.389), abs=1e-2)
    assert ground.place_on_globe(0.0, 110574.389) == pytest.approx((1.0, 0.0), abs=1e-7)
    with pytest.raises(sigmascape.Error, match="latitude 91"):
        ground.place_in_frame(91.0, 0.0)
    with pytest.raises(sigmascape.Error, match="nowhere on the globe"):
        ground.place_on_globe(math.nan, 0.0)


def test_a_ground_says_what_it_covers(ground, atlas):
    assert ground.extent_m == atlas.extent_m


def test_a_radar_below_all_ground_is_refused(ground):
    renderer = sigmascape.LiveRenderer(ground, beams=8, ranges=8)
    assert renderer.render((0.0, 0.0, 50.0), first_azimuth_rad=0.0, first_range_m=100.0).below_ground_m == 0.0
    with pytest.raises(sigmascape.Error, match="below all ground"):
        renderer.render((0.0, 0.0, -5000.0), first_azimuth_rad=0.0, first_range_m=100.0)
