"""Numbers that are drawn from distributions, and what is said of the runs that were made with them."""

from __future__ import annotations

from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest

from support_exudyn.sweeps.distributions import distribution_of
from support_exudyn.sweeps.statistics import percentiles, ranking
from user_forces.values.value import InputError

HERE = Path()
NORMAL = {"distribution": "normal", "mean": Decimal("0.9")}


def test_a_normal_distribution_has_its_quantiles() -> None:
    normal = distribution_of({**NORMAL, "std": Decimal("0.02")}, "vary.e", HERE)
    # of the standard normal distribution, from tables
    for share, deviation in ((0.5, 0.0), (0.8413447460685429, 1.0), (0.025, -1.959963984540054)):
        assert float(normal.at(share)) == pytest.approx(0.9 + 0.02 * deviation, abs=1e-11)
    assert normal.at(0.0).is_finite()
    assert normal.at(1.0).is_finite()


def test_a_truncated_one_stays_between_its_bounds_with_the_same_shape() -> None:
    truncated = distribution_of({**NORMAL, "std": Decimal("0.05"), "to": Decimal("0.9")}, "vary.e", HERE)
    drawn = [float(truncated.at(share)) for share in np.linspace(0.0, 1.0, 101)]
    assert max(drawn) <= 0.9
    # half of the half is below the first quartile of the whole
    assert float(truncated.at(0.5)) == pytest.approx(0.9 - 0.05 * 0.6744897501960817, abs=1e-11)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"distribution": "gauss"}, "distribution = 'gauss': allowed: 'uniform'"),
        ({"distribution": "normal", "mean": 1}, "vary.e.std: missing"),
        ({"distribution": "normal", "mean": 1, "std": 0}, "std = 0: allowed: > 0"),
        ({"distribution": "normal", "mean": 1, "std": 1, "from": 2, "to": 1}, "from < to"),
        ({"distribution": "uniform", "from": 0, "to": 1, "std": 1}, "vary.e.std: unknown key"),
        ({"distribution": "log_uniform", "from": 0, "to": 1}, "> 0"),
    ],
)
def test_what_is_no_distribution_is_refused(given: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        distribution_of(given, "vary.e", HERE)


# --- statistics ---


def test_intervals_hold_the_percentile_as_often_as_they_say() -> None:
    random = np.random.default_rng(0)
    within = 0
    for _ in range(300):
        (found,) = percentiles(random.exponential(size=60).tolist(), [0.9])
        within += found.low <= -np.log(0.1) <= (np.inf if np.isnan(found.high) else found.high)
    assert within / 300 >= 0.93


def test_inputs_are_ranked_by_how_far_a_number_follows_them() -> None:
    random = np.random.default_rng(1)
    a, b = random.normal(size=(2, 200))
    found = ranking(
        {"b": b.tolist(), "a": a.tolist(), "same": [1.0] * 200, "word": ["x"] * 200},
        np.exp(a + 0.2 * b).tolist(),
    )
    assert [one.name for one in found] == ["a", "b"]
    # monotonic, whatever its shape
    assert found[0].correlation > 0.95
    assert found[0].is_certain
    (exact,) = ranking({"a": a.tolist()}, (-(a**3)).tolist())
    assert exact.correlation == pytest.approx(-1.0)


def test_rank_intervals_hold_the_correlation_as_often_as_they_say() -> None:
    random = np.random.default_rng(2)
    rho = 0.6
    # Spearman's correlation of a normal pair, in closed form
    true = 6.0 / np.pi * np.arcsin(0.5 * rho)
    within = 0
    for _ in range(300):
        x, noise = random.normal(size=(2, 50))
        (found,) = ranking({"x": x.tolist()}, (rho * x + np.sqrt(1.0 - rho**2) * noise).tolist())
        within += found.low <= true <= found.high
    assert 0.92 <= within / 300 <= 0.99
