# SPDX-License-Identifier: Apache-2.0
"""What changed from one result of run_all to another."""


def key(row):
    name = f"{row['program']}: {row['work']}, {row['mesh']}, {row['detail']}"
    return name + (", memory kept" if row["keep memory"] else "") + f", {row['threads']} thr"


def times(results):
    """Ours, by row and name."""
    return {(key(row), t["name"]): (t, row["unit"]) for row in results["rows"] for t in row["times"] if t["role"] == "ours"}


def compare_times(old, new):
    """Slower, or faster: the spreads do not meet."""
    before = times(old)
    changes = {"slower": [], "faster": []}
    for name, (t, unit) in times(new).items():
        if name not in before:
            continue
        was = before[name][0]
        if t["least"] > was["most"] or t["most"] < was["least"]:
            ratio = t["median"] / was["median"]
            changes["slower" if ratio > 1 else "faster"].append((ratio, f"{name[0]}, {name[1]}: {was['median']:.4g} -> "
                                                                 f"{t['median']:.4g} {unit}, {ratio:.2f} times"))
    for word, reverse in (("faster", False), ("slower", True)):
        for _, text in sorted(changes[word], reverse=reverse):
            print(f"{word}: {text}")
    print(f"{len(changes['slower'])} slower, {len(changes['faster'])} faster, beyond the spread of both")


# What a count may grow by before it is a change for the worse: a share and a constant, by the end of its name. How often
# and how much code allocates hangs on the compiler, on libraries and on who was in the cache before; all else (entries,
# types, points, weights) is arithmetic of mesh and scheme, and exact.
BOUNDS = {": allocations": (0.1, 16), ": bytes allocated": (0.1, 4096), " bytes": (0.02, 256)}


def most(what, was):
    """The largest count that is as good as `was`. Nothing stays nothing: what allocates not at all is promised to.

    >>> [most("level: types", 7), most("second apply: allocations", 0), most("grid: allocations", 100), most("table bytes", 1000)]
    [7, 0, 126, 1276]
    """
    share, constant = next((bound for end, bound in BOUNDS.items() if what.endswith(end)), (0, 0))
    return was if was == 0 else round(was * (1 + share)) + constant


def compare_counts(old, new):
    """@return  whether one grew beyond its bound or is gone, of the programs that were run"""
    worse = changed = 0
    for program, cases in new["counts"].items():
        before = old["counts"].get(program)
        if before is None:
            continue
        for case in dict.fromkeys([*before, *cases]):
            was, now = before.get(case, {}), cases.get(case, {})
            for what in dict.fromkeys([*was, *now]):
                a, b = was.get(what), now.get(what)
                if a == b:
                    continue
                changed += 1
                bad = b is None or a is not None and b > most(what, a)
                if b is None:
                    text = f"was {a:g}, is not counted any more"
                elif a is None:
                    text = f"is new: {b:.12g}"
                else:
                    text = f"{'grew' if b > a else 'fell'} from {a:.12g} to {b:.12g}"
                    text += f", beyond {most(what, a):.12g}" if bad else ""
                worse += bad
                print(f"{program}: {case}: {what} {text}")
    print(f"{changed} counts changed, {worse} of them for the worse")
    return worse > 0


def compare(old, new):
    """Prints what changed.
    @return  the exit status: 1 if a count grew beyond its bound or is gone"""
    if old.get("quick") != new.get("quick") and any(name != "counts" for name in new["counts"]):
        print("one of the two is --quick: nothing to compare but what `counts` counts")
        old, new = ({"counts": {n: c for n, c in all["counts"].items() if n == "counts"}} for all in (old, new))
    if new.get("rows") and old.get("rows"):
        for what in ("cpu", "cores", "compiler", "flags"):
            if old["machine"].get(what) != new["machine"].get(what):
                print(f"note: {what} differ, so that times say little: {old['machine'].get(what)} | {new['machine'].get(what)}")
        compare_times(old, new)
    if not compare_counts(old, new):
        return 0
    if list(new["counts"]) == ["counts"]:
        print("If that is meant to be: bench/run_all --only counts --json bench/counts.json, and say why in the commit.")
    return 1
