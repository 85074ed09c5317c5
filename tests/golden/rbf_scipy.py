# SPDX-FileCopyrightText: 2026 the vsprite authors
# SPDX-License-Identifier: MIT
# Writes rbf_scipy.txt: python3 rbf_scipy.py > rbf_scipy.txt (Debian: python3-scipy 1.10)
import warnings
import numpy as np
from scipy.interpolate import RBFInterpolator

warnings.simplefilter("ignore")
rng = np.random.default_rng(1)
kernels = ["linear", "gaussian", "thin_plate_spline", "multiquadric"]
print("# kernel degree width ridge dims outputs n places; then x, y, places, values")


def line(a):
    print(" ".join(f"{v:.17g}" for v in np.ravel(a)))


for dims, n in ((1, 5), (2, 9)):
    x = rng.random((n, dims))
    y = np.stack([40 * np.sin(x.sum(1) * 2), x[:, 0] ** 2 - 3], 1)
    at = rng.random((6, dims))
    for k, name in enumerate(kernels):
        for degree in (-1, 0, 1):
            width = 0.4
            if name == "thin_plate_spline" and degree < 0:
                continue  # singular in one dimension as often as not
            shape = 1 / width if name in ("gaussian", "multiquadric") else 1
            f = RBFInterpolator(x, y, kernel=name, degree=degree, epsilon=shape)
            print(k, degree, width, 0, dims, 2, n, 6)
            for a in (x, y, at, f(at)):
                line(a)
