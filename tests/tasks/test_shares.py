"""How many samples tell how large a share misses: against the binomial distribution itself."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import binom

import synergrip as sg
from synergrip.tasks.scenarios import LOOKS
from synergrip.tasks.shares import largest_share, samples_for


@pytest.mark.parametrize(
    ("missing", "share", "doubt"), [(0, 0.05, 1e-3), (0, 0.3, 0.5), (3, 0.05, 1e-3), (20, 0.1, 1e-6)]
)
def test_the_number_of_samples_is_the_least_that_leaves_as_little_doubt(
    missing: int, share: float, doubt: float
) -> None:
    count = samples_for(missing, share, doubt)
    assert binom.cdf(missing, count, share) <= doubt < binom.cdf(missing, count - 1, share)
    assert largest_share(missing, count, doubt) <= share < largest_share(missing + 1, count, doubt)


def test_none_of_135_says_that_no_more_than_a_twentieth_misses() -> None:
    assert samples_for(0, 0.05, 1e-3) == int(np.ceil(np.log(1e-3) / np.log(0.95))) == 135


@pytest.mark.parametrize("count", [1, 5, 40])
def test_the_bound_is_below_the_true_share_as_seldom_as_it_says(count: int) -> None:
    """All outcomes of all shares, with their probabilities: never more often than the doubt, and at times as often."""
    doubt, seldom = 0.05, []
    for share in np.linspace(0.002, 0.998, 250):
        told = np.array([largest_share(k, count, doubt) for k in range(count + 1)])
        seldom.append(float(binom.pmf(np.arange(count + 1), count, share)[told < share].sum()))
    assert 0.7 * doubt < max(seldom) <= doubt * (1 + 1e-9)


def test_looks_share_the_doubt() -> None:
    """A plan that is looked at as often as may be passes wrongly no more often than it says: the union of all looks."""
    asked = sg.Scenarios(compliance=0.1, share=0.1, confidence=0.95)
    each = [binom.cdf(k, asked.fresh(k), asked.share) for k in range(4)]
    assert all(LOOKS * wrongly <= 1 - asked.confidence + 1e-12 for wrongly in each)
    assert asked.share_at_most(0, asked.fresh()) <= asked.share < asked.share_at_most(0, asked.fresh() - 1)
    assert largest_share(5, 5, 0.1) == 1.0
