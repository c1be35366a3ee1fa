"""A GeoTIFF of Bilbao lies on its river: by the coordinates of shoreline points of the land cover, which the test reads for itself."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

SOURCES = pathlib.Path(os.environ["SIGMASCAPE_SOURCE_DIR"])
DATA = pathlib.Path(os.environ.get("SIGMASCAPE_DATA") or SOURCES / "../shared/data")
COVER = DATA / "bilbao" / "landcover_2p5m_utm30n_wc.tif"
WATER, GRASS = 80, 30
REACH_M = 20.0

# From high up, so that banks neither shade nor lie over a cell; direct echoes alone.
RADAR = """
[radar]
name = "high over Bilbao"
frequency_ghz = 10.0
range_resolution_m = 5.0
beam_width_deg = 0.02
[position]
azimuth_deg = 130.0
elevation_deg = 45.0
slant_range_km = 20.0
[map]
cell_m = 5.0
"""


@pytest.fixture
def osr(gdal):
    from osgeo import osr
    return osr


def system(osr, text):
    reference = osr.SpatialReference()
    reference.SetFromUserInput(text)
    reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    return reference


def shoreline(gdal):
    """Points between water and open grass, with the step from water to land: (east, north, step east, step north)."""
    raster = gdal.Open(str(COVER))
    west, cell, _, north, _, _ = raster.GetGeoTransform()
    cover = raster.ReadAsArray()
    reach = int(REACH_M / cell)
    points = []
    for axis, sign in [(1, 1), (1, -1), (0, 1), (0, -1)]:
        lines = cover if axis == 1 else cover.T
        lines = lines[:, ::sign]
        wet = np.lib.stride_tricks.sliding_window_view(lines == WATER, reach, axis=1).all(axis=2)
        green = np.lib.stride_tricks.sliding_window_view(lines == GRASS, reach, axis=1).all(axis=2)
        for line, first in zip(*np.nonzero(wet[:, :-reach] & green[:, reach:])):
            edge = first + reach  # between this cell and the one before
            edge = edge if sign == 1 else lines.shape[1] - edge
            east, south = (edge * cell, (line + 0.5) * cell) if axis == 1 else ((line + 0.5) * cell, edge * cell)
            points.append((west + east, north - south, sign if axis == 1 else 0, -sign if axis == 0 else 0))
    return np.array(points)


def offset_of_shore_m(gdal, osr, tif, points):
    """Where from water to land the map passes half the land's power, metres inland of the land cover's border."""
    raster = gdal.Open(str(tif))
    to_map = osr.CoordinateTransformation(system(osr, "EPSG:25830"), system(osr, raster.GetProjection()))
    west, cell, _, north, _, _ = raster.GetGeoTransform()
    power = raster.GetRasterBand(1).ReadAsArray()
    steps = np.arange(-REACH_M + 2.5, REACH_M, 1.25)
    profiles = []
    for east, northing, d_east, d_north in points:
        line = np.array(to_map.TransformPoints([(east + d_east * s, northing + d_north * s) for s in steps]))
        columns, rows = ((line[:, 0] - west) / cell).astype(int), ((north - line[:, 1]) / cell).astype(int)
        if min(columns.min(), rows.min()) < 0 or columns.max() >= power.shape[1] or rows.max() >= power.shape[0]:
            continue
        if np.isfinite(power[rows, columns]).all():
            profiles.append(power[rows, columns] / power[rows[-4:], columns[-4:]].mean())
    assert len(profiles) > 50
    profile = np.median(profiles, axis=0)
    assert profile[:4].max() < 0.2  # the river is dark
    first = int(np.argmax(profile > 0.5))
    return np.interp(0.5, profile[first - 1:first + 1], steps[first - 1:first + 1])


@pytest.mark.skipif(not COVER.exists(), reason=f"the folder bilbao is not in {DATA}; set SIGMASCAPE_DATA")
def test_the_river_is_where_the_land_cover_has_it(gdal, osr, tmp_path):
    (tmp_path / "radar.toml").write_text(RADAR)
    command = [os.environ["SIGMASCAPE_CLI"], "render", tmp_path / "radar.toml", "--scene", SOURCES / "examples/bilbao/bilbao.toml",
               "--samples", "4", "--bounces", "1"]
    environment = os.environ | {"SIGMASCAPE_DATA": str(DATA.resolve())}
    points = shoreline(gdal)
    for name, options in [("local.tif", []), ("utm.tif", ["--crs", "EPSG:25830"])]:
        subprocess.run([*command, *options, "--out", tmp_path / name], check=True, env=environment)
        towards = [(1, 0), (-1, 0), (0, 1), (0, -1)]
        offsets = [offset_of_shore_m(gdal, osr, tmp_path / name, points[(points[:, 2] == e) & (points[:, 3] == n)]) for e, n in towards]
        print(name, "offsets by direction of the land:", dict(zip(towards, np.round(offsets, 2))))
        # Half a cell for the picking of the nearest cell, half for the land cover's own cells; banks some metres tall.
        assert np.abs(offsets).max() < 5.0
        # A shift of the map shows with opposite signs on opposite shores.
        assert abs(offsets[0] - offsets[1]) / 2 < 2.5 and abs(offsets[2] - offsets[3]) / 2 < 2.5
