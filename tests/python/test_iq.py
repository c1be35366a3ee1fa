import copy
import hashlib
import json
import os
import re
import resource
import subprocess

import numpy as np
import pytest

import sigmascape


@pytest.fixture(scope="session")
def h5py():
    return pytest.importorskip("h5py")


@pytest.fixture(scope="module")
def moving_radar():
    radar = sigmascape.Radar(name="mover", range_resolution_m=3.0, beam_width_deg=1.0, cell_m=2.0)
    radar.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0)
    radar.velocity_mps = (120.0, 5.0, 0.0)
    radar.pulse_repetition_hz = 2000.0
    return radar


@pytest.fixture(scope="module")
def pulses(atlas, moving_radar):
    return sigmascape.phase_history(atlas, moving_radar, interval_s=0.02, seed=7)


@pytest.mark.parametrize("call, options, words", [
    (sigmascape.phase_history, dict(scatterer_spacing_m=-1.0), "scatterer_spacing_m: is -1; give at most "),
    (sigmascape.phase_history, dict(scatterer_spacing_m=120.0), "scatterer_spacing_m: is 120; give at most 3 m, the radar's range resolution, or 0 for "),
    (sigmascape.range_doppler, dict(scatterer_spacing_m=float("nan")), "scatterer_spacing_m: is nan"),
    (sigmascape.stripmap, dict(scatterer_spacing_m=float("inf")), "scatterer_spacing_m: is inf"),
    (sigmascape.stripmap, dict(along_resolution_m=1e-9), "along_resolution_m: is 1e-09; give a number from 0.01 to 10000"),
    (sigmascape.stripmap, dict(along_resolution_m=float("inf")), "along_resolution_m: is inf"),
])
def test_signals_that_cannot_be_are_refused(atlas, moving_radar, call, options, words):
    with pytest.raises(sigmascape.Error, match=words):
        call(atlas, moving_radar, **options)


def test_a_radar_is_to_be_placed(atlas):
    with pytest.raises(sigmascape.Error, match="position of the radar: is not stated"):
        sigmascape.phase_history(atlas, sigmascape.Radar(), interval_s=0.01)


def test_an_atlas_alone_knows_no_leaves(atlas, moving_radar):
    radar = copy.copy(moving_radar)
    radar.wind_mps = 5.0
    with pytest.warns(UserWarning, match="has wind, which moves leaves of a scene"):
        assert sigmascape.phase_history(atlas, radar, interval_s=0.005).metadata["wind_mps"] == 0.0


def test_pulses_are_a_view_with_axes(pulses):
    samples, axes = pulses.samples, pulses.axes
    assert samples.dtype == np.complex64 and samples.shape[0] == 40 and samples.shape[2] == 3
    assert not samples.flags.owndata and np.shares_memory(samples, pulses.samples)
    assert list(axes) == ["pulse_time_s", "slant_range_m"]
    assert [len(values) for values in axes.values()] == list(samples.shape[:2])
    assert np.allclose(np.diff(axes["pulse_time_s"]), 1.0 / 2000.0)
    assert axes["slant_range_m"][0] < 2500.0 < axes["slant_range_m"][-1]
    metadata = pulses.metadata
    assert metadata["radar"] == "mover" and metadata["seed"] == "7" and metadata["frequency_hz"] == 10e9
    assert metadata["software"] == f"Sigmascape {sigmascape.__version__}" and "tmerc" in metadata["crs"]


def test_bare_ground_that_is_kept_apart_is_in_the_pulses(tmp_path_factory, moving_radar):
    """Rough ground with a hardly visible box: nearly all the power is the ground's, which the textures do not hold."""
    scene = sigmascape.Scene.simple(side_m=96.0, ground_material="grass")
    mean = {}
    for shadows in ["run-time", "baked"]:
        folder = tmp_path_factory.mktemp("rough")
        sigmascape.bake(scene, folder, azimuths=2, elevations_deg=[15.0], texel_m=1.0, patch_texels=256, samples=8, shadows=shadows,
                        progress=False)
        atlas = sigmascape.Atlas(folder)
        looks = [sigmascape.phase_history(atlas, moving_radar, interval_s=0.001, seed=seed).samples[..., 0] for seed in range(40)]
        mean[shadows] = np.mean(np.abs(looks) ** 2, axis=(0, 1))
    # Before the objects, and behind them where their shadows lie.
    for part in [slice(4, 18), slice(-18, -4)]:
        assert mean["run-time"][part].sum() == pytest.approx(mean["baked"][part].sum(), rel=0.1)


def test_numpy_files_read_back_the_same(pulses, tmp_path):
    pulses.save(tmp_path / "pulses.npy")
    assert np.array_equal(np.load(tmp_path / "pulses.npy"), pulses.samples)
    described = json.loads((tmp_path / "pulses.json").read_text())
    assert described["axes"] == ["pulse_time", "slant_range", "polarization"] and described["unit"] == "m"
    pulses.save(tmp_path / "pulses.npz")
    archive = np.load(tmp_path / "pulses.npz")
    assert np.array_equal(archive["samples"], pulses.samples)
    for name, values in pulses.axes.items():
        assert np.array_equal(archive[name], values)
    assert archive["platform_velocity_mps"].tolist() == [[120.0, 5.0, 0.0]] * 40
    travelled = archive["platform_position_m"][-1] - archive["platform_position_m"][0]
    assert travelled == pytest.approx(np.array([120.0, 5.0, 0.0]) * np.ptp(archive["pulse_time_s"]))
    assert json.loads(archive["description_json"].tobytes())["radar"] == "mover"


def test_hdf5_opens_with_plain_h5py(h5py, pulses, tmp_path):
    pulses.save(tmp_path / "pulses.h5")
    with h5py.File(tmp_path / "pulses.h5") as file:
        for number, name in enumerate(["VV", "HH", "HV"]):
            assert file[name].dtype == np.complex64
            assert np.array_equal(file[name][:], pulses.samples[..., number])
            assert file[name].attrs["units"].decode() == "m"
            assert file[name].dims[0][0].name == "/pulse_time" and file[name].dims[1][0].name == "/slant_range"
        assert np.array_equal(file["slant_range"], pulses.axes["slant_range_m"])
        assert file["pulse_time"].attrs["units"].decode() == "s"
        assert file["platform_position"].shape == (40, 3)
        assert file.attrs["frequency_hz"] == 10e9 and file.attrs["radar"].decode() == "mover"
        assert file.attrs["scene_hash"].decode() == pulses.metadata["scene_hash"]
        said = {name: file.attrs[name].decode() for name in ("kind", "unit", "axes", "units", "polarizations")}
        assert said == {"kind": "phase history", "unit": "m", "axes": "pulse_time, slant_range", "units": "s, m",
                        "polarizations": "VV, HH, HV"}


def test_pulses_in_volts_say_where_the_beam_pointed(h5py, atlas, moving_radar, pulses, tmp_path):
    volts = sigmascape.phase_history(atlas, moving_radar, interval_s=0.02, calibrated=True)
    volts.save(tmp_path / "volts.npz")
    archive = np.load(tmp_path / "volts.npz")
    east_m, north_m, _ = archive["platform_position_m"].T
    # Onto the middle of the map from each of the places in turn.
    assert archive["beam_azimuth_rad"] == pytest.approx(np.arctan2(-east_m, -north_m), abs=1e-9)
    volts.save(tmp_path / "volts.h5")
    with h5py.File(tmp_path / "volts.h5") as file:
        assert np.array_equal(file["beam_azimuth"], archive["beam_azimuth_rad"])
        assert file.attrs["azimuth_shape"].decode() == "gaussian" and file.attrs["window"].decode() == "taylor"
    pulses.save(tmp_path / "metres.npz")
    assert "beam_azimuth_rad" not in np.load(tmp_path / "metres.npz")


def test_motion_and_beam_are_arrays_in_memory_too(atlas, moving_radar, pulses, tmp_path):
    """What a file holds of them, without one."""
    volts = sigmascape.phase_history(atlas, moving_radar, interval_s=0.02, calibrated=True)
    for signal in [volts, pulses, sigmascape.range_doppler(atlas, moving_radar, interval_s=0.05),
                   sigmascape.stripmap(atlas, moving_radar, along_resolution_m=3.0)]:
        signal.save(tmp_path / "saved.npz")
        archive = np.load(tmp_path / "saved.npz")
        for name in ["platform_position_m", "platform_velocity_mps"]:
            assert np.array_equal(getattr(signal, name), archive[name])
        assert (signal.beam_azimuth_rad is not None) == (signal is volts)
    assert volts.platform_position_m.shape == (40, 3) and volts.platform_velocity_mps[7].tolist() == [120.0, 5.0, 0.0]
    east_m, north_m, _ = volts.platform_position_m.T
    assert volts.beam_azimuth_rad == pytest.approx(np.arctan2(-east_m, -north_m), abs=1e-9)


def test_an_interval_that_is_left_out_is_that_of_the_mode(atlas, moving_radar):
    usual = sigmascape.phase_history(atlas, moving_radar)
    assert usual.metadata["interval_s"] == pytest.approx(0.1) and usual.metadata["radar_mode"] == "real-beam"
    spotlight = sigmascape.Radar(range_resolution_m=3.0, beam_width_deg=1.0, cell_m=2.0)
    spotlight.see_from(azimuth_deg=180.0, elevation_deg=15.0, slant_range_m=2500.0)
    spotlight.velocity_mps, spotlight.pulse_repetition_hz = (120.0, 5.0, 0.0), 2000.0
    spotlight.mode, spotlight.interval_s = "spotlight", 0.04
    planned = sigmascape.phase_history(atlas, spotlight)
    assert len(planned.samples) == 80
    assert planned.metadata["radar_mode"] == "spotlight" and planned.metadata["mode_interval_s"] == 0.04
    with pytest.warns(UserWarning, match="pulses are recorded for 0.01 s, and the spotlight of this radar adds up 0.04 s"):
        assert len(sigmascape.phase_history(atlas, spotlight, interval_s=0.01).samples) == 20


def test_the_table_of_a_measured_antenna_is_in_memory_and_in_files(h5py, atlas, tmp_path):
    (tmp_path / "cut.csv").write_text("offset_deg,gain_db\n-4,5\n-1.5,20\n0.25,30\n1,24\n6,-10\n")
    (tmp_path / "radar.toml").write_text("""
[radar]
frequency_ghz = 10.0
range_resolution_m = 3.0
[antenna]
azimuth_shape = "table"
azimuth_csv = "cut.csv"
[position]
azimuth_deg = 180.0
elevation_deg = 15.0
slant_range_km = 2.5
""")
    radar = sigmascape.Radar.read(tmp_path / "radar.toml")
    volts = sigmascape.phase_history(atlas, radar, interval_s=0.01, calibrated=True)
    assert list(volts.cuts) == ["azimuth_offset_deg", "azimuth_gain_dB"]
    assert volts.cuts["azimuth_offset_deg"] == pytest.approx([-4.0, -1.5, 0.25, 1.0, 6.0])
    # Of gains only differences matter: they are relative to the peak.
    assert volts.cuts["azimuth_gain_dB"] == pytest.approx([-25.0, -10.0, 0.0, -6.0, -40.0], abs=1e-9)
    volts.save(tmp_path / "volts.npz")
    volts.save(tmp_path / "volts.h5")
    archive = np.load(tmp_path / "volts.npz")
    with h5py.File(tmp_path / "volts.h5") as file:
        for name, unit in [("azimuth_offset", "deg"), ("azimuth_gain", "dB")]:
            assert np.array_equal(file[name], volts.cuts[f"{name}_{unit}"]) and file[name].attrs["units"].decode() == unit
            assert np.array_equal(archive[f"{name}_{unit}"], volts.cuts[f"{name}_{unit}"])
    assert sigmascape.phase_history(atlas, radar, interval_s=0.01).cuts == {}


def test_hdf5_keeps_to_what_matlab_reads(h5py, pulses, tmp_path):
    """Names are identifiers of at most 63 letters, texts have a fixed length, numbers are doubles: h5readatt and h5read know no more."""
    pulses.save(tmp_path / "pulses.h5")
    with h5py.File(tmp_path / "pulses.h5") as file:
        for name in file:
            assert re.fullmatch(r"[A-Za-z]\w{0,62}", name)
        for place in [file, *file.values()]:
            for name in place.attrs:
                if name in ("CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST"):
                    continue  # of dimension scales, HDF5's own
                assert re.fullmatch(r"[A-Za-z]\w{0,62}", name)
                kind = place.attrs.get_id(name)
                assert kind.shape == ()
                assert kind.dtype == np.float64 or (kind.dtype.kind == "S" and kind.get_type().get_strpad() in (0, 1))
        assert file["VV"].dtype.kind == "c" and file["VV"].id.get_type().get_nmembers() == 2
        assert [file["VV"].id.get_type().get_member_name(i) for i in range(2)] == [b"r", b"i"]
        for axis in ["pulse_time", "slant_range", "platform_position", "platform_velocity"]:
            assert file[axis].dtype == np.float64 and "units" in file[axis].attrs


def test_sigmf_has_a_channel_a_polarization_and_a_capture_a_pulse(pulses, tmp_path):
    pulses.save(tmp_path / "pulses.sigmf-meta")
    meta = json.loads((tmp_path / "pulses.sigmf-meta").read_text())
    assert meta["global"]["core:datatype"] == "cf32_le" and meta["global"]["core:num_channels"] == 3
    ranges = pulses.axes["slant_range_m"]
    assert meta["global"]["core:sample_rate"] == pytest.approx(299_792_458.0 / (2.0 * (ranges[1] - ranges[0])))
    assert [c["core:sample_start"] for c in meta["captures"]] == [i * len(ranges) for i in range(40)]
    assert all(c["core:frequency"] == 10e9 for c in meta["captures"])
    data = np.fromfile(tmp_path / "pulses.sigmf-data", dtype="<c8")
    assert np.array_equal(data.reshape(pulses.samples.shape), pulses.samples)


@pytest.mark.parametrize("ending", ["npy", "npz", "h5", "sigmf-meta"])
def test_equal_recordings_give_equal_bytes(pulses, tmp_path, ending):
    digests = []
    for folder in ["a", "b"]:
        pulses.save(tmp_path / folder / f"pulses.{ending}")
        digests.append([hashlib.sha256(f.read_bytes()).digest() for f in sorted((tmp_path / folder).iterdir())])
    assert digests[0] == digests[1]


def test_focused_images_and_live_frames_are_written_too(h5py, atlas, moving_radar, tmp_path):
    image = sigmascape.range_doppler(atlas, moving_radar, interval_s=0.05)
    image.save(tmp_path / "image.h5")
    with h5py.File(tmp_path / "image.h5") as file:
        assert np.array_equal(file["HH"][:], image.samples[..., 1])
        assert list(image.axes) == ["slant_range_m", "doppler_Hz"] and file["doppler"].attrs["units"].decode() == "Hz"
    renderer = sigmascape.LiveRenderer(sigmascape.LiveGround(atlas.folder), beams=8, ranges=16, beam_step_rad=5e-3, range_step_m=6.0)
    frame = renderer.render((0.0, -2900.0, 800.0), first_azimuth_rad=-0.02, first_range_m=2960.0)
    frame.save(tmp_path / "frame.npz", frequency_ghz=10.0)
    archive = np.load(tmp_path / "frame.npz")
    assert np.array_equal(archive["samples"], frame.amplitudes_m)
    assert archive["slant_range_m"][0] == 2963.0 and archive["platform_position_m"].tolist() == [[0.0, -2900.0, 800.0]]


@pytest.mark.parametrize("ending", ["npy", "npz", "h5", "sigmf-meta"])
def test_a_full_disk_names_the_file_and_leaves_nothing(pulses, tmp_path, ending):
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, before[1]))
    try:
        with pytest.raises(sigmascape.Error, match=r"pulses\.[a-z0-9-]+: cannot be written"):
            pulses.save(tmp_path / f"pulses.{ending}")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_written_is_refused(atlas, pulses, moving_radar, tmp_path):
    with pytest.raises(sigmascape.Error, match="pulses.wav: is no kind of file"):
        pulses.save(tmp_path / "pulses.wav")
    still = sigmascape.Radar()
    still.stand_at((0.0, -2000.0, 500.0))
    with pytest.raises(sigmascape.Error, match="stands still"):
        sigmascape.range_doppler(atlas, still, interval_s=0.05)
    assert np.isfinite(sigmascape.phase_history(atlas, still, interval_s=0.01).samples).all()
    for interval_s in [-1.0, 0.0, float("nan")]:
        with pytest.raises(sigmascape.Error, match="interval_s: is .* s; give more than 0"):
            sigmascape.phase_history(atlas, moving_radar, interval_s=interval_s)
    (tmp_path / "file").write_text("")
    with pytest.raises(Exception):
        pulses.save(tmp_path / "file" / "pulses.h5")


@pytest.fixture(scope="module")
def small_place(tmp_path_factory):
    """A scene, a radar that flies past it and the atlas that the command line baked for it."""
    folder = tmp_path_factory.mktemp("place")
    (folder / "scene.toml").write_text("[paper]\nscale = 0.1\n")
    (folder / "radar.toml").write_text("""
[radar]
frequency_ghz = 10.0
range_resolution_m = 5.0
beam_width_deg = 1.0
[position]
azimuth_deg = 130.0
elevation_deg = 20.0
slant_range_km = 5.0
[platform]
speed_mps = 100.0
heading_deg = 40.0
[map]
cell_m = 5.0
""")
    subprocess.run([os.environ["SIGMASCAPE_CLI"], "bake", folder / "scene.toml", "--out", folder / "atlas", "--azimuths", "2",
                    "--elevations-deg", "20", "--samples", "2", "--texel-m", "4", "--patch-texels", "256"], check=True)
    return folder


@pytest.mark.parametrize("kind", ["spotlight", "stripmap", "doppler-beam-sharpening"])
def test_slant_images_say_the_same_under_every_ending(h5py, small_place, tmp_path, kind):
    (tmp_path / "radar.toml").write_text((small_place / "radar.toml").read_text() + f"[mode]\nkind = \"{kind}\"\nlooks = 2\n")
    for ending in ["npy", "npz", "h5", "sigmf-meta"]:
        subprocess.run([os.environ["SIGMASCAPE_CLI"], "render", tmp_path / "radar.toml", "--scene", small_place / "scene.toml", "--atlas",
                        small_place / "atlas", "--lod", "1", "--slant-image", tmp_path / f"image.{ending}"], check=True)
    described = json.loads((tmp_path / "image.json").read_text())
    assert isinstance(described["interval_s"], float) and described["looks"] == 1 and described["mode"] == kind
    arrays = dict(np.load(tmp_path / "image.npz"))
    assert np.array_equal(arrays.pop("samples"), np.load(tmp_path / "image.npy"))
    words = json.loads(arrays.pop("description_json").tobytes())
    for name, array in arrays.items():
        assert np.array_equal(described.pop(name), array), name
    assert words == described
    meta = json.loads((tmp_path / "image.sigmf-meta").read_text())["global"]
    assert all(meta[f"sigmascape:{key}"] == value for key, value in described.items())
    samples = np.load(tmp_path / "image.npy")
    with h5py.File(tmp_path / "image.h5") as file:
        assert np.array_equal(file["VV"][:], samples[..., 0]) and samples.any()
        for key, value in described.items():
            if key in ("axes", "units", "unit", "polarizations"):
                continue  # in HDF5 as datasets and their attributes
            said = file.attrs[key]
            assert (said.decode() if isinstance(said, bytes) else said) == value, key
    radar, atlas = sigmascape.Radar.read(tmp_path / "radar.toml"), sigmascape.Atlas(small_place / "atlas")
    ours = (sigmascape.stripmap if kind == "stripmap" else sigmascape.range_doppler)(atlas, radar)
    assert np.array_equal(ours.samples, samples), "with the ground around the map that answers in its outermost cells"


@pytest.mark.parametrize("slant_range_km", np.linspace(20.0, 29.0, 6))
def test_slant_images_over_the_round_earth_have_the_scatterers_of_the_command_line(small_place, tmp_path, slant_range_km):
    """Their spacing goes by steps, and where the resolution is that of range it stands right on one."""
    text = (small_place / "radar.toml").read_text().replace("[position]", "earth_refraction = 1.3333\n[position]")
    text = "\n".join(f"slant_range_km = {slant_range_km}" if line.startswith("slant_range_km") else line for line in text.splitlines())
    (tmp_path / "radar.toml").write_text(text + "\n[mode]\nkind = \"spotlight\"\n")
    subprocess.run([os.environ["SIGMASCAPE_CLI"], "render", tmp_path / "radar.toml", "--scene", small_place / "scene.toml", "--atlas",
                    small_place / "atlas", "--lod", "1", "--slant-image", tmp_path / "image.npy"], check=True)
    ours = sigmascape.range_doppler(sigmascape.Atlas(small_place / "atlas"), sigmascape.Radar.read(tmp_path / "radar.toml"))
    assert np.array_equal(ours.samples, np.load(tmp_path / "image.npy"))


@pytest.mark.parametrize("mode", ["", "[mode]\nkind = \"spotlight\"\nalong_resolution_m = 2\n"])
def test_the_command_line_writes_the_same_pulses(small_place, tmp_path, mode):
    (tmp_path / "radar.toml").write_text((small_place / "radar.toml").read_text() + mode)
    subprocess.run([os.environ["SIGMASCAPE_CLI"], "render", tmp_path / "radar.toml", "--scene", small_place / "scene.toml", "--atlas",
                    small_place / "atlas", "--lod", "1", "--iq", tmp_path / "pulses.npy", "--interval-s", "0.01"], check=True)
    radar, atlas = sigmascape.Radar.read(tmp_path / "radar.toml"), sigmascape.Atlas(small_place / "atlas")
    ours = sigmascape.phase_history(atlas, radar, interval_s=0.01)
    assert ours.samples.any()
    assert np.array_equal(np.load(tmp_path / "pulses.npy"), ours.samples)
    # Of a map to 2 m they have its scatterers, of the interval alone those of the range resolution.
    by_range = sigmascape.phase_history(atlas, radar, interval_s=0.01, scatterer_spacing_m=2.5)
    assert np.array_equal(ours.samples, by_range.samples) == (mode == "")


def test_scatterers_are_as_fine_as_what_the_pulses_tell_apart(atlas, moving_radar):
    """In 0.4 s that is a metre across ranges of 3 m, in 0.01 s far more than 3 m."""
    for record, interval_s, by_range in [(sigmascape.phase_history, 0.01, True), (sigmascape.phase_history, 0.4, False),
                                         (sigmascape.range_doppler, 0.01, True), (sigmascape.range_doppler, 0.4, False)]:
        usual = record(atlas, moving_radar, interval_s=interval_s).samples
        assert np.array_equal(usual, record(atlas, moving_radar, interval_s=interval_s, scatterer_spacing_m=1.5).samples) == by_range
    strip = sigmascape.stripmap(atlas, moving_radar, along_resolution_m=1.5).samples
    assert np.array_equal(strip, sigmascape.stripmap(atlas, moving_radar, along_resolution_m=1.5, scatterer_spacing_m=0.75).samples)


def test_a_later_moment_is_what_has_moved_there(scene, atlas, moving_radar):
    """Radar and targets have moved, the ground's speckle is the same: as if all had been placed there."""
    there = sigmascape.Radar(name="mover", range_resolution_m=3.0, beam_width_deg=1.0, cell_m=2.0)
    start = np.array(moving_radar.position_over(scene))
    there.stand_at(tuple(start + 2.0 * np.array(moving_radar.velocity_mps)))
    assert moving_radar.position_over(scene, 2.0) == pytest.approx(there.position_over(scene))
    seen_then = sigmascape.layers(scene, moving_radar, ["range"], time_s=2.0)["range"]
    assert np.allclose(seen_then, sigmascape.layers(scene, there, ["range"])["range"])
    there.velocity_mps = moving_radar.velocity_mps
    there.pulse_repetition_hz = 2000.0
    lorry = dict(heading_deg=0.0, speed_mps=8.0, rcs_dbsm=40.0, altitude_m=2.0)
    then = sigmascape.phase_history(atlas, moving_radar, interval_s=0.02, seed=7, time_s=2.0,
                                    targets=[sigmascape.Target((3.0, -20.0), **lorry)])
    moved = sigmascape.phase_history(atlas, there, interval_s=0.02, seed=7,
                                     targets=[sigmascape.Target((3.0, -4.0), **lorry)])
    assert then.samples.any() and then.samples.shape == moved.samples.shape
    scale = np.abs(moved.samples).max()
    assert np.abs(then.samples - moved.samples).max() < 1e-3 * scale
    assert then.metadata["time_s"] == 2.0 and then.metadata["dwell"] == 0.0
    with pytest.raises(sigmascape.Error, match="time_s: is nan; give a number from -1000000 to 1000000"):
        sigmascape.phase_history(atlas, moving_radar, time_s=float("nan"))
