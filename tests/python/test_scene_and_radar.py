import copy
import os

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
    with pytest.raises(sigmascape.Error, match="x_m: is nan"):
        scene.height_at(float("nan"), 4.0)


def test_arrays_of_a_scene_are_views_of_its_memory(scene):
    for name, kind in [("terrain_m", np.float32), ("ground_material", np.uint8)]:
        array = getattr(scene, name)
        assert array.dtype == kind and array.ndim == 2
        assert not array.flags.owndata and not array.flags.writeable
        assert np.shares_memory(array, getattr(scene, name))


def test_a_view_outlives_the_name_of_its_scene():
    heights = sigmascape.Scene.simple(side_m=50.0).terrain_m
    assert np.all(heights == 0.0)


def test_grids_of_a_scene_say_where_its_arrays_lie(tmp_path):
    """A slope that rises by 0.1 to the east and 0.03 to the north, which heights between nodes keep to; land cover that differs in the
    four quarters."""
    frame = "+proj=tmerc +lat_0=43 +lon_0=-3 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m"

    def slope_m(x, y):
        return 100.0 + 0.1 * x + 0.03 * y

    def written(name, west, south, cell, rows):
        head = f"ncols {len(rows[0])}\nnrows {len(rows)}\nxllcorner {west}\nyllcorner {south}\ncellsize {cell}\n"
        (tmp_path / name).write_text(head + "\n".join(" ".join(map(str, row)) for row in rows) + "\n")

    # A row of cells from the north, of which each is as high as its middle.
    written("heights.asc", -200, -300, 20, [[slope_m(-190 + 20 * j, 290 - 20 * i) for j in range(25)] for i in range(30)])
    written("cover.asc", -200, -300, 50, [[30] * 5 + [40] * 5] * 4 + [[60] * 5 + [80] * 5] * 8)
    (tmp_path / "place.toml").write_text(
        "[scene]\norigin_lat_deg = 43\norigin_lon_deg = -3\nextent = {west_m = -150, south_m = -250, east_m = 210, north_m = 190}\n"
        f"[terrain]\nfile = \"heights.asc\"\ncrs = \"{frame}\"\n[land_cover]\nfile = \"cover.asc\"\ncrs = \"{frame}\"\n")
    scene = sigmascape.Scene.read(tmp_path / "place.toml")
    assert scene.origin_deg == pytest.approx((43.0, -3.0), abs=1e-9)
    west, north, spacing = scene.terrain_grid_m
    assert spacing == pytest.approx(20.0, abs=1e-6)
    rows, columns = scene.terrain_m.shape
    for i, j in [(1, 2), (rows - 3, 4), (5, columns - 2)]:
        x, y = west + j * spacing, north - i * spacing
        assert scene.terrain_m[i, j] == pytest.approx(slope_m(x, y), abs=1e-3)
        assert scene.height_at(x, y) == pytest.approx(float(scene.terrain_m[i, j]), abs=1e-3)
    west, north, cell = scene.ground_grid_m
    names = [material["name"] for material in scene.info()["materials"]]
    for place, name in [((-100.0, 150.0), "grass"), ((120.0, 130.0), "crops"), ((-60.0, -130.0), "bare_soil"), ((150.0, 20.0), "water")]:
        i, j = int((north - place[1]) / cell), int((place[0] - west) / cell)
        assert names[scene.ground_material[i, j]] == name


def test_the_radar_stands_where_it_is_seen_from(scene):
    radar = sigmascape.Radar()
    radar.see_from(azimuth_deg=90.0, elevation_deg=30.0, slant_range_m=2000.0, target_m=(10.0, -5.0))
    # Eastwards by the ground range, up by half of the slant range.
    assert radar.position_over(scene) == pytest.approx((10.0 + 2000.0 * np.sqrt(0.75), -5.0, 1000.0))
    radar.stand_at((1.0, 2.0, 3000.0))
    assert radar.position_over(scene) == (1.0, 2.0, 3000.0)


def test_attributes_of_a_radar_are_read_back():
    radar = sigmascape.Radar(name="r", frequency_hz=35e9, range_resolution_m=1.5, beam_width_deg=0.7, polarization="hh", cell_m=4.0)
    assert (radar.frequency_hz, radar.range_resolution_m, radar.cell_m) == (35e9, 1.5, 4.0)
    assert radar.beam_width_deg == pytest.approx(0.7) and radar.polarization == "hh" and radar.name == "r"
    other = copy.copy(radar)
    other.mode, other.velocity_mps, other.area_m = "stripmap", (0.0, 100.0, 0.0), (0.0, 0.0, 10.0, 20.0)
    assert (other.mode, other.velocity_mps, other.area_m) == ("stripmap", (0.0, 100.0, 0.0), (0.0, 0.0, 10.0, 20.0))
    assert radar.mode == "real-beam" and radar.area_m is None


RADAR_TEXT = """[radar]
frequency_ghz = 9.5
range_resolution_m = 3.0
beam_width_deg = 1.5
wind_mps = 4.0
[antenna]
elevation_shape = "gaussian"
elevation_width_deg = 10.0
tilt_deg = -20.0
[waveform]
peak_power_w = 2500.0
pulse_length_us = 5.0
[receiver]
losses_db = 3.0
stc_full_gain_range_km = 12.0
[scan]
kind = "fixed"
azimuth_deg = 30.0
"""


def test_a_radar_is_read_from_a_text_and_from_its_keys_as_from_a_file(tmp_path):
    (tmp_path / "radar.toml").write_text(RADAR_TEXT)
    keys = {"radar": {"name": None, "frequency_ghz": 9.5, "range_resolution_m": np.float32(3.0), "beam_width_deg": 1.5, "wind_mps": np.int64(4)},
            "antenna": {"elevation_shape": "gaussian", "elevation_width_deg": 10, "tilt_deg": -20.0},
            "waveform": {"peak_power_w": 2500.0, "pulse_length_us": 5.0},
            "receiver": {"losses_db": 3.0, "stc_full_gain_range_km": 12.0},
            "scan": {"kind": "fixed", "azimuth_deg": 30.0}}
    for radar in (sigmascape.Radar.read(tmp_path / "radar.toml"), sigmascape.Radar.parse(RADAR_TEXT), sigmascape.Radar.from_keys(keys)):
        assert (radar.frequency_hz, radar.range_resolution_m, radar.wind_mps, radar.peak_power_w) == (9.5e9, 3.0, 4.0, 2500.0)
        assert (radar.tilt_deg, radar.losses_db, radar.pulse_length_s) == pytest.approx((-20.0, 3.0, 5e-6))


def test_single_numbers_in_arrays_are_keys_of_a_radar_as_they_are():
    radar = sigmascape.Radar.from_keys({"radar": {"frequency_ghz": np.array(9.6), "range_resolution_m": np.array([2]), "beam_width_deg": 1.75 * np.ones(1)},
                                        "platform": {"speed_mps": np.array(100), "heading_deg": 90.0}, "mode": {"kind": "spotlight", "thermal_noise": np.bool_(True)}})
    assert (radar.frequency_hz, radar.range_resolution_m, radar.thermal_noise) == (9.6e9, 2.0, True)
    assert radar.beam_width_deg == pytest.approx(1.75)
    with pytest.raises(sigmascape.Error, match="radar.frequency_ghz: is true"):
        sigmascape.Radar.from_keys({"radar": {"frequency_ghz": np.bool_(True), "range_resolution_m": 2.0, "beam_width_deg": 2.0}})


def test_files_that_the_keys_of_a_radar_name_lie_in_the_folder(tmp_path, monkeypatch):
    (tmp_path / "cut.csv").write_text(TABLE)
    keys = {"radar": {"frequency_ghz": 10.0, "range_resolution_m": 4.0}, "antenna": {"azimuth_shape": "table", "azimuth_csv": "cut.csv"}}
    # -3 dB, of decibels that are linear between 0 at 0° and -3 at 2°, and the same to the left.
    width_deg = pytest.approx(4.0, abs=0.02)
    assert sigmascape.Radar.from_keys(keys, folder=tmp_path).beam_width_deg == width_deg
    with pytest.raises(sigmascape.Error, match="antenna.azimuth_csv"):
        sigmascape.Radar.from_keys(keys)
    keys["antenna"]["azimuth_csv"] = tmp_path / "cut.csv"
    assert sigmascape.Radar.from_keys(keys).beam_width_deg == width_deg
    keys["antenna"]["azimuth_csv"] = "cut.csv"
    monkeypatch.chdir(tmp_path)
    assert sigmascape.Radar.from_keys(keys).beam_width_deg == width_deg


def test_texts_in_keys_of_a_radar_are_kept_letter_by_letter():
    name = 'a "b" \\ c\n\t#é'
    assert sigmascape.Radar.from_keys({"radar": {"name": name, "frequency_ghz": 10.0, "range_resolution_m": 4.0, "beam_width_deg": 1.0}}).name == name


def test_a_radar_without_a_position_says_so_where_one_is_needed(scene):
    radar = sigmascape.Radar.parse(RADAR_TEXT)
    with pytest.raises(sigmascape.Error, match="position of the radar: is not stated; .* call see_from or stand_at"):
        radar.position_over(scene)
    with pytest.raises(sigmascape.Error, match="position of the radar: is not stated"):
        sigmascape.render(scene, radar)
    radar.stand_at((0.0, 0.0, 900.0))
    assert radar.position_over(scene) == (0.0, 0.0, 900.0)


def test_numbers_of_antenna_pulse_and_receiver_are_attributes():
    radar = sigmascape.Radar.parse(RADAR_TEXT)
    # Of a Gaussian beam 10° wide the gain is half, horizontally, when it looks 5° down.
    radar.gain_dbi, radar.tilt_deg = 30.0, -5.0
    assert gain_db(radar) == pytest.approx(30.0 - 10.0 * np.log10(2.0), abs=1e-3)
    radar.beam_width_deg = 0.5
    assert radar.gain_dbi == pytest.approx(30.0), "stated, it goes with the beam no longer"
    for name, value in {"tilt_deg": -7.0, "peak_power_w": 1e5, "pulse_length_s": 1e-5, "losses_db": 2.0, "noise_figure_db": 4.0, "receiver_gain_db": 60.0,
                        "first_range_m": 2000.0, "last_range_m": 9000.0, "atmosphere_db_per_km": 0.1, "wind_mps": 8.0, "earth_refraction": 4.0 / 3.0,
                        "ambiguities": False, "antenna_pattern": True, "thermal_noise": True}.items():
        setattr(radar, name, value)
        assert getattr(radar, name) == pytest.approx(value), name
    radar.first_range_m = radar.earth_refraction = None
    assert (radar.first_range_m, radar.earth_refraction) == (None, None)
    radar.range_resolution_m = 5.0
    assert radar.pulse_length_s == 1e-5, "stated, it goes with the resolution no longer"


def test_received_power_goes_with_transmitter_losses_and_air(atlas):
    """The radar equation: P_t, 1/L, and e^(-2 α r) at the map's range."""
    def power(**attributes):
        radar = sigmascape.Radar(range_resolution_m=4.0, beam_width_deg=2.0)
        radar.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0)
        for name, value in attributes.items():
            setattr(radar, name, value)
        vv = sigmascape.received_power(None, radar, atlas=atlas).vv.astype(float)
        return vv[tuple(size // 2 for size in vv.shape)]

    plain = power()
    assert power(peak_power_w=20e3) / plain == pytest.approx(2.0, rel=1e-4)
    assert power(losses_db=10.0) / plain == pytest.approx(0.1, rel=1e-4)
    # 4 dB/km over twice 2.5 km: 20 dB, and 8 dB a kilometre that the cell lies off the middle.
    assert 10 * np.log10(power(atmosphere_db_per_km=4.0) / plain) == pytest.approx(-20.0, abs=0.2)


def test_settings_that_hold_radars_and_targets_copy_deeply():
    settings = {"radar": sigmascape.Radar(name="r"), "targets": [sigmascape.Target(name="t")]}
    other = copy.deepcopy(settings)
    other["radar"].name = "other"
    assert settings["radar"].name == "r" and [target.name for target in other["targets"]] == ["t"]
    assert copy.copy(settings["targets"][0]).name == "t"


def test_errors_name_files_whose_names_are_not_utf_8(tmp_path):
    latin = tmp_path / os.fsdecode(b"pl\xe4ne")
    for read in [sigmascape.Scene.read, sigmascape.Radar.read, sigmascape.Atlas]:
        with pytest.raises(sigmascape.Error) as told:
            read(latin)
        assert str(latin) in str(told.value)


TABLE = "offset_deg,gain_db\n-4,10\n-2,27\n0,30\n2,27\n4,10\n"


def radar_of(folder, keys="range_resolution_m = 4.0\nbeam_width_deg = 2.0", sections=""):
    """A radar that is read from a file; all of its place is made up."""
    (folder / "cut.csv").write_text(TABLE)
    (folder / "radar.toml").write_text(f"[radar]\nfrequency_ghz = 10.0\n{keys}\n[position]\nazimuth_deg = 180.0\nelevation_deg = 15.0\n"
                                       f"slant_range_km = 2.5\n{sections}\n")
    return sigmascape.Radar.read(folder / "radar.toml")


def gain_db(radar):
    return float(sigmascape.antenna_gain_db(radar, [0.0])[0])


@pytest.mark.parametrize("antenna", ["", "azimuth_shape = 'taylor'", "efficiency = 0.5\nelevation_shape = 'gaussian'\nelevation_width_deg = 3.0",
                                     "gain_dbi = 33.0"])
def test_the_gain_goes_with_the_beam_as_the_file_would_have_it(antenna, atlas, tmp_path):
    sections = f"[antenna]\n{antenna}" if antenna else ""
    wide = radar_of(tmp_path, sections=sections)
    narrow = radar_of(tmp_path, "range_resolution_m = 4.0\nbeam_width_deg = 0.5", sections)
    wide.beam_width_deg = 0.5
    assert gain_db(wide) == gain_db(narrow)
    set_power, read_power = (sigmascape.received_power(None, radar, atlas=atlas).vv for radar in (wide, narrow))
    assert np.array_equal(set_power, read_power, equal_nan=True)
    if "gain_dbi" in antenna:
        assert gain_db(wide) == pytest.approx(33.0)


def test_a_radar_made_of_its_numbers_is_that_of_a_file(tmp_path):
    for made in (sigmascape.Radar(range_resolution_m=4.0, beam_width_deg=2.0), sigmascape.Radar()):
        made.range_resolution_m, made.beam_width_deg = 4.0, 2.0
        made.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0)
        read = radar_of(tmp_path)
        # 4π over the solid angle of a Gaussian fan that is even in elevation: 4 √(π ln 2) / θ.
        assert gain_db(made) == gain_db(read) == pytest.approx(10 * np.log10(4.0 * np.sqrt(np.pi * np.log(2)) / np.radians(2.0)), abs=0.01)


def test_pulses_have_the_length_that_the_file_leaves_open(atlas, tmp_path):
    """In volts, which pulse compression raises by the pulse's length times its bandwidth."""
    def volts(radar):
        radar.velocity_mps = (100.0, 0.0, 0.0)
        return np.abs(sigmascape.phase_history(atlas, radar, interval_s=0.002, calibrated=True).samples).mean()

    fine, coarse = (f"range_resolution_m = {width}\nbeam_width_deg = 2.0" for width in (2.0, 4.0))
    changed = radar_of(tmp_path, fine)
    changed.range_resolution_m = 4.0
    assert volts(changed) == volts(radar_of(tmp_path, coarse))
    stated = radar_of(tmp_path, fine, "[waveform]\npulse_length_us = 0.1")
    with pytest.raises(sigmascape.Error, match="range_resolution_m: is 40, coarser than a pulse of 0.1 µs can be; give at most 1"):
        stated.range_resolution_m = 40.0
    assert stated.range_resolution_m == 2.0


def test_a_radar_has_no_band_that_its_carrier_has_no_room_for():
    with pytest.raises(sigmascape.Error, match="range_resolution_m: is 0.1, .* reaches down to no frequency at all; give more than 0.31"):
        sigmascape.Radar(frequency_hz=0.3e9, range_resolution_m=0.1)
    radar = sigmascape.Radar(range_resolution_m=0.1)
    with pytest.raises(sigmascape.Error, match="frequency_hz: is 3e.08, .* or first a coarser range_resolution_m"):
        radar.frequency_hz = 0.3e9
    assert (radar.frequency_hz, radar.range_resolution_m) == (10e9, 0.1)


def test_the_width_of_a_measured_beam_is_its_tables(tmp_path):
    radar = radar_of(tmp_path, "range_resolution_m = 4.0", "[antenna]\nazimuth_shape = 'table'\nazimuth_csv = 'cut.csv'")
    width, gain = radar.beam_width_deg, gain_db(radar)
    with pytest.raises(sigmascape.Error, match="beam_width_deg: is that of the antenna's table, antenna.azimuth_csv of the radar file; give"):
        radar.beam_width_deg = 0.5
    assert (radar.beam_width_deg, gain_db(radar)) == (width, gain)


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
    (lambda: setattr(sigmascape.Radar(), "cell_m", 0.0), "cell_m: is 0; give a number from 0.05 to 10000"),
    (lambda: setattr(sigmascape.Radar(), "cell_m", 1e-9), "cell_m: is 1e-09; give"),
    (lambda: sigmascape.Radar(cell_m=1e-9), "cell_m: is 1e-09; give"),
    (lambda: setattr(sigmascape.Radar(), "beam_width_deg", 91.0), "beam_width_deg: is 91; give a number from 1e-05 to 90"),
    (lambda: setattr(sigmascape.Radar(), "frequency_hz", 1e12), "frequency_hz: is 1e\\+12; give a number from 100000000 to 3e\\+11"),
    (lambda: setattr(sigmascape.Radar(), "interval_s", 1e9), "interval_s: is 1000000000; give a number from 0.0001 to 1000"),
    (lambda: setattr(sigmascape.Radar(), "area_m", (float("nan"),) * 4), "area_m: is nan"),
    (lambda: setattr(sigmascape.Radar(), "area_m", (10.0, 0.0, 0.0, 10.0)), "area_m: reaches from 10 m to 0 m east and from 0 m to 10 m north"),
    (lambda: setattr(sigmascape.Radar(), "tilt_deg", -5.0), "tilt_deg: is -5, which means nothing to a beam that is even in elevation"),
    (lambda: setattr(sigmascape.Radar(), "wind_mps", 41.0), "wind_mps: is 41; give a number from 0 to 40"),
    (lambda: setattr(sigmascape.Radar(), "pulse_length_s", 1e-9), "pulse_length_s: is 1e-09; give .*, of a pulse that is not coded, to 0.0005"),
    (lambda: setattr(sigmascape.Radar(), "last_range_m", 0.0), "last_range_m: is 0, and the gate closes before it opens"),
    (lambda: setattr(sigmascape.Radar(), "gain_dbi", 81.0), "gain_dbi: is 81; give a number from -10 to 80"),
    (lambda: sigmascape.Radar.parse("[radar"), "radar text:1: is not TOML"),
    (lambda: sigmascape.Radar.parse("[radar]\nfrequency_ghz = 10.0\n"), "radar text: radar.range_resolution_m: is missing"),
    (lambda: sigmascape.Radar.from_keys({"radar": {"frequency_ghz": "ten"}}), "radar keys: radar.frequency_ghz: "),
    (lambda: sigmascape.Radar.from_keys({"radar": {"frequency_ghz": [10.0]}}), "radar.frequency_ghz: is of type list; give a number"),
    (lambda: sigmascape.Radar.from_keys({"frequency_ghz": 10.0}), "frequency_ghz: is no section; give"),
    (lambda: sigmascape.Target((float("nan"), 0.0)), "position_m: is nan"),
    (lambda: sigmascape.Target(rcs_dbsm=float("inf")), "rcs_dbsm: is inf; give a number from -100 to 100"),
    (lambda: sigmascape.Target(size_m=(1.0, -2.0, 3.0)), "size_m: is -2"),
    (lambda: sigmascape.plot("never.svg", {"a": (np.ones((2, 2)), np.ones((2, 2)))}), "series 'a': is not a pair of lists of numbers"),
])
def test_errors_say_where_what_and_what_would_be_right(action, words):
    with pytest.raises(sigmascape.Error, match=words):
        action()
    assert issubclass(sigmascape.Error, ValueError)


def whole_numbers(scene, radar, atlas, name, number):
    """Calls that take a whole number of that name."""
    given = {name: number}
    if name in ("samples", "bounces", "seed", "threads", "dwell"):
        yield lambda: sigmascape.render(scene, radar, **given)
        yield lambda: sigmascape.received_power(scene, radar, **given)
        yield lambda: sigmascape.layers(scene, radar, ["shadow"], **given)
    if name in ("seed", "threads", "dwell"):
        yield lambda: sigmascape.phase_history(atlas, radar, **given)
        yield lambda: sigmascape.range_doppler(atlas, radar, **given)
        yield lambda: sigmascape.stripmap(atlas, radar, **given)
    if name in ("samples", "bounces", "seed", "threads", "azimuths", "patch_texels", "most_samples", "mantissa_bits"):
        yield lambda: sigmascape.bake(scene, "never", **given)
    if name in ("seed", "swerling"):
        yield lambda: sigmascape.Target(**given)
    if name == "seed":
        yield lambda: sigmascape.Scene.paper(**given)
    if name == "threads":
        yield lambda: sigmascape.make_dataset("never.toml", "never", **given)


@pytest.mark.parametrize("number", [-1, 2**64, np.int64(-1), -2**70])
@pytest.mark.parametrize("name", ["samples", "bounces", "seed", "threads", "dwell", "azimuths", "patch_texels", "most_samples", "mantissa_bits", "swerling"])
def test_whole_numbers_out_of_range_are_told_by_their_name(scene, radar, atlas, name, number):
    calls = list(whole_numbers(scene, radar, atlas, name, number))
    assert calls
    for call in calls:
        with pytest.raises(sigmascape.Error, match=f"^{name}: is {number}; give a whole number from [0-9]+ to [0-9]+$"):
            call()


@pytest.mark.parametrize("number", [2.0, np.float32(2.0), np.array(1.9), np.array([1.0]), "2", None])
def test_what_is_no_whole_number_is_of_the_wrong_type(scene, radar, atlas, number):
    with pytest.raises(TypeError):
        sigmascape.render(scene, radar, threads=number)
    with pytest.raises(TypeError):
        radar.looks = number
    if number is not None:
        with pytest.raises(TypeError):
            sigmascape.render(scene, radar, lod=number, atlas=atlas)
        with pytest.raises(TypeError):
            sigmascape.layers(scene, radar, ["shadow"], lod=number)


def test_whole_numbers_may_be_of_numpy(scene, radar):
    options = dict(samples=2, bounces=1, progress=False)
    seen = sigmascape.render(scene, radar, seed=np.uint64(2**64 - 1), threads=np.int8(1), **options)
    assert np.array_equal(seen.vv, sigmascape.render(scene, radar, seed=2**64 - 1, **options).vv, equal_nan=True)


def test_a_file_of_which_nothing_is_used_makes_a_warning(tmp_path):
    frame = "+proj=tmerc +lat_0=43 +lon_0=-3 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m"
    (tmp_path / "heights.asc").write_text(
        "ncols 4\nnrows 4\nxllcorner -100\nyllcorner -100\ncellsize 50\n" + "10 " * 16)
    (tmp_path / "trees.csv").write_text("x,y,h\n5000,0,10\n6000,0,10\n")
    path = tmp_path / "place.toml"
    path.write_text(f'[terrain]\nfile = "heights.asc"\ncrs = "{frame}"\n'
                    f'[[trees]]\nfile = "trees.csv"\ncrs = "{frame}"\nx = "x"\ny = "y"\nheight_attribute = "h"\n')
    with pytest.warns(UserWarning, match="place: trees outside the scene, .*nothing of the file is used: 2, first"):
        scene = sigmascape.Scene.read(path)
    assert [remark["count"] for remark in scene.info()["remarks"]] == [2]
