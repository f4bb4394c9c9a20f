"""The manners of scikit-learn."""

import numpy as np
import pytest
from sklearn.base import clone
from sklearn.exceptions import NotFittedError
from sklearn.utils.validation import check_is_fitted

import trackdyn as td


def test_clone_and_parameters(robot, recording):
    estimator = td.IcrKinematics(robot, alphas=True, seed=7)
    twin = clone(estimator)
    assert twin is not estimator and twin.get_params() == estimator.get_params()
    assert estimator.set_params(seed=8) is estimator and estimator.get_params()["seed"] == 8
    with pytest.raises(ValueError, match="seeed: expected one of vehicle"):
        estimator.set_params(seeed=1)
    fitted = estimator.fit(recording)
    assert fitted is estimator
    check_is_fitted(fitted)
    with pytest.raises(NotFittedError):
        check_is_fitted(clone(fitted))
    with pytest.raises(NotFittedError):
        clone(fitted).predict(0.1, 0.2)
    assert "alphas=True" in repr(fitted) and "x_l" in fitted._repr_html_()


def test_a_gauge_does_in_place_of_a_vehicle(robot, recording):
    by_vehicle = td.IcrKinematics(robot).fit(recording)
    by_gauge = td.IcrKinematics(robot.gauge).fit(recording)
    assert (by_gauge.x_l_, by_gauge.x_r_, by_gauge.y_) == (
        by_vehicle.x_l_,
        by_vehicle.x_r_,
        by_vehicle.y_,
    )


def test_a_vehicle_is_not_taken_in_silence(robot, recording):
    with pytest.warns(td.Warning, match="no vehicle given: taken for auriga-alpha"):
        by_default = td.IcrKinematics().fit(recording)
    assert by_default.x_l_ == td.IcrKinematics(robot).fit(recording).x_l_


def test_it_fits_one_part_and_scores_another(robot, recording):
    fitted = td.IcrKinematics(robot).fit(recording.part(runs="0-1"))
    assert fitted.score(recording.part(runs=2)) > 0.9


def test_the_shape_of_speeds_is_checked(robot, recording):
    fitted = td.IcrKinematics(robot).fit(recording)
    with pytest.raises(ValueError, match=r"expected \(n, 2\)"):
        fitted.predict(np.zeros((4, 3)))
    assert fitted.predict(0.1, [0.1, 0.2]).shape == (2, 3)
    assert fitted.predict(0.1, 0.2).shape == (3,)


def test_what_contradicts_a_fit_withholds_it_unless_forced(recording):
    """A gauge of 2 m, and ICRs that are 0.83 m apart."""
    with pytest.raises(td.NotDeterminedError, match="gauge"):
        td.IcrKinematics(2.0).fit(recording)
    with pytest.warns(td.Warning, match="gauge"):
        forced = td.IcrKinematics(2.0, force=True).fit(recording)
    assert forced.parameters_.is_doubtful and forced.contradictions_
