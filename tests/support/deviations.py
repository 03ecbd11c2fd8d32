"""How sure a statement about an ensemble is."""

import numpy as np


def deviations(values, bound, error=0.0, of_each=False):
    """Return by how many standard errors the mean of independent values lies above a bound that has an error itself.

    The standard error of a share, the mean of truth values, is the binomial one of the bound: all of 25 members are
    five standard errors above a half.  Tests ask for at least five, or, where they compare, for at most five.

    of_each : in standard deviations of a single value instead, for what is said of one motion.
    """
    values = np.asarray(values)
    spread = np.sqrt(bound * (1.0 - bound)) if values.dtype == bool else np.std(values, ddof=1)
    scatter = np.hypot(spread if of_each else spread / np.sqrt(values.size), error)
    apart = np.mean(values) - bound
    return float(apart / scatter) if scatter else float(np.copysign(np.inf, apart))


def mean_of(values):
    """Return the mean of independent values and its standard error: the bound and error of a comparison."""
    return float(np.mean(values)), float(np.std(values, ddof=1) / np.sqrt(len(values)))
