# SPDX-License-Identifier: Apache-2.0
# Samples of rational B-spline surfaces of an OBJ against SciPy's BSpline, tensor products and quotients made here.
#   scipy_splines.py SHAPES.obj SAMPLES.csv
# The samples have the columns patch,u,v,status,x,y,z,xu,yu,zu,xv,yv,zv,xuu,...
import csv, sys
import numpy as np
from scipy.interpolate import BSpline

vertices, surfaces, words = [], [], open(sys.argv[1]).read().replace("\\\n", " ").splitlines()
for line in words:
    w = line.split()
    if not w: continue
    if w[0] == "v": vertices.append([float(x) for x in w[1:]] + [1.0] * (5 - len(w)))
    if w[0] == "deg": degree = [int(x) for x in w[1:]]
    if w[0] == "surf": surfaces.append({"deg": degree, "points": [int(x.split("/")[0]) for x in w[5:]]})
    if w[0] == "parm": surfaces[-1][w[1]] = np.array([float(x) for x in w[2:]])
vertices = np.array(vertices)
columns = np.c_[vertices[:, :3] * vertices[:, 3:], vertices[:, 3]]

rows = list(csv.reader(open(sys.argv[2])))
assert rows[0][:7] == ["patch", "u", "v", "status", "x", "y", "z"], rows[0]
worst = np.zeros(3)
for row in rows[1:]:
    s, u, v = surfaces[int(row[0])], float(row[1]), float(row[2])
    (p, q), m, n = s["deg"], len(s["u"]) - s["deg"][0] - 1, len(s["v"]) - s["deg"][1] - 1
    index = [i - 1 if i > 0 else len(vertices) + i for i in s["points"]]
    net = columns[index].reshape(n, m, 4)
    # Derivatives a in u and b in v of the columns.
    def A(a, b):
        in_u = BSpline(s["u"], np.moveaxis(net, 1, 0), p)(u, nu=a)
        return BSpline(s["v"], in_u, q)(v, nu=b)
    H = {k: A(*k) for k in [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]}
    w = {k: h[3] for k, h in H.items()}
    x = {(0, 0): H[0, 0][:3] / w[0, 0]}
    for k in [(1, 0), (0, 1)]: x[k] = (H[k][:3] - w[k] * x[0, 0]) / w[0, 0]
    x[2, 0] = (H[2, 0][:3] - 2 * w[1, 0] * x[1, 0] - w[2, 0] * x[0, 0]) / w[0, 0]
    x[0, 2] = (H[0, 2][:3] - 2 * w[0, 1] * x[0, 1] - w[0, 2] * x[0, 0]) / w[0, 0]
    x[1, 1] = (H[1, 1][:3] - w[1, 0] * x[0, 1] - w[0, 1] * x[1, 0] - w[1, 1] * x[0, 0]) / w[0, 0]
    for i, k in enumerate([(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]):
        ours = np.array([float(t) for t in row[4 + 3 * i:7 + 3 * i]])
        order = sum(k)
        worst[order] = max(worst[order], np.abs(ours - x[k]).max() / (1 + np.abs(x[k]).max()))
print("largest relative differences of points, first and second derivatives:", *worst)
assert worst[0] < 1e-13 and worst[1] < 1e-12 and worst[2] < 1e-11, worst
