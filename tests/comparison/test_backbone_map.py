"""A map of backbones in a file, and back."""

import numpy as np
import pytest

from analytic import backbone_map
from rotbeam_exu import comparison, load, save


@pytest.fixture(scope="module")
def found(beam):
    return backbone_map(beam, (5.0, 5.5), up_to=0.1, speeds=8)


@pytest.mark.parametrize("ending", [".nc", ".csv"])
def test_in_a_file_and_back(found, tmp_path, ending):
    path = save(comparison.backbone_map_data(found), tmp_path / f"map{ending}")
    again = comparison.backbone_map_of(load(path))
    assert again.beam == found.beam
    omega, a = np.array([5.1, 5.4]), np.array([0.02, 0.1])
    np.testing.assert_array_equal(again.frequency(omega, a), found.frequency(omega, a))
    np.testing.assert_array_equal(again.first_harmonic(omega, a), found.first_harmonic(omega, a))


def test_another_dataset_is_refused(found):
    with pytest.raises(ValueError, match="it has no ratio"):
        comparison.backbone_map_of(comparison.backbone_map_data(found).drop_vars("ratio"))


def test_a_map_of_a_blade(beam, tmp_path):
    blade = beam.with_tip_mass(0.2 * beam.mass)
    made = backbone_map(blade, (2.0, 2.5), up_to=0.1, speeds=8)
    path = save(comparison.backbone_map_data(made), tmp_path / "map.nc")
    again = comparison.backbone_map_of(load(path))
    assert again.beam == blade
    assert again.frequency(2.2, 0.1) == made.frequency(2.2, 0.1)
