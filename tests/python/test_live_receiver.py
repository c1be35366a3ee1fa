"""What a radar hears of live frames, in watts."""

import gc

import numpy as np
import pytest

import sigmascape

PLACE = (0.0, -2900.0, 800.0)
POSE = dict(first_azimuth_rad=-0.03, first_range_m=2960.0)
BINS = dict(content="powers", beams=30, ranges=40, beam_step_rad=2e-3, range_step_m=3.0)


def radar(**sections):
    """Tells every other bin from the next."""
    keys = dict(frequency_ghz=10.0, range_resolution_m=6.0, beam_width_deg=float(np.degrees(4e-3)))
    waveform = dict(window="rectangular", **sections.pop("waveform", {}))
    return sigmascape.Radar.from_keys(dict(radar=keys, map=dict(cell_m=3.0), waveform=waveform, **sections))


NARROW = dict(antenna=dict(elevation_shape="gaussian", elevation_width_deg=20.0, tilt_deg=-15.0))


@pytest.fixture
def ground(atlas):
    return sigmascape.LiveGround(atlas.folder, cache_mib=64)


@pytest.fixture
def renderer(ground):
    renderer = sigmascape.LiveRenderer(ground, **BINS)
    renderer.render(PLACE, **POSE)
    ground.wait()
    return renderer


def test_a_target_has_the_watts_of_the_radar_equation(renderer):
    transmitter = dict(antenna=dict(gain_dbi=30.0), waveform=dict(peak_power_w=2000.0, pulse_length_us=1.0))
    receiver = sigmascape.LiveReceiver(radar(**transmitter), polarization="hh")
    before_w = receiver.hear(renderer.render(PLACE, **POSE)).copy()
    assert before_w.shape == (30, 40) and before_w.dtype == np.float32
    # In the middle of a bin.
    azimuth_rad, slant_range_m, altitude_m = POSE["first_azimuth_rad"] + 10.5 * 2e-3, POSE["first_range_m"] + 20.5 * 3.0, 300.0
    distance_m = np.sqrt(slant_range_m**2 - (PLACE[2] - altitude_m)**2)
    place = (PLACE[0] + distance_m * np.sin(azimuth_rad), PLACE[1] + distance_m * np.cos(azimuth_rad))
    renderer.set_targets([sigmascape.Target(place, rcs_dbsm=60.0, altitude_m=altitude_m)])
    heard_w = receiver.hear(renderer.render(PLACE, **POSE))
    assert np.unravel_index(np.argmax(heard_w), heard_w.shape) == (10, 20)
    lambda_m = 299792458.0 / 10e9
    expected_w = 2000.0 * 1000.0**2 * lambda_m**2 * 1e6 / ((4 * np.pi)**3 * slant_range_m**4)
    # B tau, B the band whose pulse is 6 m wide at half power.
    compression = 0.8859 * 299792458.0 / (2 * 6.0) * 1e-6
    assert heard_w[10, 20] - before_w[10, 20] == pytest.approx(expected_w * compression, rel=0.01)


def test_noise_is_that_of_the_receiver():
    noise_w = [sigmascape.LiveReceiver(radar(receiver=dict(noise_figure_db=db))).noise_w for db in (3.0, 13.0)]
    assert noise_w[1] == pytest.approx(10 * noise_w[0])
    # k T0 B F of the same band.
    assert noise_w[0] == pytest.approx(1.380649e-23 * 290.0 * 0.8859 * 299792458.0 / (2 * 6.0) * 10**0.3, rel=1e-3)


def test_steps_of_a_scan_come_to_the_whole_frame(renderer, ground):
    receiver = sigmascape.LiveReceiver(radar(**NARROW), ground)
    receiver.hear(renderer.render((150.0, -2900.0, 800.0), **POSE))
    for first_beam in range(0, 30, 6):
        heard = receiver.hear(renderer.scan(PLACE, first_beam=first_beam, count=6, **POSE))
    frame = renderer.scan(PLACE, first_beam=0, count=30, **POSE)
    at_once = sigmascape.LiveReceiver(radar(**NARROW), ground)
    np.testing.assert_array_equal(heard, at_once.hear(frame))


def test_traced_frames_are_heard_over_their_scene(scene):
    tracer = sigmascape.LiveTracer(scene, rays_per_cell=1, **BINS)
    heard = sigmascape.LiveReceiver(radar(**NARROW), scene).hear(tracer.render(PLACE, **POSE))
    assert np.isfinite(heard).all() and heard.max() > 0


def test_the_array_outlives_its_receiver(renderer):
    receiver = sigmascape.LiveReceiver(radar())
    heard = receiver.hear(renderer.render(PLACE, **POSE))
    kept = heard.copy()
    del receiver, renderer
    gc.collect()
    np.testing.assert_array_equal(heard, kept)
    with pytest.raises(ValueError, match="read-only"):
        heard[0, 0] = 1.0


def test_the_array_outlives_frames_of_more_bins(renderer, ground):
    receiver = sigmascape.LiveReceiver(radar())
    heard = receiver.hear(renderer.render(PLACE, **POSE))
    assert np.shares_memory(heard, receiver.hear(renderer.render(PLACE, **POSE)))
    kept = heard.copy()
    larger = sigmascape.LiveRenderer(ground, **(BINS | dict(ranges=400)))
    others = receiver.hear(larger.render(PLACE, **POSE))
    assert others.shape == (30, 400) and not np.shares_memory(heard, others)
    np.testing.assert_array_equal(heard, kept)


def test_a_pose_that_is_refused_leaves_the_last_frame_to_be_heard(renderer):
    receiver = sigmascape.LiveReceiver(radar())
    frame = renderer.render(PLACE, **POSE)
    heard = receiver.hear(frame).copy()
    for place in [(0.0, 0.0, -500.0), (0.0, float("nan"), 800.0)]:
        with pytest.raises(sigmascape.Error):
            renderer.scan(place, first_beam=0, count=6, **POSE)
    np.testing.assert_array_equal(receiver.hear(frame), heard)


def test_what_cannot_be_heard_is_refused(renderer, ground):
    with pytest.raises(sigmascape.Error, match="elevations apart"):
        sigmascape.LiveReceiver(radar(**NARROW))
    with pytest.raises(sigmascape.Error, match="sum of polarizations"):
        sigmascape.LiveReceiver(radar(), polarization="sum")
    frame = renderer.render(PLACE, **POSE)
    other = radar()
    other.frequency_hz = 3e9
    with pytest.raises(sigmascape.Error, match="3 GHz"):
        sigmascape.LiveReceiver(other).hear(frame)
    renderer.render(PLACE, **POSE)
    with pytest.raises(sigmascape.Error, match="before the next is drawn"):
        sigmascape.LiveReceiver(radar()).hear(frame)
