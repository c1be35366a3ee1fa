import copy

import numpy as np
import pytest

import sigmascape


def test_a_scene_tells_what_it_is(scene):
    info = scene.info()
    assert info["extent_m"] == scene.extent_m == (-48.0, -48.0, 48.0, 48.0)
    assert info["instances"] == 2
    assert info["scene_hash"] == scene.hash != sigmascape.Scene.simple(side_m=98.0).hash
    assert "concrete" in [material["name"] for material in info["materials"]]
    assert scene.height_at(3.0, 4.0) == 0.0


def test_arrays_of_a_scene_are_views_of_its_memory(scene):
    for name, kind in [("terrain_m", np.float32), ("ground_material", np.uint8)]:
        array = getattr(scene, name)
        assert array.dtype == kind and array.ndim == 2
        assert not array.flags.owndata and not array.flags.writeable
        assert np.shares_memory(array, getattr(scene, name))


def test_a_view_outlives_the_name_of_its_scene():
    heights = sigmascape.Scene.simple(side_m=50.0).terrain_m
    assert np.all(heights == 0.0)


def test_the_radar_stands_where_it_is_seen_from(scene):
    radar = sigmascape.Radar()
    radar.see_from(azimuth_deg=90.0, elevation_deg=30.0, slant_range_m=2000.0, target_m=(10.0, -5.0))
    # Eastwards by the ground range, up by half of the slant range.
    assert radar.position_over(scene) == pytest.approx((10.0 + 2000.0 * np.sqrt(0.75), -5.0, 1000.0))
    radar.stand_at((1.0, 2.0, 3000.0))
    assert radar.position_over(scene) == [1.0, 2.0, 3000.0]


def test_attributes_of_a_radar_are_read_back():
    radar = sigmascape.Radar(name="r", frequency_hz=35e9, range_resolution_m=1.5, beam_width_deg=0.7, polarization="hh", cell_m=4.0)
    assert (radar.frequency_hz, radar.range_resolution_m, radar.cell_m) == (35e9, 1.5, 4.0)
    assert radar.beam_width_deg == pytest.approx(0.7) and radar.polarization == "hh" and radar.name == "r"
    other = copy.copy(radar)
    other.mode, other.velocity_mps, other.area_m = "stripmap", (0.0, 100.0, 0.0), (0.0, 0.0, 10.0, 20.0)
    assert (other.mode, other.velocity_mps, other.area_m) == ("stripmap", [0.0, 100.0, 0.0], [0.0, 0.0, 10.0, 20.0])
    assert radar.mode == "real-beam" and radar.area_m is None


@pytest.mark.parametrize("action, words", [
    (lambda: sigmascape.Scene.read("/does/not/exist.toml"), "/does/not/exist.toml: the file does not exist; give"),
    (lambda: sigmascape.Radar(polarization="xx"), "polarization: is 'xx'; give 'vv'"),
    (lambda: sigmascape.Radar(frequency_hz=-1.0), "frequency_hz: is -1"),
    (lambda: sigmascape.Atlas("/does/not/exist"), "/does/not/exist"),
    (lambda: sigmascape.Scene.paper(scale=100.0), "scale"),
    (lambda: sigmascape.Scene.simple(side_m=float("nan")), "a side of nan m; give 1 to"),
    (lambda: sigmascape.Radar().see_from(azimuth_deg=0.0, elevation_deg=90.0, slant_range_m=1e3), "elevation_deg: is 90; give a number from 0.5 to 89"),
    (lambda: sigmascape.Radar().stand_at((0.0, float("nan"), 0.0)), "position_m: is nan"),
    (lambda: setattr(sigmascape.Radar(), "velocity_mps", (float("inf"), 0.0, 0.0)), "velocity_mps: is inf"),
    (lambda: setattr(sigmascape.Radar(), "looks", 0), "looks: is 0; give a number from 1 to 1000"),
    (lambda: setattr(sigmascape.Radar(), "cell_m", 0.0), "cell_m: is 0; give a number above 0"),
    (lambda: sigmascape.Target((float("nan"), 0.0)), "position_m: is nan"),
    (lambda: sigmascape.Target(rcs_dbsm=float("inf")), "rcs_dbsm: is inf; give a number from -100 to 100"),
    (lambda: sigmascape.Target(size_m=(1.0, -2.0, 3.0)), "size_m: is -2"),
    (lambda: sigmascape.plot("never.svg", {"a": (np.ones((2, 2)), np.ones((2, 2)))}), "series 'a': is not a pair of lists of numbers"),
])
def test_errors_say_where_what_and_what_would_be_right(action, words):
    with pytest.raises(sigmascape.Error, match=words):
        action()
    assert issubclass(sigmascape.Error, ValueError)
