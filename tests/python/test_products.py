"""What the command line writes, read by others: GDAL with its validator of cloud-optimised files, NumPy."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import sigmascape

RADAR = """
[radar]
name = "mapper"
frequency_ghz = 10.0
range_resolution_m = 2.0
beam_width_deg = 0.02
[position]
azimuth_deg = 130.0
elevation_deg = 20.0
slant_range_km = 5.0
[platform]
speed_mps = 120.0
heading_deg = 40.0
[map]
cell_m = 0.5
"""


def sigmascape_cli(*words):
    subprocess.run([os.environ["SIGMASCAPE_CLI"], *map(str, words)], check=True, capture_output=True, text=True)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """One map of 400 x 400 cells in every form that render writes."""
    folder = tmp_path_factory.mktemp("products")
    (folder / "scene.toml").write_text("[paper]\nscale = 0.1\n")
    (folder / "radar.toml").write_text(RADAR)
    for name, options in [("map.tif", []), ("map_db.tif", ["--db"]), ("map.npz", []), ("map.npy", []), ("utm.tif", ["--crs", "EPSG:32631"]),
                          ("map_db.npz", ["--db"])]:
        sigmascape_cli("render", folder / "radar.toml", "--scene", folder / "scene.toml", "--samples", 1, "--bounces", 2, "--out",
                       folder / name, *options)
    for name, options in [("power.tif", []), ("power_db.tif", ["--db"]), ("power_utm.tif", ["--crs", "EPSG:32631"]), ("power.npz", ["--db"])]:
        sigmascape_cli("render", folder / "radar.toml", "--scene", folder / "scene.toml", "--samples", 1, "--bounces", 2, "--power",
                       folder / name, *options)
    sigmascape_cli("render", folder / "radar.toml", "--scene", folder / "scene.toml", "--samples", 1, "--bounces", 2, "--png",
                   folder / "map.png", "--layers", "shadow,class,bounce1,bounce2,multibounce", "--layers-out", folder / "layers.tif")
    return folder


def test_metadata_that_a_geotiff_would_cut_off_are_refused(made, tmp_path):
    read = sigmascape.GroundMap.read(made / "map.tif")
    for metadata, name in (({"a": "x\0y"}, "a"), ({"b\0c": "x"}, "b")):
        read.metadata = metadata
        with pytest.raises(sigmascape.Error, match=f"has a zero byte in the metadata '{name}', where a GeoTIFF's text ends; leave it out"):
            read.save(tmp_path / "cut.tif")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["map.tif", "map_db.tif", "utm.tif", "layers.tif", "power.tif", "power_db.tif", "power_utm.tif"])
def test_gdal_finds_no_fault_with_cloud_optimised_files(gdal, made, name):
    validator = pytest.importorskip("osgeo_utils.samples.validate_cloud_optimized_geotiff")
    warnings, errors, _ = validator.validate(str(made / name), full_check=True)
    assert errors == [] and warnings == []
    assert gdal.Open(str(made / name)).GetRasterBand(1).GetOverviewCount() >= 1


def test_decibels_are_those_of_the_linear_map(gdal, made):
    linear, db = gdal.Open(str(made / "map.tif")), gdal.Open(str(made / "map_db.tif"))
    assert [linear.GetRasterBand(b + 1).GetDescription() for b in range(4)] == ["VV", "HH", "HV", "RE_VVHH"]
    assert [db.GetRasterBand(b + 1).GetDescription() for b in range(3)] == ["VV", "HH", "HV"] and db.RasterCount == 3
    for band in [1, 2, 3]:
        power = linear.GetRasterBand(band).ReadAsArray()
        expected = 10.0 * np.log10(np.maximum(power, 1e-10))
        assert np.allclose(db.GetRasterBand(band).ReadAsArray(), expected, atol=1e-4, equal_nan=True)
        # Overviews show the mean power, not the mean of decibels.
        fine, coarse = linear.GetRasterBand(band), db.GetRasterBand(band).GetOverview(0).ReadAsArray()
        assert np.allclose(10.0 ** (coarse / 10.0), fine.GetOverview(0).ReadAsArray(), rtol=1e-3, atol=1e-9, equal_nan=True)
    read = sigmascape.GroundMap.read(made / "map_db.tif")
    assert np.allclose(read.vv, np.maximum(linear.GetRasterBand(1).ReadAsArray(), 1e-10), rtol=1e-5, equal_nan=True)


def test_one_band_is_enough_for_its_polarization(gdal, made, tmp_path):
    gdal.Translate(str(tmp_path / "hh.tif"), str(made / "map.tif"), bandList=[2])
    read, whole = sigmascape.GroundMap.read(tmp_path / "hh.tif", polarization="hh"), sigmascape.GroundMap.read(made / "map.tif")
    assert np.array_equal(read.hh, whole.hh, equal_nan=True) and np.isnan(read.vv).all()
    with pytest.raises(sigmascape.Error, match="VV"):
        sigmascape.GroundMap.read(tmp_path / "hh.tif")
    with pytest.raises(sigmascape.Error, match="circular"):
        sigmascape.GroundMap.read(tmp_path / "hh.tif", polarization="circular")


def test_numpy_files_have_the_numbers_of_the_geotiff(made):
    tif = sigmascape.GroundMap.read(made / "map.tif")
    archive = np.load(made / "map.npz")
    assert np.array_equal(archive["sigma0"], tif.sigma0, equal_nan=True)
    assert np.array_equal(np.load(made / "map.npy"), tif.sigma0, equal_nan=True)
    assert archive["x_m"][0] == tif.west_m + 0.25 and archive["y_m"][-1] == tif.extent_m[1] + 0.25
    assert np.allclose(np.load(made / "map_db.npz")["sigma0_db"][..., 1], tif.db("hh", floor_db=-100.0), atol=1e-4, equal_nan=True)
    described = json.loads((made / "map.json").read_text())
    assert described == json.loads(archive["description_json"].tobytes())
    assert described["channels"] == ["VV", "HH", "HV", "RE_VVHH"] and described["crs"] == tif.crs
    again = sigmascape.GroundMap.read(made / "map.tif")
    again.save(made / "again.tif")
    assert (made / "again.tif").read_bytes() == (made / "map.tif").read_bytes()


@pytest.mark.parametrize("name", ["map.tif", "map_db.tif", "utm.tif", "layers.tif", "map.npz", "map.png", "power.tif", "power_utm.tif",
                                  "power.npz"])
def test_metadata_tell_where_a_product_comes_from(gdal, made, name):
    osr = pytest.importorskip("osgeo.osr")
    if name.endswith(".npz"):
        told = json.loads(np.load(made / name)["description_json"].tobytes())
    else:
        dataset = gdal.Open(str(made / name))
        told = dataset.GetMetadata()
        if name != "map.png":
            assert osr.SpatialReference(wkt=dataset.GetProjection()).IsProjected()
    scene = sigmascape.Scene.read(made / "scene.toml")
    assert told["radar"] == "mapper" and told["scene_hash"] == scene.hash and told["software"] == f"Sigmascape {sigmascape.__version__}"
    assert told["seed"] == "1" and "path-traced" in told["processing"] and told["time_s"] == "0"
    radar = sigmascape.Radar.read(made / "radar.toml")
    assert [float(word) for word in told["radar_position_m"].split()] == pytest.approx(radar.position_over(scene), abs=0.01)
    assert [float(word) for word in told["radar_velocity_mps"].split()] == pytest.approx([77.13, 91.93, 0.0], abs=0.01)


def test_power_is_in_watts_and_in_decibels_over_one(gdal, made):
    watts, dbw = gdal.Open(str(made / "power.tif")), gdal.Open(str(made / "power_db.tif"))
    assert watts.RasterCount == dbw.RasterCount == 3
    for number, name in enumerate(["VV", "HH", "HV"], 1):
        linear, decibels = watts.GetRasterBand(number), dbw.GetRasterBand(number)
        assert (linear.GetDescription(), linear.GetUnitType()) == (name, "W")
        assert (decibels.GetDescription(), decibels.GetUnitType()) == (name, "dBW")
        expected = 10.0 * np.log10(np.maximum(linear.ReadAsArray(), 1e-30))
        assert np.allclose(decibels.ReadAsArray(), expected, atol=1e-4, equal_nan=True)
        coarse = decibels.GetOverview(0).ReadAsArray()
        assert np.allclose(10.0 ** (coarse / 10.0), linear.GetOverview(0).ReadAsArray(), rtol=1e-3, atol=1e-29, equal_nan=True)
    assert np.array_equal(np.load(made / "power.npz")["power_dbw"][..., 0], dbw.GetRasterBand(1).ReadAsArray(), equal_nan=True)
    assert json.loads(np.load(made / "power.npz")["description_json"].tobytes())["unit"] == "dBW"
    read = sigmascape.PowerMap.read(made / "power.tif")
    assert read.noise_w == float(watts.GetMetadata()["noise_w"]) > 0.0
    assert read.vv.dtype == np.float32 and np.array_equal(read.vv, watts.GetRasterBand(1).ReadAsArray(), equal_nan=True)
    with pytest.raises(sigmascape.Error, match="power.tif"):
        sigmascape.GroundMap.read(made / "power.tif")


def test_power_is_reflectivity_through_the_radar_equation(made):
    """A bin has the area r dr dphi, and the radar equation r^-4: power over sigma0 goes as r^-3, on the same cells."""
    power, sigma0 = sigmascape.PowerMap.read(made / "power.tif"), sigmascape.GroundMap.read(made / "map.tif")
    assert (power.shape, power.extent_m, power.crs) == (sigma0.shape, sigma0.extent_m, sigma0.crs)
    x, y, z = [float(word) for word in power.metadata["radar_position_m"].split()]
    columns, rows = np.meshgrid(np.arange(power.shape[1]) + 0.5, np.arange(power.shape[0]) + 0.5)
    across = np.hypot(power.west_m + columns * power.cell_m - x, power.north_m - rows * power.cell_m - y)
    seen = sigma0.vv > 1e-6
    constant = power.vv[seen] / sigma0.vv[seen] * np.hypot(across, z)[seen] ** 3
    assert seen.sum() > 10000 and np.std(np.log(constant)) < 0.01


def test_python_receives_what_the_command_line_does(made, tmp_path):
    scene, radar = sigmascape.Scene.read(made / "scene.toml"), sigmascape.Radar.read(made / "radar.toml")
    power = sigmascape.received_power(scene, radar, samples=1, bounces=2, progress=False)
    cli = sigmascape.PowerMap.read(made / "power.tif")
    assert np.array_equal(power.vv, cli.vv, equal_nan=True) and np.array_equal(power.hv, cli.hv, equal_nan=True)
    assert power.noise_w == cli.noise_w and power.metadata == cli.metadata
    power.save(tmp_path / "power.tif")
    assert (tmp_path / "power.tif").read_bytes() == (made / "power.tif").read_bytes()
    assert np.allclose(power.dbw("hh"), 10.0 * np.log10(np.maximum(power.hh, 1e-30)), atol=1e-4, equal_nan=True)
    with pytest.raises(sigmascape.Error, match="sum"):
        power.dbw("sum")
    radar.mode = "spotlight"
    with pytest.raises(sigmascape.Error, match="real-beam"):
        sigmascape.received_power(scene, radar)


def test_orders_of_bounces_are_layers_of_the_command_line_too(gdal, made):
    layers, whole = gdal.Open(str(made / "layers.tif")), sigmascape.GroundMap.read(made / "map.tif").vv
    names = [layers.GetRasterBand(b + 1).GetDescription() for b in range(layers.RasterCount)]
    assert names == ["shadow", "class", "bounce1", "bounce2", "multibounce"]
    bands = {name: layers.GetRasterBand(b + 1).ReadAsArray() for b, name in enumerate(names)}
    # With --bounces 2 there is nothing else.
    assert np.allclose(bands["bounce1"] + bands["bounce2"], whole, rtol=1e-3, atol=1e-7, equal_nan=True)
    assert set(np.unique(bands["shadow"])) == {0.0, 1.0}
    assert layers.GetMetadataItem("bounce_polarization") == "VV" and layers.GetMetadataItem("classes")


def test_orders_of_bounces_are_of_the_polarization_that_is_asked_for(gdal, made):
    sigmascape_cli("render", made / "radar.toml", "--scene", made / "scene.toml", "--samples", 1, "--bounces", 2, "--polarization", "hv",
                   "--layers", "bounce1,bounce2", "--layers-out", made / "layers_hv.tif")
    layers, whole = gdal.Open(str(made / "layers_hv.tif")), sigmascape.GroundMap.read(made / "map.tif")
    both = layers.ReadAsArray().sum(axis=0)
    assert np.allclose(both, whole.hv, rtol=1e-3, atol=1e-7, equal_nan=True)
    assert not np.allclose(both, whole.vv, rtol=1e-3, atol=1e-7, equal_nan=True)
    assert layers.GetMetadataItem("bounce_polarization") == "HV"


def test_targets_of_the_command_line_throw_their_shadows_in_layers_too(gdal, made):
    (made / "targets.toml").write_text('[[targets]]\nname = "hall"\nposition_m = [100, 100]\nrcs_dbsm = 0\nsize_m = [20, 20, 40]\n')

    def shadow_of(name, *options):
        sigmascape_cli("render", made / "radar.toml", "--scene", made / "scene.toml", "--samples", 1, "--layers", "shadow,layover",
                       "--layers-out", made / name, *options)
        return gdal.Open(str(made / name)).ReadAsArray()

    shadow, layover = shadow_of("without_target.tif")
    darker, less = shadow_of("with_target.tif", "--targets", made / "targets.toml")
    assert np.all(darker >= shadow) and np.sum(darker > shadow) > 100
    assert np.all(less <= layover)


def test_a_picture_lies_where_its_world_file_says(gdal, made):
    lines = [float(line) for line in (made / "map.pgw").read_text().split()]
    tif = sigmascape.GroundMap.read(made / "map.tif")
    assert lines == [0.5, 0.0, 0.0, -0.5, tif.west_m + 0.25, tif.north_m - 0.25]
    picture = gdal.Open(str(made / "map.png"))
    assert picture.RasterXSize == 400 and picture.RasterYSize > 410  # the colour bar is below the ground
