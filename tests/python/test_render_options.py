"""Options of `sigmascape render` over level grass, where what they do is known beforehand."""

import json
import os
import subprocess

import numpy as np
import pytest

FRAME = "+proj=tmerc +lat_0=43 +lon_0=-3 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m"
# A kilometre to the south and 15 degrees up, looking north and flying east.
RADAR = """
[radar]
name = "test"
frequency_ghz = 10
range_resolution_m = 0.75
beam_width_deg = {beam_deg}
wind_mps = {wind_mps}
[position]
azimuth_deg = 180
elevation_deg = 15
slant_range_km = 1
[platform]
speed_mps = 100
heading_deg = 90
[waveform]
pulse_repetition_hz = 1000
[map]
cell_m = 1
west_m = -60
south_m = -60
east_m = 60
north_m = 60
{mode}
"""
EAST_M, NORTH_M, SPAN_DB, TOP_DB = 20.0, -35.0, 70.0, 30.0


class Place:
    """A folder with a scene, to which radars and targets are written, and the program run on them."""

    def __init__(self, folder):
        self.folder = folder
        (folder / "heights.asc").write_text("ncols 20\nnrows 20\nxllcorner -100\nyllcorner -100\ncellsize 10\n" + "0 " * 400)
        (folder / "scene.toml").write_text("[scene]\norigin_lat_deg = 43\norigin_lon_deg = -3\n"
                                           f"[terrain]\nfile = \"heights.asc\"\ncrs = \"{FRAME}\"\n")

    def cli(self, *words):
        subprocess.run([os.environ["SIGMASCAPE_CLI"], *map(str, words)], check=True, capture_output=True, text=True, cwd=self.folder)

    def render(self, *options, targets="", beam_deg=0.5, wind_mps=0, mode=""):
        (self.folder / "radar.toml").write_text(RADAR.format(beam_deg=beam_deg, wind_mps=wind_mps, mode=mode))
        (self.folder / "targets.toml").write_text(targets)
        self.cli("render", "radar.toml", "--scene", "scene.toml", *(["--targets", "targets.toml"] if targets else []), *options)

    def json(self, name):
        return json.loads((self.folder / name).read_text())

    def load(self, name):
        return np.load(self.folder / name)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    place = Place(tmp_path_factory.mktemp("level"))
    place.cli("bake", "scene.toml", "--out", "atlas", "--azimuths", 2, "--elevations-deg", 15, "--samples", 2, "--texel-m", 2,
              "--patch-texels", 256)
    return place


@pytest.fixture(scope="module")
def drawn(place):
    """A reflector in the grass, drawn in all ways."""
    target = f"[[targets]]\nposition_m = [{EAST_M}, {NORTH_M}]\nheight_m = 0\nrcs_dbsm = 50\n"
    traced = ["--samples", 8, "--bounces", 1]
    look = ["--span-db", SPAN_DB, "--top-db", TOP_DB]
    for up in ["north", "heading"]:
        place.render("--ppi", f"{up}.png", "--up", up, *traced, *look, targets=target)
    place.render("--b-scope", "b.png", "--png", "map.png", "--out", "map.npz", "--snr", "snr.npy", *traced, *look, targets=target)
    place.render("--b-scope", "b_green.png", "--ppi", "north_green.png", "--png", "map_green.png", "--style", "scope", *traced, *look,
                 targets=target)
    return place


def greys(gdal, file):
    """[row, column] of a picture in which red, green and blue are alike, as colours but those of unseen ground are; there NaN."""
    red, green, blue = gdal.Open(str(file)).ReadAsArray()[:3].astype(float)
    return np.where((red == green) & (green == blue), green, np.nan)


def brightest(ground):
    """Row and column, from the upper left corner, of the middle of the brightest pixels."""
    rows, columns = np.nonzero(ground >= 0.97 * np.nanmax(ground))
    return rows.mean() + 0.5, columns.mean() + 0.5


def seen_from(radar_m, east_m, north_m):
    """Slant range and azimuth, clockwise from north."""
    east, north = east_m - radar_m[0], north_m - radar_m[1]
    return np.sqrt(east**2 + north**2 + radar_m[2] ** 2), np.degrees(np.arctan2(east, north))


def sector(axes):
    """Its edges: ranges near and far, first and last azimuth."""
    near, first = axes["first_range_m"], axes["first_azimuth_deg"]
    return near, near + axes["ranges"] * axes["range_step_m"], first, first + axes["azimuths"] * axes["azimuth_step_deg"]


class PlanPosition:
    """Where things are in a plan position indicator: the box about the sector, 512 pixels along its longer side, a legend below it."""

    def __init__(self, axes, up_deg):
        near, far, first, last = sector(axes)
        self.radar_m, self.up_deg = axes["radar_position_m"], up_deg
        edges = np.concatenate([self.seen_at(radius, np.linspace(first, last, 1001)) for radius in (near, far)], axis=1)
        (self.left_m, low_m), (right_m, self.high_m) = edges.min(axis=1), edges.max(axis=1)
        self.pixel_m = max(right_m - self.left_m, self.high_m - low_m) / 512.0
        self.rows, self.columns = (self.high_m - low_m) / self.pixel_m, (right_m - self.left_m) / self.pixel_m

    def seen_at(self, range_m, azimuth_deg):
        turned = np.radians(azimuth_deg - self.up_deg)
        return range_m * np.array([np.sin(turned), np.cos(turned)])

    def pixel_of(self, east_m, north_m):
        """Row and column from the upper left corner."""
        right_m, up_m = self.seen_at(*seen_from(self.radar_m, east_m, north_m))
        return (self.high_m - up_m) / self.pixel_m, (right_m - self.left_m) / self.pixel_m


@pytest.mark.parametrize("up, up_deg", [("north", 0.0), ("heading", 90.0)])
def test_north_or_the_heading_is_at_the_top(gdal, drawn, up, up_deg):
    """The reflector stands to the right of what lies ahead in the north, and above it with the heading, east, at the top."""
    shown = PlanPosition(drawn.json("snr.json"), up_deg)
    picture = greys(gdal, drawn.folder / f"{up}.png")
    assert picture.shape[1] == pytest.approx(shown.columns, abs=1.0) and picture.shape[0] > shown.rows - 1.0
    found = brightest(picture[: int(shown.rows)])
    # A quarter of the beam.
    assert found == pytest.approx(shown.pixel_of(EAST_M, NORTH_M), abs=2.0 / shown.pixel_m)
    ahead = shown.pixel_of(0.0, NORTH_M)
    aside = found[1] - ahead[1] if up == "north" else ahead[0] - found[0]
    assert aside * shown.pixel_m == pytest.approx(EAST_M, abs=3.0)


def test_a_b_scope_has_azimuth_to_the_right_and_range_upwards(gdal, drawn):
    axes = drawn.json("snr.json")
    near, far, first, last = sector(axes)
    picture = greys(gdal, drawn.folder / "b.png")
    # Far more ranges than azimuths: these are drawn out, to half the height at most.
    assert axes["azimuths"] < picture.shape[1] <= axes["ranges"] / 2 and picture.shape[1] % axes["azimuths"] == 0
    row, column = brightest(picture[: axes["ranges"]])
    range_m, azimuth_deg = seen_from(axes["radar_position_m"], EAST_M, NORTH_M)
    assert column / picture.shape[1] == pytest.approx((azimuth_deg - first) / (last - first), abs=0.01)
    assert 1.0 - row / axes["ranges"] == pytest.approx((range_m - near) / (far - near), abs=0.01)


def level_db(grey):
    return TOP_DB + SPAN_DB * (grey / 255.0 - 1.0)


def test_top_and_span_say_which_level_has_which_grey(gdal, drawn):
    levels_db = 10.0 * np.log10(np.maximum(drawn.load("map.npz")["sigma0"][..., 0], 1e-30))
    expected = 255.0 * np.clip((levels_db - TOP_DB + SPAN_DB) / SPAN_DB, 0.0, 1.0)
    picture = greys(gdal, drawn.folder / "map.png")[: levels_db.shape[0]]
    seen = np.isfinite(expected)
    assert seen.mean() > 0.9 and np.ptp(expected[seen]) > 100.0
    assert np.abs(picture[seen] - expected[seen]).max() <= 0.51
    # In scopes even ground has the sigma0 that it has in the map: all about the middle.
    ground_db = np.median(levels_db[50:70, 50:70])
    axes = drawn.json("snr.json")
    scope = greys(gdal, drawn.folder / "b.png")
    middle = axes["ranges"] - int((1000.0 - axes["first_range_m"]) / axes["range_step_m"])
    scopes = [scope[middle - 12 : middle + 12, scope.shape[1] // 2 - 10 : scope.shape[1] // 2 + 10]]
    for up, up_deg in [("north", 0.0), ("heading", 90.0)]:
        row, column = (int(place) for place in PlanPosition(axes, up_deg).pixel_of(0.0, 0.0))
        scopes.append(greys(gdal, drawn.folder / f"{up}.png")[row - 12 : row + 12, column - 12 : column + 12])
    assert [level_db(np.median(part)) for part in scopes] == pytest.approx([ground_db] * 3, abs=0.5)


@pytest.mark.parametrize("name", ["map", "b", "north"])
def test_a_scope_is_green_and_as_light_as_its_level(gdal, drawn, name):
    """The ramp is even in Oklab's lightness and ends at 0.97 [Ottosson 2020: linear sRGB to cone responses, cube roots, lightness]."""
    grey = greys(gdal, drawn.folder / f"{name}.png")[:100]
    picture = gdal.Open(str(drawn.folder / f"{name}_green.png"))
    assert picture.GetMetadataItem("low_pass_cells") == "1"
    # Grass fills most of it; what is not seen is no grey.
    red, green, blue = (np.median(colour[: len(grey)][np.isfinite(grey)]) / 255.0 for colour in picture.ReadAsArray()[:3])
    assert green > 2.0 * max(red, blue)
    light = [code / 12.92 if code <= 0.04045 else ((code + 0.055) / 1.055) ** 2.4 for code in (red, green, blue)]
    cones = np.array([[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566],
                      [0.0883024619, 0.2817188376, 0.6299787005]]) @ light
    lightness = np.array([0.2104542553, 0.7936177850, -0.0040720468]) @ np.cbrt(cones)
    assert lightness == pytest.approx(0.97 * np.nanmedian(grey) / 255.0, abs=0.01)


@pytest.mark.parametrize("options", [["--lod", 0, "--samples", 4, "--bounces", 1], ["--lod", 1, "--atlas", "atlas"]])
def test_a_later_moment_has_moved_radar_and_targets(place, options):
    """In 5 s a lorry of 8 m/s goes 40 m to the north, and the radar, as the sidecar has it, 500 m to the east."""
    lorry = "[[targets]]\nposition_m = [-20, -30]\nheight_m = 0\nheading_deg = 0\nspeed_mps = 8\nrcs_dbsm = 70\n"
    for time_s, north_m in [(0, -30.0), (5, 10.0)]:
        place.render("--out", "map.npy", "--power", "power.npy", "--time-s", time_s, *options, targets=lorry, beam_deg=0.05)
        for name in ["map", "power"]:
            told = place.json(f"{name}.json")
            assert told["time_s"] == str(time_s)
            at_m = [float(word) for word in told["radar_position_m"].split()]
            assert at_m == pytest.approx([100.0 * time_s, -1000.0 * np.cos(np.radians(15.0)), 1000.0 * np.sin(np.radians(15.0))], abs=0.01)
            cells = place.load(f"{name}.npy")[..., 0]
            row, column = np.unravel_index(np.nanargmax(cells), cells.shape)
            found = told["west_m"] + (column + 0.5) * told["cell_m"], told["north_m"] - (row + 0.5) * told["cell_m"]
            assert found == pytest.approx((-20.0, north_m), abs=1.01)


# At 10 GHz in a wind of 8 m/s, 17.9 miles an hour: r = 489.8 * 17.9^-1.55 * 10^-1.21 = 0.345, of which r/(r + 1) stand still, and the
# rest has velocities of 1/beta = 0.1048 (lg 17.9 + 0.4147) m/s in the mean [docs/physics/speckle.md, Eq. 9].
STILL, MEAN_MPS = 0.257, 0.1747


def test_wind_smears_grass_in_maps(place):
    """Three scatterers in four are shifted, by 1000 m 0.1747 m/s / 100 m/s = 1.7 m in the mean where 1 m is told apart: another speckle of
    the same power."""
    calm, windy = [], []
    for seed in range(1, 5):
        for wind_mps, looks in [(0, calm), (8, windy)]:
            place.render("--atlas", "atlas", "--out", "map.npy", "--seed", seed, wind_mps=wind_mps,
                         mode="[mode]\nkind = \"spotlight\"\nalong_resolution_m = 1\n")
            assert place.json("map.json")["wind_mps"] == str(wind_mps)
            looks.append(place.load("map.npy")[..., 0].astype(float))
    calm, windy = np.array(calm).ravel(), np.array(windy).ravel()
    assert np.corrcoef(calm, windy)[0, 1] < 0.5
    assert 10.0 * np.log10(windy.mean() / calm.mean()) == pytest.approx(0.0, abs=0.3)


def test_wind_moves_grass_in_pulses(place):
    """Pulses with wind and without are alike at the moment of time zero. Before and after it they have in common what stands still and,
    of the exponential slopes, 1/(1 + (4 pi t/(lambda beta))^2)."""
    pulses = []
    for wind_mps in [0, 8]:
        place.render("--atlas", "atlas", "--iq", "pulses.npy", "--interval-s", 0.1, wind_mps=wind_mps)
        pulses.append(place.load("pulses.npy")[..., 0])
    times_s = np.array(place.json("pulses.json")["pulse_time_s"])
    calm, windy = pulses
    together = (windy * calm.conj()).sum(axis=1).real / np.sqrt((np.abs(calm) ** 2).sum(axis=1) * (np.abs(windy) ** 2).sum(axis=1))
    expected = STILL + (1.0 - STILL) / (1.0 + (4.0 * np.pi * times_s * MEAN_MPS / 0.03) ** 2)
    assert together[np.abs(times_s).argmin()] > 0.99
    for least_s, most_s in [(0.005, 0.015), (0.03, 0.06)]:
        some = (np.abs(times_s) >= least_s) & (np.abs(times_s) < most_s)
        assert together[some].mean() == pytest.approx(expected[some].mean(), abs=0.05)
