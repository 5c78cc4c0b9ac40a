#!/usr/bin/env python3
"""Writes reference_values.csv: the laws and the field of one chain, straight from their definitions with 120 digits.

Nothing here is rearranged to avoid cancellation, and the energies are the sums over the springs (energy law) and
the integral of the force (published law). Needs mpmath. Run it beside the file it writes.
"""
import csv
import math

from mpmath import asin, cos, exp, inf, log, mp, mpf, pi, sin, tan

mp.dps = 120
BALANCED = float(0.9**-2)
CASES = [
    # rod, angle, ratio, units, k_n, k_t, beta, elongation as a share of the span, cutoff, s/h
    (0.01, math.pi / 6, 0.5, 1, 500.0, 100.0, 1.0, -0.1, 0.05, 0.5),
    (0.01, math.pi / 6, 0.8, 12, 500.0, 100.0, 10.0, -0.065, 0.05, 2.5),
    (0.006, 0.9, 0.9, 30, 300.0, 60.0, 8.0, 0.07, 0.05, 3.25),
    (0.006, 0.9, 0.9, 30, 300.0, 60.0, 8.0, 0.07, 0.0, 29.5),
    # hardly moved
    (0.01, 0.6, 0.85, 20, 400.0, 80.0, 9.0, 1e-16, 0.05, 0.75),
    (0.01, 0.6, 0.85, 20, 400.0, 80.0, 9.0, -1e-16, 0.0, 7.5),
    (0.01, 0.6, 0.85, 20, 400.0, 80.0, 9.0, -1e-9, 0.0, 7.5),
    (0.01, 0.6, 0.85, 20, 400.0, 80.0, 9.0, 1e-5, 0.0, 7.5),
    # near both guards
    (0.01, 0.6, 0.85, 20, 400.0, 80.0, 9.0, -0.55, 0.05, 7.5),
    (0.01, 0.6, 0.85, 20, 400.0, 80.0, 9.0, 0.3, 0.05, 7.5),
    # many units, ratio near 1
    (0.01, 0.7, 0.999, 1_000_000, 400.0, 1.0, 2000.0, -0.1, 0.05, 400.0),
    (0.01, 0.7, 1 - 1e-9, 1_000_000, 400.0, 1e-3, 1e6, -0.1, 0.05, 400000.5),
    (0.01, 0.7, 1 - 2**-53, 1_000_000, 400.0, 1e-3, 1e6, 0.05, 0.0, 999999.5),
    # q^2 e^(1/beta) within rounding of 1, on a million units
    (0.01, 0.7, 0.9, 1_000_000, 400.0, 1e-4, 1 / math.log(BALANCED), -0.2, 0.05, 1.5),
    (0.01, 0.7, 0.999999, 1_000_000, 400.0, 100.0, 500000.0, -0.2, 0.05, 150000.0),
    # growth close to overflow, balanced by the ratio
    (0.01, 0.3, 1e-100, 3, 400.0, 20.0, 1 / 460.0, -0.2, 0.05, 1.01),
    # angles close to both ends
    (0.01, math.radians(0.1), 0.9, 25, 500.0, 400.0, 12.0, -0.001, 0.05, 0.5),
    (0.01, math.radians(0.1), 0.9, 25, 500.0, 400.0, 12.0, 0.003, 0.05, 10.5),
    (0.01, math.radians(89.9), 0.9, 25, 500.0, 1e-4, 12.0, -0.7, 0.05, 3.0),
    (0.01, math.radians(89.9), 0.9, 25, 500.0, 1e-4, 12.0, 5e-7, 0.0005, 3.0),
    # soft and stiff
    (1.0, 0.5, 0.7, 8, 1e-3, 1e-3, 5.0, -0.3, 0.2, 1.0),
    (0.001, 0.5, 0.7, 8, 1e9, 1e9, 5.0, 0.1, 0.2, 1.0),
    # on the brink of what is accepted by the published law: k_n = k_t tan^2(theta) (1 + 1e-9)
    (0.01, 0.5, 0.9, 10, 100.0, 100.0 / math.tan(0.5) ** 2 / (1 + 1e-9), 1e6, -1e-7, 0.0, 4.0),
    (0.01, 0.5, 0.9, 10, 100.0, 100.0 / math.tan(0.5) ** 2 / (1 + 1e-9), 1e6, -0.2, 0.0, 4.0),
]


def geometric(r, n):
    return mpf(n) if r == 1 else (r**n - 1) / (r - 1)


def integral_of_mean_tangent(x, theta):
    """Integral of (t dl) d(dl) over dl, for a = 1/2: t dl = cos(theta) - cos(x), d(dl) = cos(x) dx."""
    return cos(theta) * (sin(x) - sin(theta)) - (x - theta) / 2 - (sin(2 * x) - sin(2 * theta)) / 4


def row(rod, angle, ratio, units, k_n, k_t, beta, share, cutoff, s):
    a, theta, q, n = mpf(rod), mpf(angle), mpf(ratio), units
    k_n, k_t, r = mpf(k_n), mpf(k_t), mpf(ratio) ** 2 * exp(1 / mpf(beta))
    total = geometric(q, n)
    elongation = float(2 * a * total * mpf(share))
    dl = mpf(elongation) / total
    x = asin(sin(theta) + dl / (2 * a))
    t = tan((theta + x) / 2)
    dw = -t * dl
    normal, tangential = k_n * geometric(q * q, n), k_t * geometric(r, n)
    published = (
        (k_n - k_t * t * tan(theta)) * dl,
        (k_n - k_t * tan(theta) * tan(x)) / total,
        total * (k_n * dl**2 / 2 - k_t * tan(theta) * (2 * a) ** 2 * integral_of_mean_tangent(x, theta)),
    )
    energy = (
        dl / total * (normal + tangential * t * tan(x)),
        (normal - tangential + tangential * cos(theta) / cos(x) ** 3) / total**2,
        (normal * dl**2 + tangential * dw**2) / 2,
    )
    turned = theta * (1 + mpf(cutoff) * (1 if dl > 0 else -1))
    if cutoff == 0:
        m = mpf(n)
    elif turned >= pi / 2:
        m = mpf(1)
    else:
        m = min(max(1 + log(2 * a * (sin(turned) - sin(theta)) / dl) / log(q), 1), mpf(n))
    u = elongation * (q**s - q**m) / (1 - q**m) if s < m else 0
    away = dw / 2 * (q**s - q**m) / (1 - q**m) * min(1, mpf(s)) if s < m else 0
    inputs = [rod, angle, ratio, units, float(k_n), float(k_t), beta, elongation, cutoff, s]
    answers = [dl, x - theta, dw, *published, *energy, m, u, away]
    return [repr(value) for value in inputs] + [repr(float(value)) for value in answers]


def main():
    header = (
        "rod_length_m angle_rad ratio units normal_stiffness tangential_stiffness tangential_growth elongation_m cutoff s_over_h "
        "dl_1_m d_theta_rad dw_1_m published_force_n published_stiffness published_energy_j "
        "energy_force_n energy_stiffness energy_energy_j boundary_units normal_m tangential_m"
    ).split()
    with open("reference_values.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(row(*case) for case in CASES)


if __name__ == "__main__":
    main()
