# SPDX-License-Identifier: Apache-2.0
"""How far numbers may be off that should be equal, and why. Points are of size one."""
from __future__ import annotations

rounding = 1e-14
"""Sums of some dozen weights."""
products = 1e-13
"""Products of matrices of several levels; first derivatives."""
derivatives = 1e-12
"""Second derivatives, tangents, curvatures."""
long_sums = 1e-11
"""Sums over all points of a table; weights of wide curves, which are large."""
solved = 1e-10
"""Linear systems, by another solver."""
searched = 1e-9
"""Places that Newton's method finds; angles."""
places = 1e-6
"""Where the nearest point is: the distance hardly changes there."""
single = 1e-6
"""Weights in float."""
single_sums = 1e-5
"""Sums over all points of a table in float."""
