"""Modes, targets and layers from Python: where things lie is known beforehand."""

import numpy as np
import pytest

import sigmascape


@pytest.fixture
def flying(radar):
    radar.beam_width_deg = 1.0
    radar.velocity_mps = (100.0, 0.0, 0.0)
    radar.pulse_repetition_hz = 4000.0
    return radar


def brightest(ground_map):
    row, column = np.unravel_index(np.nanargmax(ground_map.vv), ground_map.shape)
    return (ground_map.west_m + (column + 0.5) * ground_map.cell_m, ground_map.north_m - (row + 0.5) * ground_map.cell_m)


@pytest.mark.parametrize("mode", ["real-beam", "spotlight", "stripmap", "doppler-beam-sharpening"])
def test_every_mode_puts_a_target_where_it_stands(atlas, flying, mode):
    flying.mode = mode
    if mode == "doppler-beam-sharpening":
        flying.sharpening = 16.0
    if mode == "real-beam":
        flying.beam_width_deg = 0.05
    target = sigmascape.Target((-20.0, -30.0), name="reflector", rcs_dbsm=60.0, height_m=0.0)
    ground_map = sigmascape.render(None, flying, atlas=atlas, targets=[target])
    # The sharpened beam is still 2.7 m wide there.
    assert brightest(ground_map) == pytest.approx((-20.0, -30.0), abs=3.0)
    assert ("mode" in ground_map.metadata) == (mode != "real-beam")
    assert ground_map.metadata["seed"] == "1"
    if mode != "real-beam":
        assert ground_map.metadata["mode"] == mode
        other = sigmascape.render(None, flying, atlas=atlas, targets=[target], seed=2)
        assert not np.array_equal(other.sigma0, ground_map.sigma0, equal_nan=True)


def test_a_house_hides_what_stands_behind_it(scene, atlas, radar):
    height = sigmascape.layers(scene, radar, ["height"])["height"]
    row, column = np.argwhere(height > 1.0)[0]
    behind = (-48.0 + 2.0 * column + 1.0, 48.0 - 2.0 * row + 1.0)
    without = sigmascape.render(None, radar, atlas=atlas)
    with_it = sigmascape.render(None, radar, atlas=atlas, targets=[sigmascape.Target(behind, rcs_dbsm=60.0, height_m=0.5)])
    assert np.array_equal(with_it.sigma0, without.sigma0, equal_nan=True)


def test_what_moves_towards_the_radar_seems_to_lie_ahead(atlas, flying):
    """Displaced along the flight by r times the speed of approach over that of the platform."""
    flying.mode = "spotlight"
    speed = 0.4
    target = sigmascape.Target((-20.0, -30.0), rcs_dbsm=60.0, height_m=0.0, heading_deg=180.0, speed_mps=speed)
    x, y = brightest(sigmascape.render(None, flying, atlas=atlas, targets=[target]))
    assert x == pytest.approx(-20.0 + 2480.0 * speed * np.cos(np.radians(15.0)) / 100.0, abs=2.0)
    assert y == pytest.approx(-30.0, abs=3.0)


def test_pulses_hold_the_targets(atlas, flying):
    quiet = sigmascape.phase_history(atlas, flying, interval_s=0.005)
    target = sigmascape.Target((0.0, 0.0), rcs_dbsm=70.0, height_m=0.0)
    pulses = sigmascape.phase_history(atlas, flying, interval_s=0.005, targets=[target])
    power = np.abs(pulses.samples[..., 0] - quiet.samples[..., 0]) ** 2
    middle = pulses.samples.shape[0] // 2
    # The platform is at its place in the middle pulse: 2,500 m from the target.
    assert pulses.axes["slant_range_m"][power[middle].argmax()] == pytest.approx(2500.0, abs=1.0)
    assert 10 * np.log10(power[middle].max()) == pytest.approx(70.0, abs=1.5)


def test_images_have_what_the_mode_asks_for(atlas, flying):
    flying.mode = "spotlight"
    flying.looks, flying.along_resolution_m = 4, 2.0
    ground = sigmascape.render(None, flying, atlas=atlas)
    image = sigmascape.range_doppler(atlas, flying)
    assert image.metadata["interval_s"] == pytest.approx(float(ground.metadata["interval_s"]), rel=1e-3)
    assert image.metadata["along_resolution_m"] == pytest.approx(0.5, rel=1e-3)
    assert 0.0 < image.metadata["angle_off_course_deg"] < 180.0
    shorter = sigmascape.range_doppler(atlas, flying, interval_s=0.01)
    assert shorter.metadata["interval_s"] == pytest.approx(0.01) and shorter.metadata["looks"] == 1.0
    assert shorter.metadata["along_resolution_m"] > 2.0
    flying.mode, flying.looks, flying.along_resolution_m = "stripmap", 2, 4.0
    strip = sigmascape.stripmap(atlas, flying)
    assert strip.metadata["along_resolution_m"] == pytest.approx(2.0, rel=1e-3) and strip.metadata["interval_s"] > 0.0
    assert sigmascape.stripmap(atlas, flying, along_resolution_m=3.0).metadata["along_resolution_m"] == pytest.approx(3.0)


def test_a_pulse_leaves_the_receiver_half_of_the_time(flying):
    with pytest.raises(sigmascape.Error, match="pulse_repetition_hz: is 1e"):
        flying.range_resolution_m = 100.0
        flying.pulse_repetition_hz = 1e6


def test_a_stripmap_image_has_its_axes(atlas, flying, tmp_path):
    flying.mode = "stripmap"
    target = sigmascape.Target((-20.0, -30.0), rcs_dbsm=70.0, height_m=0.0)
    image = sigmascape.stripmap(atlas, flying, along_resolution_m=2.0, targets=[target])
    assert list(image.axes) == ["closest_slant_range_m", "along_track_m"]
    assert [len(axis) for axis in image.axes.values()] == list(image.samples.shape[:2])
    row, column = np.unravel_index(np.abs(image.samples[..., 0]).argmax(), image.samples.shape[:2])
    # Closest when the platform passes x = -20; then it is 30 m further south than the scene's middle.
    east, height = 2500.0 * np.cos(np.radians(15.0)) - 30.0, 2500.0 * np.sin(np.radians(15.0))
    assert image.axes["along_track_m"][column] == pytest.approx(-20.0, abs=1.5)
    assert image.axes["closest_slant_range_m"][row] == pytest.approx(np.hypot(east, height), abs=1.5)
    image.save(tmp_path / "image.npy")
    assert np.array_equal(np.load(tmp_path / "image.npy"), image.samples)


def test_targets_come_from_files_too(tmp_path, atlas, radar):
    (tmp_path / "targets.toml").write_text('[[targets]]\nname = "car"\nposition_m = [12, -8]\nheight_m = 0\nrcs_dbsm = 60\n')
    targets = sigmascape.read_targets(tmp_path / "targets.toml")
    assert [target.name for target in targets] == ["car"]
    assert brightest(sigmascape.render(None, radar, atlas=atlas, targets=targets)) == pytest.approx((12.0, -8.0), abs=2.1)
    moving = sigmascape.Target(way_points=[(-10.0, 0.0, 0.0, 0.0), (10.0, 40.0, -20.0, 0.0)], rcs_dbsm=60.0)
    assert brightest(sigmascape.render(None, radar, atlas=atlas, targets=[moving])) == pytest.approx((20.0, -10.0), abs=2.1)


@pytest.mark.parametrize("name, value", [("position_m", (5.0, 0.0)), ("speed_mps", 3.0), ("climb_mps", 1.0), ("height_m", 0.0),
                                         ("altitude_m", 3000.0)])
def test_way_points_alone_say_where_a_target_is(name, value):
    """As the keys of a targets file, of which none is read over."""
    with pytest.raises(sigmascape.Error, match=f"^{name}: .*way_points"):
        sigmascape.Target(way_points=[(0.0, 0.0, 0.0, 2.0), (9.0, 40.0, 0.0, 2.0)], **{name: value})
    sigmascape.Target(way_points=[(0.0, 0.0, 0.0, 2.0)], heading_deg=90.0, size_m=(4.0, 2.0, 2.0))


@pytest.mark.parametrize("name, point", [("time_s", (float("nan"), 0.0, 0.0, 2.0)), ("x_m", (0.0, float("inf"), 0.0, 2.0)),
                                         ("y_m", (0.0, 0.0, -2e7, 2.0)), ("height_m", (0.0, 0.0, 0.0, -0.5)),
                                         ("height_m", (0.0, 0.0, 0.0, 2e6))])
def test_way_points_keep_to_the_bounds_of_a_targets_file(name, point):
    """Those of docs/target_file.md: under the ground no target would ever be seen."""
    with pytest.raises(sigmascape.Error, match=f"^way_points: {name}: is .*give a number from"):
        sigmascape.Target(way_points=[point])


def test_targets_fluctuate_each_for_itself(atlas, radar):
    def added(places, run=1, **options):
        targets = [sigmascape.Target(place, rcs_dbsm=60.0, swerling=1, **options) for place in places]
        maps = [sigmascape.render(None, radar, atlas=atlas, targets=given, seed=run) for given in (targets, [])]
        return np.nansum(maps[0].vv.astype(float)) - np.nansum(maps[1].vv.astype(float))

    # Cells read the responses where their middles happen to lie in them.
    one, other = (12.0, -8.0), (-20.0, -30.0)
    assert added([one, other]) != pytest.approx(2.0 * added([one]), rel=0.15)
    assert added([one, other], seed=7) == pytest.approx(2.0 * added([one], seed=7), rel=0.15)
    assert added([one], run=2) != pytest.approx(added([one]), rel=0.05)
    assert added([one], run=2, seed=7) == pytest.approx(added([one], seed=7), rel=0.05)


@pytest.fixture
def blown_upon(tmp_path):
    """A radar that flies past in so much wind and tells 2 m apart."""
    def made(wind_mps):
        (tmp_path / "radar.toml").write_text(
            f"[radar]\nfrequency_ghz = 10\nrange_resolution_m = 2\nbeam_width_deg = 1\nwind_mps = {wind_mps}\n"
            "[mode]\nkind = \"spotlight\"\nalong_resolution_m = 2\n[position]\nazimuth_deg = 180\nelevation_deg = 15\n"
            "slant_range_km = 2.4\n[platform]\nspeed_mps = 100\nheading_deg = 90\n[waveform]\npulse_repetition_hz = 4000\n"
            "[map]\ncell_m = 2\n")
        return sigmascape.Radar.read(tmp_path / "radar.toml")
    return made


def test_wind_is_told_where_it_blows(scene, atlas, blown_upon):
    windy = blown_upon(8)
    assert sigmascape.render(None, windy, atlas=atlas).metadata["wind_mps"] == "0"
    assert sigmascape.render(scene, windy, atlas=atlas).metadata["wind_mps"] == "8"


def test_wind_moves_grass_and_leaves_concrete(scene, atlas, blown_upon, tmp_path):
    """At 10 GHz a quarter of grass stands still in a wind of 8 m/s, and the rest is shifted, by 2400 m 0.175 m/s / 100 m/s = 4 m in the
    mean (docs/physics/speckle.md, Eq. 9): another speckle of the same power."""
    calm, windy = blown_upon(0), blown_upon(8)
    assert np.array_equal(*(sigmascape.render(scene, radar, atlas=atlas).sigma0 for radar in (calm, windy)), equal_nan=True)
    meadow = sigmascape.Scene.simple(side_m=160.0, ground_material="grass")
    sigmascape.bake(meadow, tmp_path / "atlas", azimuths=4, elevations_deg=[15.0], texel_m=1.0, patch_texels=256, samples=4, progress=False)
    grown = sigmascape.Atlas(tmp_path / "atlas")
    # Before the objects, and away from the edges across which grass is shifted out of the map.
    before = (slice(56, -4), slice(8, -8))
    still, moved = (np.array([sigmascape.render(meadow, radar, atlas=grown, seed=seed).vv[before] for seed in range(1, 5)], dtype=float)
                    for radar in (calm, windy))
    assert np.corrcoef(still.ravel(), moved.ravel())[0, 1] < 0.5
    assert 10.0 * np.log10(moved.mean() / still.mean()) == pytest.approx(0.0, abs=0.3)
    without = [sigmascape.render(None, radar, atlas=grown).sigma0 for radar in (calm, windy)]
    assert np.array_equal(*without, equal_nan=True)


@pytest.mark.parametrize("lod", [0, 1])
def test_maps_of_a_later_moment_are_of_what_has_moved(scene, atlas, flying, lod):
    """In 5 s a lorry of 8 m/s goes 40 m to the west, and the radar 500 m to the east."""
    flying.beam_width_deg = 0.05
    lorry = sigmascape.Target((30.0, -36.0), heading_deg=270.0, speed_mps=8.0, height_m=0.0, rcs_dbsm=60.0)
    options = dict(lod=lod, atlas=atlas, targets=[lorry], samples=4, bounces=1, progress=False)

    def radar_m(metadata):
        return np.array([float(word) for word in metadata["radar_position_m"].split()])

    then = sigmascape.render(scene, flying, time_s=5.0, **options)
    assert brightest(then) == pytest.approx((-10.0, -36.0), abs=2.0)
    assert then.metadata["time_s"] == "5"
    now = sigmascape.render(scene, flying, **options)
    assert radar_m(then.metadata) - radar_m(now.metadata) == pytest.approx(np.array([500.0, 0.0, 0.0]), abs=0.02)
    power = sigmascape.received_power(scene, flying, time_s=5.0, **options)
    assert brightest(power) == pytest.approx((-10.0, -36.0), abs=2.0)
    assert radar_m(power.metadata) == pytest.approx(radar_m(then.metadata)) and power.metadata["time_s"] == "5"


@pytest.mark.parametrize("names, options, words", [
    (["bounce1"], dict(samples=0), "samples: is 0; give a whole number from 1 to 16777216"),
    (["bounce1"], dict(bounces=0), "bounces: is 0; give a whole number from 1 to 255"),
    (["bounce1"], dict(bounces=-5), "bounces: is -5"),
    (["bounce1"], dict(bounces=300), "bounces: is 300"),
    (["shadow"], dict(lod=-1), "lod: is negative"),
    (["shadow", "height", "shadow"], {}, "names: has 'shadow' twice; name each layer once"),
    ([], {}, "names: is empty"),
])
def test_layers_that_cannot_be_are_refused(scene, radar, names, options, words):
    with pytest.raises(sigmascape.Error, match=words):
        sigmascape.layers(scene, radar, names, **options)


@pytest.mark.parametrize("lod", [0, 1])
def test_layers_lie_on_the_map(scene, radar, lod, tmp_path):
    names = ["height", "shadow", "incidence", "range", "class"]
    layers = sigmascape.layers(scene, radar, names, lod=lod)
    assert layers.names == names and layers.units["incidence"] == "rad" and layers.units["shadow"] == ""
    shadow, height = layers["shadow"], layers["height"]
    assert shadow.shape == (48, 48) and shadow.dtype == np.float32 and not shadow.flags.owndata
    assert set(np.unique(shadow)) == {0.0, 1.0} and height.max() > 1.0
    # Seen from the south at 15 degrees over level ground.
    open_ground = (shadow == 0.0) & (np.abs(height) < 1e-3)
    assert np.degrees(layers["incidence"][open_ground]).mean() == pytest.approx(75.0, abs=1.0)
    assert layers["range"][0].mean() > layers["range"][-1].mean() + 80.0
    assert len(sigmascape.class_names(scene)) > layers["class"].max()
    assert list(layers) == list(layers.keys()) == names and len(layers) == 5
    assert "shadow" in layers and "layover" not in layers and 3 not in layers
    assert dict(layers).keys() == set(names)
    layers.save(tmp_path / "layers.tif")
    with pytest.raises(sigmascape.Error, match="layers.npz"):
        layers.save(tmp_path / "layers.npz")
    assert not (tmp_path / "layers.npz").exists()
    with pytest.raises(KeyError):
        layers["layover"]


def test_layers_beside_maps_of_an_atlas_take_its_obstacles(scene, atlas, radar):
    of_atlas = sigmascape.layers(scene, radar, ["shadow"], atlas=atlas)["shadow"]
    of_scene = sigmascape.layers(scene, radar, ["shadow"], lod=1)["shadow"]
    assert (of_atlas > 0.5).sum() > 20
    assert (np.abs(of_atlas - of_scene) < 0.5).mean() > 0.97
    with pytest.raises(sigmascape.Error, match="was baked from another scene"):
        sigmascape.layers(sigmascape.Scene.paper(scale=0.1), radar, ["shadow"], atlas=atlas)


@pytest.mark.parametrize("lod", [0, 1])
def test_targets_throw_their_shadows_in_layers(scene, radar, lod):
    names = ["shadow", "layover", "height", "class", "incidence", "range"]
    hall = sigmascape.Target((-30.0, -30.0), rcs_dbsm=0.0, size_m=(8.0, 12.0, 6.0))
    without = sigmascape.layers(scene, radar, names, lod=lod)
    with_it = sigmascape.layers(scene, radar, names, lod=lod, targets=[hall])
    darker = with_it["shadow"] - without["shadow"]
    assert darker.min() == 0.0
    # From the south at 15 degrees: 12 m wide, and 8 m and 6 m / tan 15 degrees = 22 m long; cells of 4 square metres.
    rows, columns = np.nonzero(darker)
    assert 0.5 * 12.0 * 30.0 / 4.0 < rows.size <= 1.2 * 12.0 * 32.0 / 4.0
    assert 48.0 - 2.0 * (rows.max() + 1) == pytest.approx(-34.0, abs=2.0)
    assert np.all(np.abs(-48.0 + 2.0 * columns + 1.0 + 30.0) < 8.0)
    assert np.all(with_it["layover"] <= without["layover"])
    for name in names[2:]:
        assert np.array_equal(with_it[name], without[name])


def test_targets_answer_in_layers_of_bounces(scene, radar):
    options = dict(samples=2, bounces=2, targets=[sigmascape.Target((-20.0, -30.0), rcs_dbsm=60.0, swerling=1)], progress=False)
    for dwell in [0, 1]:
        layers = sigmascape.layers(scene, radar, ["bounce1", "bounce2"], dwell=dwell, **options)
        whole = sigmascape.render(scene, radar, lod=0, dwell=dwell, **options).vv
        assert np.allclose(layers["bounce1"] + layers["bounce2"], whole, rtol=1e-3, atol=1e-6, equal_nan=True)


def test_orders_of_bounces_add_up_to_the_map(scene, radar):
    names = ["bounce1", "bounce2", "bounce3", "bounce4", "bounce5", "multibounce"]
    layers = sigmascape.layers(scene, radar, names, bounces=5, progress=False)
    whole = sigmascape.render(scene, radar, bounces=5, progress=False).vv
    total = sum(layers[name] for name in names[:5])
    assert np.allclose(total, whole, rtol=1e-3, atol=1e-6, equal_nan=True)
    assert np.nansum(layers["bounce2"]) > 0.01 * np.nansum(whole)
    bright = whole > 1e-4
    assert np.allclose(layers["multibounce"][bright], 1.0 - layers["bounce1"][bright] / total[bright], atol=1e-3)
    with pytest.raises(sigmascape.Error, match="lod=0"):
        sigmascape.layers(scene, radar, ["bounce1"], lod=1)
    with pytest.raises(sigmascape.Error, match="shadow"):
        sigmascape.layers(scene, radar, ["shadows"])


def test_what_cannot_be_is_refused(scene, atlas, flying):
    flying.mode = "spotlight"
    with pytest.raises(sigmascape.Error, match="0 traces power alone"):
        sigmascape.render(scene, flying)
    with pytest.raises(sigmascape.Error, match="leave out one of them"):
        sigmascape.Target((0.0, 0.0), height_m=1.0, altitude_m=2.0)
    with pytest.raises(sigmascape.Error, match="swerling"):
        sigmascape.Target((0.0, 0.0), swerling=7)
    with pytest.raises(sigmascape.Error, match="outside the terrain"):
        sigmascape.render(None, flying, atlas=atlas, targets=[sigmascape.Target((9e5, 0.0), name="far")])


def test_a_target_tells_where_it_is_and_what_it_returns(scene, atlas):
    standing = sigmascape.Target((12.0, -7.0), rcs_dbsm=20.0, hv_dbsm=3.0, height_m=2.5, size_m=(4.0, 2.0, 1.5))
    place = (12.0, -7.0, scene.height_at(12.0, -7.0) + 2.5)
    assert standing.position_m(scene) == pytest.approx(place) == standing.position_m(atlas)
    assert standing.rcs_dbsm == pytest.approx({"vv": 20.0, "hh": 20.0, "hv": 3.0}, abs=1e-5)
    assert standing.size_m == (4.0, 2.0, 1.5)
    driving = sigmascape.Target((0.0, 0.0), altitude_m=900.0, speed_mps=10.0, heading_deg=90.0)
    assert driving.position_m(scene, 3.0) == pytest.approx((30.0, 0.0, 900.0))
    with pytest.raises(sigmascape.Error, match="time_s"):
        driving.position_m(scene, float("nan"))


def test_a_corner_reflector_of_half_a_metre():
    """4 pi a^4/(3 lambda^2) of 0.5 m at 3 cm: 290.9 m^2."""
    assert sigmascape.trihedral_rcs_dbsm(0.5, frequency_ghz=0.299792458 / 0.03) == pytest.approx(10 * np.log10(290.888), abs=1e-4)


def test_targets_that_are_not_seen_are_warned_of_and_counted(atlas, radar):
    seen, away = sigmascape.Target((0.0, 0.0), name="seen", rcs_dbsm=50.0), sigmascape.Target((9e5, 0.0), name="away", altitude_m=10.0)
    ground_map = sigmascape.render(None, radar, atlas=atlas, targets=[seen, away])
    assert (ground_map.metadata["targets"], ground_map.metadata["targets_seen"]) == ("2", "1")
    with pytest.warns(UserWarning, match="target away stands beside what is mapped"):
        assert sigmascape.render(None, radar, atlas=atlas, targets=[away]).metadata["targets_seen"] == "0"
