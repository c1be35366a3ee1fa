import copy
import json
import os
import struct
import subprocess
import zlib

import numpy as np
import pytest

import sigmascape


def test_a_map_has_layers_that_share_its_memory(scene, atlas, radar):
    ground_map = sigmascape.render(scene, radar, atlas=atlas)
    assert ground_map.shape == ground_map.vv.shape == (48, 48)
    assert ground_map.sigma0.shape == (48, 48, 4) and ground_map.sigma0.dtype == np.float32
    for number, name in enumerate(["vv", "hh", "hv", "re_vvhh"]):
        layer = getattr(ground_map, name)
        assert np.shares_memory(layer, ground_map.sigma0) and not layer.flags.owndata
        assert np.array_equal(layer, ground_map.sigma0[..., number], equal_nan=True)
    assert ground_map.extent_m == (-48.0, -48.0, 48.0, 48.0) and ground_map.cell_m == 2.0
    assert ground_map.metadata["scene_hash"] == scene.hash
    expected_db = 10 * np.log10(np.maximum(ground_map.hh, 1e-3))
    assert np.allclose(ground_map.db("hh", floor_db=-30.0), expected_db, equal_nan=True, atol=1e-4)


def test_the_scene_is_not_needed_where_there_is_an_atlas(scene, atlas, radar):
    with_scene, without = sigmascape.render(scene, radar, atlas=atlas), sigmascape.render(None, radar, atlas=atlas)
    assert np.array_equal(with_scene.sigma0, without.sigma0, equal_nan=True)
    assert with_scene.metadata == without.metadata


def test_a_baked_map_comes_near_the_traced_one(scene, atlas, radar):
    traced = sigmascape.render(scene, radar, samples=64, progress=False)
    near = sigmascape.compare(sigmascape.render(scene, radar, atlas=atlas), traced, cells_m=[8.0])
    assert [row.cell_m for row in near] == [8.0]
    assert near[0].correlation_db > 0.8 and abs(near[0].bias_db) < 3.0
    same = sigmascape.compare(traced, traced, cells_m=[2.0, 4.0])
    assert [(row.correlation_db, row.rms_db, row.l1) for row in same] == pytest.approx([(1.0, 0.0, 0.0)] * 2)


def test_a_comparison_is_of_the_first_map_against_the_second(atlas, radar, tmp_path):
    """Of twice the power: 10 lg 2 = 3.010 dB too bright and wrong by once the truth; the other way round -3.010 dB and half of it."""
    truth, doubled = (sigmascape.render(None, radar, atlas=atlas) for _ in range(2))
    doubled.sigma0[...] *= 2.0
    truth.save(tmp_path / "map.tif")
    doubled.save(tmp_path / "doubled.tif")

    def told(*files):
        command = [os.environ["SIGMASCAPE_CLI"], "compare", *files, "--json", "--cells-m", "4"]
        return json.loads(subprocess.run(command, check=True, capture_output=True, cwd=tmp_path).stdout)

    for maps, files, bias_db, l1 in [((doubled, truth), ("doubled.tif", "map.tif"), 3.0103, 1.0),
                                     ((truth, doubled), ("map.tif", "doubled.tif"), -3.0103, 0.5)]:
        [ours], report = sigmascape.compare(*maps, cells_m=[4.0]), told(*files, "--noise-floor", files[1])
        [theirs], [floor] = report["cells"], report["noise_floor"]
        for found in [(ours.cell_m, ours.bias_db, ours.l1), (theirs["cell_m"], theirs["bias_db"], theirs["l1"])]:
            assert found == pytest.approx((4.0, bias_db, l1), abs=1e-3)
        # The truth traced again is held against the truth too.
        assert (floor["bias_db"], floor["l1"]) == pytest.approx((0.0, 0.0), abs=1e-6)
    assert told("map.tif", "map.tif", "--noise-floor", "doubled.tif")["noise_floor"][0]["bias_db"] == pytest.approx(3.0103, abs=1e-3)
    assert "noise_floor" not in told("doubled.tif", "map.tif")


def png_texts(content):
    """By keyword, from tEXt and zTXt chunks."""
    texts, place = {}, 8
    while place < len(content):
        length, kind = struct.unpack(">I4s", content[place : place + 8])
        keyword, _, text = content[place + 8 : place + 8 + length].partition(b"\0")
        if kind == b"zTXt":
            texts[keyword.decode("latin-1")] = zlib.decompress(text[1:]).decode("latin-1")
        if kind == b"tEXt":
            texts[keyword.decode("latin-1")] = text.decode("latin-1")
        place += 12 + length
    return texts


def test_a_saved_map_reads_back_the_same(atlas, radar, tmp_path):
    ground_map = sigmascape.render(None, radar, atlas=atlas)
    ground_map.save(tmp_path / "map.tif")
    again = sigmascape.GroundMap.read(tmp_path / "map.tif")
    assert np.array_equal(again.sigma0, ground_map.sigma0, equal_nan=True)
    assert (again.metadata, again.crs, again.extent_m) == (ground_map.metadata, ground_map.crs, ground_map.extent_m)
    ground_map.save(tmp_path / "map.png", polarization="sum")
    picture = (tmp_path / "map.png").read_bytes()
    assert picture.startswith(b"\x89PNG") and (tmp_path / "map.pgw").exists()
    texts = png_texts(picture)
    assert texts["quantity"] == "sigma0 VV+HH+2HV [dB]" and "scale_top_db" in texts and "crs" in texts
    with pytest.raises(sigmascape.Error, match=r"map.jpg: is no kind of file .* \.png"):
        ground_map.save(tmp_path / "map.jpg")


def test_maps_show_the_polarization_of_their_radar(atlas, radar, tmp_path):
    horizontal = copy.copy(radar)
    horizontal.polarization = "hh"
    ground_map = sigmascape.render(None, horizontal, atlas=atlas)
    assert ground_map.metadata["polarization"] == "hh"
    assert not np.array_equal(ground_map.db("hh"), ground_map.db("vv"), equal_nan=True)
    assert np.array_equal(ground_map.db(), ground_map.db("hh"), equal_nan=True)
    ground_map.save(tmp_path / "map.png")
    assert png_texts((tmp_path / "map.png").read_bytes())["quantity"] == "sigma0 HH [dB]"
    power = sigmascape.received_power(None, horizontal, atlas=atlas)
    assert np.array_equal(power.dbw(), power.dbw("hh"), equal_nan=True)


def test_wrong_arguments_are_refused(scene, atlas, radar):
    with pytest.raises(sigmascape.Error, match="atlas"):
        sigmascape.render(scene, radar, lod=1)
    with pytest.raises(sigmascape.Error, match="scene: is None, and level of detail 0 traces it"):
        sigmascape.render(None, radar, atlas=atlas, lod=0)
    with pytest.raises(sigmascape.Error, match="another scene"):
        sigmascape.render(sigmascape.Scene.simple(side_m=100.0), radar, atlas=atlas)
    radar.area_m = (1e6, 1e6, 1.1e6, 1.1e6)
    with pytest.raises(sigmascape.Error, match="map area"):
        sigmascape.render(scene, radar, atlas=atlas)


def test_an_area_beyond_the_scene_is_cut_off_with_a_warning(scene, atlas, radar):
    radar.area_m = (-20.0, -20.0, 20.0, 100.0)
    radar.velocity_mps = (120.0, 0.0, 0.0)
    for call in [lambda: sigmascape.render(scene, radar, atlas=atlas), lambda: sigmascape.layers(scene, radar, ["shadow"]),
                 lambda: sigmascape.range_doppler(atlas, radar)]:
        with pytest.warns(UserWarning, match="52 m in the north, and is cut off there; 20 x 34 cells"):
            call()


@pytest.mark.parametrize("call", [sigmascape.render, sigmascape.received_power])
def test_real_beam_maps_are_of_a_flat_earth(scene, atlas, tmp_path, call):
    (tmp_path / "radar.toml").write_text("[radar]\nname = 'far'\nfrequency_ghz = 10\nrange_resolution_m = 2\nbeam_width_deg = 1\n"
                                         "earth_refraction = 1.3333\n[position]\nazimuth_deg = 180\nelevation_deg = 15\n"
                                         "slant_range_km = 2.5\n")
    radar = sigmascape.Radar.read(tmp_path / "radar.toml")
    for options in (dict(atlas=atlas), dict(samples=2, progress=False)):
        with pytest.raises(sigmascape.Error, match="radar far: radar.earth_refraction: is given, and real-beam maps are made over a flat Earth; "
                                                   "leave it out, or choose another"):
            call(scene, radar, **options)
    if call is sigmascape.render:
        radar.mode, radar.velocity_mps, radar.pulse_repetition_hz = "spotlight", (100.0, 0.0, 0.0), 4000.0
        assert np.nanmax(call(scene, radar, atlas=atlas).vv) > 0.0


def test_maps_equal_those_of_the_command_line(tmp_path):
    """The same files, once through the program and once through the module: the same numbers and metadata."""
    scene_file, radar_file = tmp_path / "scene.toml", tmp_path / "radar.toml"
    scene_file.write_text("[paper]\nscale = 0.1\n")
    radar_file.write_text("""
[radar]
name = "mapper"
frequency_ghz = 10.0
range_resolution_m = 4.0
beam_width_deg = 0.05
[position]
azimuth_deg = 130.0
elevation_deg = 20.0
slant_range_km = 5.0
[map]
cell_m = 4.0
""")
    files = [os.environ["SIGMASCAPE_CLI"], "render", radar_file, "--scene", scene_file]
    subprocess.run([*files, "--out", tmp_path / "traced.tif", "--samples", "2"], check=True)
    subprocess.run([files[0], "bake", scene_file, "--out", tmp_path / "atlas", "--azimuths", "2", "--elevations-deg", "20", "--samples",
                    "2", "--texel-m", "4", "--patch-texels", "256"], check=True)
    subprocess.run([*files, "--atlas", tmp_path / "atlas", "--lod", "1", "--out", tmp_path / "baked.tif"], check=True)

    scene, radar = sigmascape.Scene.read(scene_file), sigmascape.Radar.read(radar_file)
    ours = {"traced": sigmascape.render(scene, radar, samples=2, progress=False),
            "baked": sigmascape.render(scene, radar, atlas=sigmascape.Atlas(tmp_path / "atlas"))}
    for name, ground_map in ours.items():
        written = sigmascape.GroundMap.read(tmp_path / f"{name}.tif")
        assert np.array_equal(written.sigma0, ground_map.sigma0, equal_nan=True), name
        assert (written.metadata, written.crs, written.extent_m) == (ground_map.metadata, ground_map.crs, ground_map.extent_m)
