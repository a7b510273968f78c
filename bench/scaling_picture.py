# SPDX-License-Identifier: Apache-2.0
"""Time and memory against the number of faces, ours and OpenSubdiv's, log-log, as SVG."""
import math

WIDTH, HEIGHT, LEFT, TOP, GAP = 300, 210, 70, 50, 100
COLORS = {"ours": "#1f6fb4", "OpenSubdiv": "#c8552b"}
POINTS_A_FACE = 16  # level 2 of a torus
PANELS = [("refine", "Refine, level 2: points and faces", "time, ms", 1), ("bake", "Table of level 2, float", "time, ms", 1),
          ("refine memory", "", "memory above the mesh, MB", POINTS_A_FACE / 1e6),
          ("bake memory", "", "memory above the mesh, MB", POINTS_A_FACE / 1e6)]


def curves(results, work, scale, per_face):
    """{who: [(faces, value)]}"""
    found = {}
    for row in results["rows"]:
        if row["program"] != "table_scaling" or row["work"] != work or not row["mesh"].startswith("10^"):
            continue
        faces = 10 ** int(row["mesh"][3:].split()[0])
        for t in row["times"]:
            found.setdefault(t["name"], []).append((faces, t["median"] * scale * (faces if per_face else 1)))
    return found


def panel(x0, y0, title, unit, data, legend):
    values = [v for points in data.values() for _, v in points if v > 0]
    if not values:
        return []
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    high = max(high, low + 1)
    first, last = 3, max(4, round(math.log10(max(n for points in data.values() for n, _ in points))))

    def x(n):
        return x0 + WIDTH * (math.log10(n) - first) / (last - first)

    def y(v):
        return y0 + HEIGHT * (high - math.log10(v)) / (high - low)

    out = [f'<text x="{x0}" y="{y0 - 14}" class="title">{title}</text>' if title else ""]
    out.append(f'<text transform="translate({x0 - 52} {y0 + HEIGHT / 2}) rotate(-90)" text-anchor="middle">{unit}</text>')
    for e in range(low, high + 1):
        out.append(f'<path class="grid" d="M{x0} {y(10.0 ** e):.1f}H{x0 + WIDTH}"/>')
        out.append(f'<text x="{x0 - 6}" y="{y(10.0 ** e) + 4:.1f}" text-anchor="end">{10.0 ** e:g}</text>')
    for e in range(first, last + 1):
        out.append(f'<path class="grid" d="M{x(10.0 ** e):.1f} {y0}V{y0 + HEIGHT}"/>')
        out.append(f'<text x="{x(10.0 ** e):.1f}" y="{y0 + HEIGHT + 18}" text-anchor="middle">10<tspan dy="-5" font-size="9">{e}'
                   "</tspan></text>")
    for i, (who, points) in enumerate(data.items()):
        points = [(n, v) for n, v in points if v > 0]
        color = COLORS.get(who, "#555")
        path = "L".join(f"{x(n):.1f} {y(v):.1f}" for n, v in points)
        out.append(f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="2"/>')
        out += [f'<circle cx="{x(n):.1f}" cy="{y(v):.1f}" r="3" fill="{color}"><title>{who}, {n} faces: {v:.3g} {unit}</title></circle>'
                for n, v in points]
        if legend:
            out.append(f'<text x="{x0 + 12}" y="{y0 + 20 + 17 * i}" fill="{color}" font-weight="bold">{who}</text>')
    return out


def svg(results):
    width, height = 2 * WIDTH + LEFT + GAP + 20, 2 * HEIGHT + TOP + GAP
    m = results["machine"]
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
           'font-family="sans-serif" font-size="12">',
           "<style>.grid{stroke:#ddd;fill:none}.title{font-size:14px;font-weight:bold}</style>",
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for i, (work, title, unit, scale) in enumerate(PANELS):
        data = curves(results, work, scale, work.endswith("memory"))
        out += panel(LEFT + i % 2 * (WIDTH + GAP - 10), TOP + i // 2 * (HEIGHT + 45), title, unit, data, i == 0)
    out.append(f'<text x="{LEFT}" y="{height - 12}">faces of a torus; one thread of {m["cpu"]}; medians, '
               "one at 10^7</text></svg>")
    return "\n".join(line for line in out if line) + "\n"
