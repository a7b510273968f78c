# SPDX-License-Identifier: Apache-2.0
# A reader of STEP files (ISO 10303-21) that knows nothing of OpenCASCADE: faces with B-spline surfaces, by SciPy, and the
# topology of shells.
#   step_splines.py IN.step STEPS OUT.csv
# writes points x,y,z of all surfaces, a grid of so many steps a span, and prints counts, a line each. Fails where edges of
# closed shells are not those of two faces that run against each other, or where curves of edges do not end at their
# vertices.
import collections, re, sys
import numpy as np
from scipy.interpolate import BSpline

text = re.sub(r"\s+", "", open(sys.argv[1]).read().split("DATA;")[1])
token = re.compile(r"'(?:[^']|'')*'|#\d+|[A-Z_][A-Z0-9_]*|\.[A-Z_]+\.|[-+]?\d+\.?\d*(?:E[-+]?\d+)?|[(),*$]")


def parse(body):
    """Nested lists of words; a complex entity is a list of (name, arguments)."""
    stack, words = [[]], token.findall(body)
    for word in words:
        if word == "(": stack.append([])
        elif word == ")": last = stack.pop(); stack[-1].append(last)
        elif word != ",": stack[-1].append(word)
    top = stack[0] if len(stack[0]) > 1 else stack[0][0]
    return [(top[i], top[i + 1]) for i in range(0, len(top), 2)]


entities = {name: body for name, body in re.findall(r"(#\d+)=((?:'(?:[^']|'')*'|[^;'])*);", text)}
cache = {}


def get(name):
    if name not in cache: cache[name] = dict(parse(entities[name]))
    return cache[name]


def all_of(kind): return [name for name, body in entities.items() if re.match(r"\(?.*\b" + kind + r"\(", body[:200])]
def edges_of(loop): return get(loop).get("EDGE_LOOP", [0, []])[1]  # a loop may be a vertex alone, as at a pole
def point(name): return np.array([float(x) for x in get(name)["CARTESIAN_POINT"][1]])
def nest(a, f): return [nest(x, f) for x in a] if isinstance(a, list) else f(a)


def spline(entity, kind):
    """Degrees, homogeneous net (u first), knots by direction; nothing of another kind of surface or curve."""
    e, d = get(entity), 2 if kind == "SURFACE" else 1
    with_knots, whole = e.get(f"B_SPLINE_{kind}_WITH_KNOTS"), e.get(f"B_SPLINE_{kind}")
    if not with_knots: return None
    if not whole: whole = with_knots[1:]  # a simple entity: the name first, knots last
    knots = with_knots[-(2 * d + 1):-1]
    net = np.array(nest(whole[d], point))
    rational = e.get(f"RATIONAL_B_SPLINE_{kind}")
    weights = np.array(nest(rational[0], float)) if rational else np.ones(net.shape[:-1])
    all_knots = [np.repeat(nest(knots[d + k], float), nest(knots[k], int)) for k in range(d)]
    return [int(p) for p in whole[:d]], np.concatenate([net * weights[..., None], weights[..., None]], -1), all_knots


def values(shape, u, v=None):
    degrees, net, knots = shape
    h = BSpline(knots[0], net, degrees[0])(u)
    if v is not None: h = np.moveaxis(BSpline(knots[1], np.moveaxis(h, 1, 0), degrees[1])(v), 1, 0)
    return h[..., :3] / h[..., 3:]


def parameters(knots, steps):
    ends = np.unique(knots)
    return np.unique(np.concatenate([np.linspace(a, b, steps + 1) for a, b in zip(ends, ends[1:])]))


steps, points, other, uses, names = int(sys.argv[2]), [], 0, collections.Counter(), set()
faces = all_of("ADVANCED_FACE")
for face in faces:
    name, bounds, surface, _ = get(face)["ADVANCED_FACE"]
    names.add(name)
    shape = spline(surface, "SURFACE")
    if shape is None: other += 1; continue
    u, v = (parameters(k, steps) for k in shape[2])
    grid = values(shape, u, v)
    points.append(grid.reshape(-1, 3))
    rim = np.concatenate([grid[0], grid[-1], grid[:, 0], grid[:, -1]])
    size = np.linalg.norm(np.ptp(rim, axis=0))
    for bound in bounds:
        loop = next(iter(get(bound).values()))[1]
        for oriented in edges_of(loop):
            edge, sense = get(oriented)["ORIENTED_EDGE"][3:]
            uses[edge, sense] += 1
            _, start, end, curve, _ = get(edge)["EDGE_CURVE"]
            curve = get(curve)["SURFACE_CURVE"][1] if "SURFACE_CURVE" in get(curve) else \
                get(curve)["SEAM_CURVE"][1] if "SEAM_CURVE" in get(curve) else curve
            line = spline(curve, "CURVE")
            if line is None: continue
            ends = values(line, np.array([line[2][0][0], line[2][0][-1]]))
            for x, vertex in zip(ends, (start, end)):
                assert np.linalg.norm(x - point(get(vertex)["VERTEX_POINT"][1])) <= 1e-7 * (1 + size), (edge, "ends", x)
closed = all_of("CLOSED_SHELL")
for shell in closed:
    inside = collections.Counter()
    for face in get(shell)["CLOSED_SHELL"][1]:
        for bound in get(face)["ADVANCED_FACE"][1]:
            kind, (_, loop, same) = next(iter(get(bound).items()))
            for oriented in edges_of(loop):
                edge, sense = get(oriented)["ORIENTED_EDGE"][3:]
                inside[edge, sense == same] += 1
    for edge, _ in list(inside): assert inside[edge, True] == inside[edge, False] == 1, (shell, edge, inside)
np.savetxt(sys.argv[3], np.concatenate(points), delimiter=",", header="x,y,z", comments="", fmt="%.17g")
print("faces", len(faces)); print("other", other); print("closed", len(closed)); print("names", " ".join(sorted(names)))
