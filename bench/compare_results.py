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


def compare_counts(old, new):
    """@return  whether one grew or is gone, of the programs that were run"""
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
                if b is None:
                    text, bad = f"was {a:g}, is not counted any more", True
                elif a is None:
                    text, bad = f"is new: {b:.12g}", False
                else:
                    text, bad = f"{'grew' if b > a else 'fell'} from {a:.12g} to {b:.12g}", b > a
                worse += bad
                print(f"{program}: {case}: {what} {text}")
    print(f"{changed} counts changed, {worse} of them for the worse")
    return worse > 0


def compare(old, new):
    """Prints what changed.
    @return  the exit status: 1 if a count grew or is gone"""
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
