"""The phase function of a Lambertian sphere and the quantiles of its cosine, with as many digits as it takes."""

from mpmath import mp, mpf

DIGITS = 60


def of_angle(theta):
    return 2 * (mp.sin(theta) - theta * mp.cos(theta)) / (3 * mp.pi**2)


def phase(mu):
    with mp.workdps(DIGITS):
        mu = mpf(float(mu))
        return 2 * (mp.sqrt((1 - mu) * (1 + mu)) - mu * mp.acos(mu)) / (3 * mp.pi**2)


def beyond(theta):
    """The share that is scattered by less than theta."""
    return (2 * theta * (2 + mp.cos(2 * theta)) - 3 * mp.sin(2 * theta)) / (6 * mp.pi)


def sample(xi):
    """The cosine up to which the share is xi: by secants in the angle's fifth power, of which the share is nearly a
    line at 0."""
    with mp.workdps(DIGITS + 40):
        rest = 1 - mpf(float(xi))
        if rest == 0 or rest == 1:
            return 1 - 2 * rest
        low, high = mpf(0), mp.pi
        for _ in range(12):
            middle = (low + high) / 2
            low, high = (middle, high) if beyond(middle) < rest else (low, middle)
        if low == 0:
            low = high = (15 * mp.pi * rest / 4) ** (mpf(1) / 5)
        theta = (low + high) / 2
        for _ in range(60):
            slope = 2 * mp.pi * mp.sin(theta) * of_angle(theta)
            step = (beyond(theta) - rest) / slope
            theta -= step
            if abs(step) < mpf(10) ** -DIGITS * theta:
                break
        else:
            raise ArithmeticError(f"no quantile found at {xi}")
        return mp.cos(theta)
