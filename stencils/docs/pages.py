# SPDX-License-Identifier: Apache-2.0
"""Makes the site: gathers what is written (every Markdown page of the sources) and what is computed (the reference of
the program, the schemes, the API, what the tests are), and calls Sphinx. A warning is an error.

    pages.py --source DIR --build DIR --program sublimit --sphinx sphinx-build --doxygen doxygen --version 0.1.0
    pages.py --names ...    only reads the docstrings: their faults, functions without a text
"""
from __future__ import annotations

import argparse
import ast
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
from collections import Counter

sys.dont_write_bytecode = True
import api  # noqa: E402  (beside this file)

DOCS = pathlib.Path("stencils/docs")
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
GUIDES = ["points", "animation", "closest", "step", "proof", "fit", "python", "cluster", "gpu"]


def sources(root: pathlib.Path, pattern: str) -> list[pathlib.Path]:
    """Files of the sources from their root; nothing of builds or of git."""
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(f for f in folders if not f.startswith(".") and f not in ("build", "node_modules", "__pycache__"))
        for name in sorted(names):
            path = pathlib.Path(folder, name).relative_to(root)
            if path.match(pattern):
                found.append(path)
    return found


class Site:
    def __init__(self, root: pathlib.Path, build: pathlib.Path):
        self.root, self.pages, self.errors = root, build / "pages", []
        shutil.rmtree(self.pages, ignore_errors=True)
        self.pages.mkdir(parents=True)

    def write(self, name: str | pathlib.Path, text: str) -> None:
        path = self.pages / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def linked(self, page: pathlib.Path, text: str) -> str:
        """Links of a page to sources: pages stay links, pictures are copied, other files are named; dead ones are errors."""

        def link(match: re.Match[str]) -> str:
            picture, label, target = match.groups()
            if "://" in target or target.startswith("#"):
                return match.group(0)
            path, _, section = target.partition("#")
            file = pathlib.Path(os.path.normpath(page.parent / path))
            if not (self.root / file).exists() and not (self.pages / file).exists():
                self.errors.append(f"{page}: there is no {target}")
                return label
            if (self.root / file).is_dir():
                file /= "README.md"
                if not (self.root / file).exists():
                    return label
            if picture:
                if (self.root / file).exists():
                    (self.pages / file).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(self.root / file, self.pages / file)
                return match.group(0)
            if file.suffix == ".md":
                inside = os.path.relpath(file, page.parent) + ("#" + section if section else "")
                return f"[{label}]({inside})"
            return f"`{file}`" if label.strip("`") in (path, file.name) else f"{label} (`{file}`)"

        parts = re.split(r"(^```.*?^```\n?|`[^`\n]*`)", text, flags=re.M | re.S)
        return "".join(part if i % 2 else LINK.sub(link, part) for i, part in enumerate(parts))

    def gather(self, reference: pathlib.Path) -> None:
        """Pages of the sources; those of verbs begin with what the program says of them."""
        written = {}
        for page in sources(self.root, "*.md"):
            written[page] = (self.root / page).read_text()
        for generated in sorted(reference.glob("*.md")):
            verb = generated.stem.removeprefix("sublimit-")
            text = generated.read_text().replace("(sublimit-", "(verbs/" if verb == "sublimit" else "(")
            page = DOCS / ("reference.md" if verb == "sublimit" else f"verbs/{verb}.md")
            own = written.get(page, "").partition("\n")[2]
            written[page] = text + "\n" + own
        for page in written:  # so that links between them are known
            self.write(page, "")
        for page, text in written.items():
            self.write(page, self.linked(page, text))

    def toctree(self, title: str, names: list[str]) -> str:
        lines = "\n".join(names)
        return f"```{{toctree}}\n:caption: {title}\n:maxdepth: 1\n\n{lines}\n```\n\n"


def scheme_pages(site: Site, schemes: list[dict], report: dict, gallery: pathlib.Path) -> list[str]:
    """A page for each scheme: picture, masks, spectrum, smoothness, source, as the program computes them."""
    studied = {s["name"]: s for s in report["schemes"]}
    verdicts = {row["scheme"]: row for row in report["summary"]}
    headers = {p.stem: p for p in sources(site.root / "lib/sublimit", "*.h")}
    names = []
    rows = []
    for scheme in schemes:
        name = scheme["name"]
        names.append(f"schemes/{name}")
        text = [f"# {name}\n", f"{scheme['kind'].capitalize()} scheme. Source: {api.escaped(scheme['source'])}.\n"]
        for picture in sorted(gallery.glob(f"{name}-*.svg")):
            label = picture.stem.removeprefix(name + "-")
            if scheme["kind"] == "surface" and label not in (
                    "cube", "cube-irregular", "cube-tetrahedral", "tetrahedron") or \
               scheme["kind"] == "curve" and label not in ("open", "closed"):
                continue
            (site.pages / "schemes").mkdir(exist_ok=True)
            shutil.copyfile(picture, site.pages / "schemes" / picture.name)
            text.append(f"![{name}: {label.replace('-', ' ')}, level by level and in the limit]({picture.name})\n")
        text.append("## In short\n\n| | |\n|---|---|")
        for key, value in scheme.items():
            if key in ("name", "options", "source"):
                continue
            shown = ", ".join(map(str, value)) if isinstance(value, list) else {True: "yes", False: "no"}.get(value, value) \
                if isinstance(value, bool) else value
            text.append(f"| {key.replace('_', ' ')} | {api.escaped(str(shown))} |")
        if scheme["options"]:
            text.append("\n## Options\n\n| `--option` | default | values | |\n|---|---|---|---|")
            for option, told in scheme["options"].items():
                values = ", ".join(told["values"]) if "values" in told else f"{told['from']} to {told['to']}"
                text.append(f"| `{option}` | {told['default']} | {values} | {api.escaped(told['meaning'])} |")
        if name in verdicts:
            row = verdicts[name]
            text.append("\n## Smoothness\n\n| | | |\n|---|---|---|")
            text.append(f"| regular meshes | {api.escaped(str(row['regular']))} | {row['regular_verdict']} |")
            if row.get("extraordinary"):
                text.append(f"| extraordinary points, valences {row['valences']} | {api.escaped(row['extraordinary'])} "
                            f"| {row['extraordinary_verdict']} |")
            if row["notes"]:
                text.append(f"\n{api.escaped(row['notes'])}")
            rows.append((name, scheme, row))
        study = studied.get(name, {})
        regular = study.get("regular") or {}
        if regular.get("mask"):
            weights = Counter(str(w.get("exact") or w["weight"]) for w in regular["mask"])
            text.append("\n## Masks\n\nWeights of one point of a regular mesh in the new ones: " +
                        ", ".join(f"{api.escaped(w)} ({n} times)" for w, n in weights.items()) + ".")
        header = headers.get(name.replace("-", "_"))
        if header:
            source = (site.root / "lib/sublimit" / header).read_text()
            body = re.sub(r"^#(include|pragma).*\n|^// SPDX.*\n", "", source, flags=re.M).strip()
            text.append(f"\nThe whole scheme, `sublimit/{header}`:\n\n```cpp\n{body}\n```")
        spectra = [n for n in study.get("neighborhoods", []) if n.get("spectrum") and n["kind"] in ("vertex", "face")]
        if spectra:
            text.append("\n## Spectrum\n\nLargest eigenvalues of the local matrix, by Fourier block; exact where they are "
                        "rational.\n\n| centre | eigenvalues (block) |\n|---|---|")
            for n in spectra:
                values = ", ".join(f"{api.escaped(str(e.get('exact') or round(e['modulus'], 6)))} ({e['block']})"
                                   for e in n["spectrum"][:7])
                text.append(f"| {n['kind']}, {n['n']} | {values} |")
        site.write(f"schemes/{name}.md", "\n".join(text) + "\n")
    table = ["# Schemes\n", "Computed by the program from the masks: `sublimit schemes`, `sublimit analyze -s all`.\n",
             "| scheme | limit | regular | extraordinary | source |", "|---|---|---|---|---|"]
    for scheme in schemes:
        row = verdicts.get(scheme["name"], {})
        table.append("| [{0}]({0}.md) | {1} | {2} | {3} | {4} |".format(
            scheme["name"], api.escaped(str(scheme["limit"])), api.escaped(str(row.get("regular", ""))),
            api.escaped(str(row.get("extraordinary") or "")), api.escaped(scheme["source"])))
    site.write("schemes/index.md", "\n".join(table) + "\n\n" +
               site.toctree("Schemes", [n.split("/")[1] for n in names]))
    return ["schemes/index"]


def bars(title: str, counts: list[tuple[str, int]]) -> str:
    """A bar chart as SVG that takes the page's colours."""
    most = max(n for _, n in counts)
    height = 26 * len(counts) + 34
    lines = [f'<svg viewBox="0 0 640 {height}" width="640" role="img" aria-label="{title}" '
             'xmlns="http://www.w3.org/2000/svg" font-family="sans-serif" font-size="13" fill="currentColor">',
             f'<text x="0" y="16" font-weight="bold">{title}</text>']
    for i, (name, n) in enumerate(counts):
        y = 30 + 26 * i
        lines.append(f'<text x="0" y="{y + 15}">{name}</text>'
                     f'<rect x="190" y="{y + 2}" width="{max(1, round(370 * n / most))}" height="17" fill="#4a7fb5"/>'
                     f'<text x="{198 + round(370 * n / most)}" y="{y + 15}">{n:,}</text>')
    return '<figure class="chart">' + "".join(lines) + "</svg></figure>\n"


def lines_of(root: pathlib.Path, folder: str, suffixes: tuple[str, ...]) -> int:
    return sum(len((root / p).read_text(errors="replace").splitlines())
               for p in sources(root, "*") if p.parts[0] == folder and p.suffix in suffixes)


def tested_page(site: Site) -> None:
    """Counted in the sources, so that it cannot be out of date."""
    root, code = site.root, (".h", ".cpp", ".c", ".py", ".cu", ".comp", ".inc")
    tests: Counter[str] = Counter()
    kinds: Counter[str] = Counter()
    declared = re.compile(r"^\s*(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+),", re.M)
    for path in sources(root / "tests", "*.cpp"):
        text = (root / "tests" / path).read_text()
        n = len(declared.findall(text))
        tests[path.parts[0] if len(path.parts) > 1 else "others"] += n
        parametrised = len(re.findall(r"^\s*TEST_P\(", text, re.M))
        kinds["over all schemes or shapes"] += parametrised
        if re.search(r"opensubdiv|openmesh|cgal|embree|opencascade|vtk|scipy|torch", path.name):
            kinds["against other libraries"] += n - parametrised
        elif "failures" in path.parts:
            kinds["with failing calls"] += n - parametrised
        else:
            kinds["laws, identities, closed forms"] += n - parametrised
    for path in sources(root / "tests/python", "*.py"):
        n = len(re.findall(r"^def test_", (root / "tests/python" / path).read_text(), re.M))
        tests["python"] += n
        kinds["of the Python module"] += n
    fuzzers = [p.stem for p in sources(root / "tests/fuzz", "*_fuzzer.cpp")]
    corpus = sum(1 for p in (root / "tests/fuzz/corpus").rglob("*") if p.is_file())
    text = ["# How it is tested\n", "Counted in the sources when this site was made.\n",
            bars("tests by folder of the sources that they mirror", tests.most_common()),
            bars("tests by kind", kinds.most_common()),
            bars("lines", [("lib", lines_of(root, "lib", code)), ("eval", lines_of(root, "eval", code)),
                           ("stencils", lines_of(root, "stencils", code)), ("tests", lines_of(root, "tests", code))]),
            f"Fuzzed readers: {', '.join(f'`{f}`' for f in fuzzers)}, from a corpus of {corpus} files.\n",
            "A law that nothing can break is none: a test over all masks changes each coefficient of each scheme by a "
            "millionth, and some law must notice. Every call for memory, file or thread is made to fail in turn in the "
            "tests of failures. Every command line of this site is run as it is written, with the program that ships; "
            "every example is compiled and run. What the labels mean and how to run a part: "
            "[tests](../../tests/README.md).\n"]
    site.write(DOCS / "tested.md", "\n".join(text))


def section_of(root: pathlib.Path, page: str, title: str) -> str:
    """The text below a heading of a page, its links as they are from this folder."""
    text = (root / page).read_text()
    found = re.search(rf"^## {re.escape(title)}\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    if not found:
        raise SystemExit(f"{page} has no section '{title}'")
    home = pathlib.Path(page).parent

    def moved(match: re.Match[str]) -> str:
        picture, label, target = match.groups()
        if "://" in target:
            return match.group(0)
        path, mark, part = target.partition("#")
        return f"{picture}[{label}]({os.path.relpath(home / path if path else page, DOCS)}{mark}{part})"

    return LINK.sub(moved, found.group(1)).strip() + "\n"


def exact_page(site: Site) -> None:
    """What is exact, as the READMEs say it, and how it was measured: truth tests, and errors beside others."""
    root = site.root
    measured = section_of(root, "bench/README.md", "Errors beside others")
    truths = []
    for path in sources(root / "tests", "*_test.cpp"):
        text = (root / "tests" / path).read_text()
        if re.search(r'256[-_ ]?[Bb]its?|#include ".*(truth|brute_force)', text):
            told = re.match(r"// SPDX.*\n((?://.*\n)+)", text)
            if not told:
                continue
            said = " ".join(line.lstrip("/ ") for line in told.group(1).splitlines())
            truths.append(f"| `tests/{path}` | {api.escaped(said.split('. ')[0])} |")
    text = ["# What is exact, and how it was measured\n", section_of(root, "README.md", "What is exact"),
            "## Exceptions, and what is not promised\n",
            section_of(root, "lib/README.md", "What is exact, and what is not promised"),
            "## How it is measured in the tests\n",
            "Against refinement, closed forms or exact numbers in floats of 256 bits; tests fail where a result is farther from them than "
            "said above.\n",
            "| file | |\n|---|---|", *truths,
            "\n## How it was measured beside others\n", measured]
    if measured.count("\n|") < 3 or not truths:
        site.errors.append("exact: no errors were measured, or no test has the truth")
    page = DOCS / "exact.md"
    site.write(page, site.linked(page, "\n".join(text) + "\n"))


def python_page(site: Site) -> None:
    """Public names of the module and their docstrings, read without importing it."""
    folder = site.root / "stencils/python/sublimit"
    text = ["# Python reference\n", "What `import sublimit` has, by its own docstrings. First steps: "
            "[sublimit for Python](../python/README.md).\n"]

    def doc(node) -> str:
        told = ast.get_docstring(node)
        return "\n```text\n" + told + "\n```\n" if told else ""

    def signature(node: ast.FunctionDef) -> str:
        returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        return f"{node.name}({ast.unparse(node.args)}){returns}"

    public = set(re.findall(r"from \.\w+ import (\w+) as", (folder / "__init__.py").read_text()))
    for path in sorted(folder.glob("*.py")):
        if path.name == "__init__.py":
            continue
        is_open = not path.name.startswith("_")  # sublimit.torch: all that it has
        tree = ast.parse(path.read_text())
        section = []
        for node in tree.body:
            if any("overload" in ast.unparse(decorator) for decorator in getattr(node, "decorator_list", [])):
                continue  # for checkers of types; the function itself follows
            if isinstance(node, ast.FunctionDef) and (node.name in public or is_open and node.name[0] != "_"):
                section.append(f"### `{node.name}`\n\n```python\n{signature(node)}\n```\n{doc(node)}")
                if not ast.get_docstring(node):
                    site.errors.append(f"{path.relative_to(site.root)}:{node.lineno}: {node.name} has no docstring")
            elif isinstance(node, ast.ClassDef) and (node.name in public or is_open and node.name[0] != "_"):
                section.append(f"### `class {node.name}`\n{doc(node)}")
                for member in node.body:
                    if isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
                        section.append(f"```python\n{node.name}.{signature(member)}\n```\n{doc(member)}")
        if section:
            title = (ast.get_docstring(tree) or path.stem).split("\n")[0].rstrip(".")
            text.append(f"## {api.escaped(title)}\n")
            text += section
    site.write(DOCS / "python_reference.md", "\n".join(text))


def check_undocumented(site: Site, found: dict[str, list[str]]) -> None:
    """No room has more functions without a text than are allowed to it: the numbers may only fall."""
    allowed = json.loads((site.root / DOCS / "undocumented.json").read_text())
    for room, names in found.items():
        if len(names) > allowed.get(room, 0):
            site.errors.append(f"{room}: {len(names)} functions have no text, {allowed.get(room, 0)} are allowed "
                               f"(stencils/docs/undocumented.json):\n  " + "\n  ".join(names))
    for room, most in allowed.items():
        if most > len(found.get(room, [])):
            site.errors.append(f"stencils/docs/undocumented.json: {room} has only {len(found.get(room, []))} left: lower its "
                               f"number from {most}")


def make_pictures(root: pathlib.Path, build: pathlib.Path, program: str) -> None:
    """Makes the pictures of written pages, which these know as pictures/NAME.svg; the gallery is there already."""
    pictures, data = build / "pictures", root / "stencils/gallery"
    pictures.mkdir(exist_ok=True)

    def run(*arguments: str | pathlib.Path) -> None:
        subprocess.run([program, *map(str, arguments), "--quiet"], check=True, stdout=subprocess.DEVNULL)

    shutil.copyfile(build / "gallery/overview.svg", pictures / "schemes.svg")
    shutil.copyfile(build / "gallery/patches.svg", pictures / "patches.svg")
    run("demo", build / "demo")
    run("analyze", build / "demo/control.obj", "-s", "catmull-clark", "--picture", pictures / "smoothness.svg")
    run("fit", data / "fit.obj", "--targets", data / "fit.csv", "-s", "catmull-clark", "-o", build / "fitted.obj",
        "--picture", pictures / "fit.svg")
    run("fit", data / "curvatures.obj", "--targets", data / "curvatures.csv", "-s", "torus-pieces", "-l", "3", "-o",
        build / "curved.obj", "--picture", pictures / "curvatures.svg")


def main() -> int:
    parser = argparse.ArgumentParser(description="Makes the site of the manual.")
    for name in ("source", "build", "program", "sphinx", "doxygen", "version"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--names", action="store_true", help="only read the docstrings")
    told = parser.parse_args()
    root, build = pathlib.Path(told.source).resolve(), pathlib.Path(told.build).resolve()
    build.mkdir(parents=True, exist_ok=True)

    site, xml = Site(root, build), build / "doxygen"
    xml.mkdir(exist_ok=True)
    settings = (root / DOCS / "Doxyfile").read_text()
    settings += "INPUT = " + " ".join(f'"{root / f / "sublimit"}"' for f in ("lib", "eval", "stencils")) + "\n"
    settings += f'OUTPUT_DIRECTORY = "{xml}"\n'
    doxygen = subprocess.run([told.doxygen, "-"], input=settings, text=True, capture_output=True, check=False, cwd=xml)
    if doxygen.returncode != 0 or doxygen.stderr:
        site.errors.append(doxygen.stderr)
    rooms, missing = api.write(xml / "xml", root, site.pages / "api")
    check_undocumented(site, missing)
    python_page(site)
    if site.errors or told.names:
        print("\n".join(site.errors), file=sys.stderr)
        return 1 if site.errors else 0

    def run(*command: str, **more) -> str:
        return subprocess.run(command, check=True, text=True, **more).stdout

    reference, gallery = build / "reference", build / "gallery"
    run(told.program, "--generate", "markdown", str(reference))
    stamp = build / "computed"  # schemes take a minute: only where the program is newer
    is_new = stamp.exists() and stamp.stat().st_mtime >= os.stat(told.program).st_mtime
    if not is_new or not (build / "pictures").exists():
        run(told.program, "schemes", "--gallery", str(gallery), "--gallery-faces", "600", "--quiet", stdout=subprocess.DEVNULL)
        run(told.program, "analyze", "-s", "all", "--valence", "3-7", "-o", str(build / "schemes.html"), "--json",
            str(build / "schemes.json"), "--quiet", stdout=subprocess.DEVNULL)
        make_pictures(root, build, told.program)
        stamp.touch()
    shutil.copytree(build / "pictures", site.pages / DOCS / "pictures")
    schemes = json.loads(run(told.program, "schemes", "--json", stdout=subprocess.PIPE))
    site.gather(reference)
    scheme_index = scheme_pages(site, schemes, json.loads((build / "schemes.json").read_text()), gallery)
    tested_page(site)
    exact_page(site)
    docs = str(DOCS)
    others = [str(p.with_suffix("")) for p in sources(root, "*.md")]
    verbs = sorted(str(p.relative_to(site.pages).with_suffix("")) for p in (site.pages / DOCS / "verbs").glob("*.md"))
    listed = ["README", f"{docs}/tour", *[f"{docs}/guides/{g}" for g in GUIDES], f"{docs}/program", f"{docs}/reference",
              f"{docs}/meshes", f"{docs}/curves", f"{docs}/recipes", *verbs, "eval/table_format", "stencils/report_format",
              "stencils/fit_format", "stencils/python/README", "lib/README", "bench/README", "CHANGELOG"]
    site.write("api/index.md", "# C++ and C\n\nBy room, from the headers.\n\n" + site.toctree("API", rooms))
    site.write("rooms.md", "# Rooms\n\nThe README of each folder of the sources.\n\n" +
               site.toctree("Rooms", [n for n in others if n not in listed]))
    site.write("index.md", "# sublimit\n\nSubdivision surfaces as sparse matrices, and their exact limits. Begin with "
               f"[five minutes]({docs}/tour.md).\n\n" +
               site.toctree("Begin", ["README", f"{docs}/tour"]) +
               site.toctree("I have a cage and want ...", [f"{docs}/guides/{g}" for g in GUIDES]) +
               site.toctree("The program", [f"{docs}/program", f"{docs}/reference", f"{docs}/meshes", f"{docs}/curves",
                                            f"{docs}/recipes"]) +
               site.toctree("Subcommands", verbs) + site.toctree("Schemes", scheme_index) +
               site.toctree("Formats", ["eval/table_format", "stencils/report_format", "stencils/fit_format"]) +
               site.toctree("Libraries", ["lib/README", "stencils/python/README", f"{docs}/python_reference", "api/index",
                                          "rooms"]) +
               site.toctree("How good it is", [f"{docs}/exact", f"{docs}/tested", "bench/README", "CHANGELOG"]))
    shutil.copyfile(root / DOCS / "conf.py", site.pages / "conf.py")
    shutil.copytree(root / DOCS / "static", site.pages / "_static", dirs_exist_ok=True)
    if site.errors:
        print("\n".join(site.errors), file=sys.stderr)
        return 1
    environment = {**os.environ, "SUBLIMIT_VERSION": told.version, "LC_ALL": "C.UTF-8"}
    made = subprocess.run([told.sphinx, "-W", "--keep-going", "-q", "-b", "html", "-d", str(build / "doctrees"),
                           str(site.pages), str(build / "site")], env=environment, check=False)
    return made.returncode


if __name__ == "__main__":
    sys.exit(main())
