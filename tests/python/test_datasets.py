"""Datasets from Python: what is said before they are made."""

import warnings

import pytest

import sigmascape


@pytest.fixture
def spec(tmp_path):
    """Writes a specification of two traced samples that a radar sees through a beam of 2 m; its name by the side of cells in m."""
    (tmp_path / "scene.toml").write_text("[paper]\nscale = 0.1\n")
    (tmp_path / "radar.toml").write_text('[radar]\nname = "mapper"\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.011\n')

    def written(cell_m):
        (tmp_path / "spec.toml").write_text(
            f'[dataset]\nscene = "scene.toml"\nradar = "radar.toml"\ncount = 2\ncells = 8\ncell_m = {cell_m}\nsamples_per_cell = 1\n'
            "preview = false\n[view]\nazimuth_deg = [0, 360]\nelevation_deg = [20, 30]\nslant_range_km = [15, 20]\n")
        return tmp_path / "spec.toml"

    return written


def test_cells_too_coarse_for_the_finest_beam_are_told_of_once(spec, tmp_path):
    with pytest.warns(UserWarning, match="radar mapper: in maps 15 km away the beam of 1.9. m is narrower than the map's cells of 4 m") as told:
        assert sigmascape.make_dataset(spec(4.0), tmp_path / "coarse", progress=False).is_complete
    assert len(told) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert sigmascape.make_dataset(spec(1.9), tmp_path / "fine", progress=False).is_complete


def test_a_warning_that_is_made_an_error_comes_before_the_work(spec, tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="in maps 15 km away"):
            sigmascape.make_dataset(spec(4.0), tmp_path / "samples", progress=False)
    assert not (tmp_path / "samples").exists()
