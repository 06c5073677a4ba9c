"""How many samples of which how many miss tell how large a share misses at most: the binomial distribution."""

from __future__ import annotations


def samples_for(missing: int, share: float, doubt: float) -> int:
    """Return the least number N of samples of which so many may miss.

    ``sum over i <= missing of C(N, i) share^i (1 - share)^(N - i) <= doubt``: where a larger share misses, no more of N
    do so with a probability of `doubt` at most.

    Args:
        missing: of the samples.
        share: of all that may miss.
        doubt: the probability.
    """
    from scipy.special import bdtr

    few, many = missing + 1, max(2 * (missing + 1), 16)
    while bdtr(missing, many, share) > doubt:
        few, many = many, 2 * many
    while many - few > 1:
        middle = (few + many) // 2
        few, many = (few, middle) if bdtr(missing, middle, share) <= doubt else (middle, many)
    return int(many)


def largest_share(missing: int, count: int, doubt: float) -> float:
    """Return the share that misses, at most, where so many of a number of samples do.

    The exact upper bound of Clopper and Pearson: the share for which as few miss with a probability of `doubt`.

    Args:
        missing: of the samples.
        count: of the samples.
        doubt: the probability that the share is larger.
    """
    from scipy.special import betaincinv

    return float(betaincinv(missing + 1, count - missing, 1 - doubt)) if missing < count else 1.0
