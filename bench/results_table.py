# SPDX-License-Identifier: Apache-2.0
"""One table of what run_all measured, as Markdown."""

# Title, and the rows that it has: program, work, beginnings of the detail, who of ours, whether freed memory was kept.
TABLE = [
    ("Refine: topology, S_k, positions of all levels", "refine_bench", "BM_Refine", ("",), "ours", False),
    ("Refine: positions and faces of the last level", "refine_bench", "BM_RefineMesh", ("",), "ours", False),
    ("The same again, memory is there", "refine_bench", "BM_RefineMesh", ("",), "ours", True),
    ("Positions again, topology is there", "refine_bench", "BM_PointsAgain", ("",), "ours", False),
    ("P_k, levels given", "refine_bench", "BM_StencilTable", ("level 3",), "ours", False),
    ("Bake, from nothing", "table_bench", "bake", ("level 3",), "empty", False),
    ("Bake, types known", "table_bench", "bake", ("level 3",), "known", False),
    ("Apply, float x y z", "table_bench", "apply", ("level 3",), "ours", False),
    ("Apply, 8 x 8 places a face with both derivatives", "table_bench", "grid", ("",), "ours", False),
    ("Sample, prepared, random places", "limit_bench", "prepared", ("random",), "ours", False),
    ("Sample, prepared, sorted places", "limit_bench", "prepared", ("sorted",), "ours", False),
    ("Sample, from connectivity", "limit_bench", "cold", ("",), "ours", False),
    ("First touch of every face", "limit_bench", "first", ("",), "ours", False),
    ("Nearest points, proved", "search_bench", "closest", ("",), "ours", False),
    ("Nearest hits of rays", "search_bench", "rays", ("",), "ours", False),
    ("Triangles as near to the limit", "tessellation_bench", "triangles", ("",), "ours", False),
    ("Making these triangles", "tessellation_bench", "tessellate", ("",), "ours", False),
    ("Called from Python: a call", "python_bench", "call apply", ("",), "ours", False),
    ("Called from Python: a call with one place", "python_bench", "call evaluate", ("",), "ours", False),
    ("Called from Python: apply", "python_bench", "apply", ("",), "ours", False),
    ("Called from Python: a million places", "python_bench", "evaluate", ("",), "ours", False),
    ("Called from Python: import", "python_bench", "import", ("",), "ours", False),
    ("Command", "commands", "command", ("",), "ours", False),
    ("Time, as meshes grow: refine", "table_scaling", "refine", ("",), "ours", False),
    ("Time, as meshes grow: bake", "table_scaling", "bake", ("",), "ours", False),
    ("Time, as meshes grow: apply", "table_scaling", "apply", ("level 2",), "ours", False),
    ("Most memory above the mesh: refine", "table_scaling", "refine memory", ("",), "ours", False),
    ("Most memory above the mesh: bake", "table_scaling", "bake memory", ("",), "ours", False),
]


def number(x):
    return f"{x:.3g}" if x < 1000 else f"{x:.0f}"


def spread(t):
    return f"{number(t['median'])} ({number(t['least'])}..{number(t['most'])})"


def line(title, row, ours_name):
    ours = next((t for t in row["times"] if t["name"] == ours_name), None)
    if ours is None:
        return None
    peer = min((t for t in row["times"] if t["role"] == "peer"), key=lambda t: t["median"], default=None)
    of = ", ".join(text for text in (row["mesh"].replace("_", " "), row["detail"]) if text)
    threads = f", {row['threads']} threads" if row["threads"] > 1 else ""
    theirs = f"{peer['name']} {spread(peer)} | **{peer['median'] / ours['median']:.2f}**" if peer else " | "
    return f"| {title} | {of}{threads} | {row['unit']} | {spread(ours)} | {theirs} |"


def markdown(results):
    m = results["machine"]
    bandwidth = f", one thread writes {m['write bandwidth'] / 1e9:.1f} GB/s" if "write bandwidth" in m else ""
    compiler = f"; g++ {m['compiler']} {m['flags']}" if "compiler" in m else ""
    lines = [f"{m['cpu']}, {m['cores']} cores, {m['memory GB']} GB{bandwidth}{compiler}; one pinned thread unless said; medians of "
             f"{min(row['turns'] for row in results['rows'])} turns at least (least..most)" + ("; QUICK: small meshes, no figures" if results["quick"] else "") + ".", "",
             "| work | of | unit | ours | best peer | peer : ours |", "|---|---|---|---|---|---|"]
    for title, program, work, details, ours, keep in TABLE:
        for row in results["rows"]:
            if (row["program"], row["work"], row["keep memory"]) != (program, work, keep):
                continue
            if not row["detail"].startswith(details):
                continue
            text = line(title, row, ours)
            if text:
                lines.append(text)
                title = ""
    return "\n".join(lines) + "\n"


def errors(results):
    """Largest errors, ours and the peers'."""
    lines = ["## Errors beside others", "", f"Largest errors ({results['machine']['cpu']}, {results['machine']['cores']} cores).", "",
             "| what | mesh | of | unit | error |", "|---|---|---|---|---|"]
    for row in results["rows"]:
        if "error" in row["work"]:
            lines += [f"| {row['work']} | {row['mesh'].replace('_', ' ')} | {t['name']} | {row['unit']} | {t['median']:.1e} |"
                      for t in row["times"]]
    return "\n".join(lines) + "\n"
