"""Curves of materials and radars against closed forms, and the plots that show them."""

import struct
import xml.etree.ElementTree as xml
import zlib

import numpy as np
import pytest

import sigmascape


def test_sigma0_of_a_material_is_that_of_its_law():
    grazing = np.array([[5.0, 20.0], [45.0, 80.0]])
    sigma0 = sigmascape.material_sigma0("urban", grazing)
    assert sigma0.shape == (2, 2, 4) and sigma0.dtype == np.float32
    # Constant gamma: sigma0 over the sine of the grazing angle is the same everywhere.
    gamma = sigma0[..., 0] / np.sin(np.radians(grazing))
    assert np.allclose(gamma, gamma[0, 0], rtol=1e-4)
    with pytest.raises(sigmascape.Error, match="grass"):
        sigmascape.material_sigma0("gras", grazing)
    assert "urban" in sigmascape.material_names()
    for name in ["concrete", "metal", "glass", "urban"]:
        assert np.all(sigmascape.material_sigma0(name, 0.0) == 0.0)
    for wrong in (-10.0, 120.0, float("nan")):
        with pytest.raises(sigmascape.Error, match="grazing_deg"):
            sigmascape.material_sigma0("urban", [30.0, wrong])
    with pytest.raises(sigmascape.Error, match="frequency_ghz"):
        sigmascape.material_sigma0("urban", 30.0, frequency_ghz=0.0)


def test_antenna_and_pulse_are_at_half_power_where_they_should_be():
    radar = sigmascape.Radar(range_resolution_m=3.0, beam_width_deg=2.0)
    gain = sigmascape.antenna_gain_db(radar, [-1.0, 0.0, 1.0])
    assert gain[1] - gain[[0, 2]] == pytest.approx([10 * np.log10(2.0)] * 2, abs=1e-6)
    assert sigmascape.range_response_db(radar, [-1.5, 0.0, 1.5]) == pytest.approx([-10 * np.log10(2.0), 0.0, -10 * np.log10(2.0)], abs=1e-4)


@pytest.mark.parametrize("number", [float("nan"), float("inf"), -float("inf")])
def test_curves_are_not_asked_for_at_what_is_no_number(number):
    radar = sigmascape.Radar(range_resolution_m=3.0, beam_width_deg=2.0)
    with pytest.raises(sigmascape.Error, match="elevation_deg: is -?(nan|inf); give a number from -90 to 90"):
        sigmascape.antenna_gain_db(radar, [0.0], elevation_deg=number)
    with pytest.raises(sigmascape.Error, match="azimuth_deg: is -?(nan|inf); give a number from"):
        sigmascape.antenna_gain_db(radar, [0.0, number])
    with pytest.raises(sigmascape.Error, match="offset_m: is -?(nan|inf); give a number from"):
        sigmascape.range_response_db(radar, [0.0, number])


@pytest.mark.parametrize("places", ["30", ["10", "20"], [b"10"], None, [None], 30.0 + 0j, np.array(["2020-01-01"], dtype="datetime64[D]")])
def test_curves_are_not_asked_for_at_what_is_not_of_numbers(places):
    with pytest.raises(TypeError):
        sigmascape.material_sigma0("grass", places)
    with pytest.raises(TypeError):
        sigmascape.antenna_gain_db(sigmascape.Radar(), places)


def pixels_of(path):
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    packed, at = b"", 8
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    return width, height, len(zlib.decompress(packed))


def test_plots_are_drawn_as_svg_and_png(tmp_path):
    angle = np.linspace(1.0, 89.0, 89)
    series = {"σ0 of 'urban' <VV>": (angle, 10 * np.log10(sigmascape.material_sigma0("urban", angle)[:, 0])),
              "line": ([0.0, 90.0], [-30.0, -10.0])}
    sigmascape.plot(tmp_path / "a.svg", series, title="urban", x_label="grazing angle [°]", y_label="[dB]")
    root = xml.parse(tmp_path / "a.svg").getroot()
    texts = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]
    assert "urban" in texts and "σ0 of 'urban' <VV>" in texts and "grazing angle [°]" in texts
    sigmascape.plot(tmp_path / "a.png", series)
    assert pixels_of(tmp_path / "a.png") == (1280, 800, 800 * (3 * 1280 + 1))
    with pytest.raises(sigmascape.Error, match="svg or .png"):
        sigmascape.plot(tmp_path / "a.pdf", series)
    with pytest.raises(sigmascape.Error, match="x and y"):
        sigmascape.plot(tmp_path / "a.svg", {"a": ([1.0], [1.0, 2.0])})
