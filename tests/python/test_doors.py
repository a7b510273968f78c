# SPDX-License-Identifier: Apache-2.0
"""One set of words at three doors: verbs of the program are functions of C++ and Python, options fields and arguments.

What a door lacks or calls otherwise stands in a table here, with the reason. A row that is not needed is an error too.
"""
from __future__ import annotations

import inspect
import os
import pathlib
import re
import subprocess
import tempfile
from functools import lru_cache
from typing import NamedTuple, Optional

import pytest

import sublimit

SOURCE = pathlib.Path(__file__).resolve().parents[2]
DOORS = ("program", "cpp", "python")


class Row(NamedTuple):
    """What one thing is called at each door, with a space between where it is several; None where a door has none.

    In C++ and Python `Type.name` is a member of another type, and `name()` a function.
    """

    verb: str  # "*": any
    program: Optional[str]
    cpp: Optional[str]
    python: Optional[str]
    why: str

    def at(self, door: str) -> set[str]:
        return set((getattr(self, door) or "").split())


# Verbs, and the functions that are not called as they are. A type stands for what makes it.
VERBS = [
    Row("refine", "refine", "refine", "refine refine_curve",
        "in C++ polygons are refined by the schemes of curves, curves/curve_refine.h"),
    Row("sample", "sample", "LimitSurface LimitSurface::evaluate", "LimitSurface LimitSurface.evaluate",
        "a surface is made once and evaluated again and again"),
    Row("closest", "closest", "LimitSurface closest", "LimitSurface closest", "the surface is an argument"),
    Row("intersect", "intersect", "LimitSurface intersect", "LimitSurface intersect", "the surface is an argument"),
    Row("step", "step", "LimitSurface step", "LimitSurface step", "the surface is an argument"),
    Row("apply", "apply", "Table::apply", "Table.apply", "a table is loaded once and applied every frame"),
    Row("analyze", "analyze", "analyze", "analyze analyze_mesh", "Python has no overloads"),
    Row("fit", "fit", "fit fit_places fit_cloud", "fit fit_places fit_cloud",
        "the header of a file says which of them it is for"),
    Row("devices", "devices", None, "gpu_devices", "in C++ of the component eval_gpu, eval/gpu/gpu_evaluator.h"),
    Row("verify", "verify", None, None, "a verdict for people; `load` checks what it reads"),
    Row("export", "export", None, None, "for programs that link nothing of this; Python has Table.matrix"),
    Row("demo", "demo", None, None, "files to begin with"),
    Row("help", "help", None, None, "docstrings are the help of functions"),
    Row("load", None, "load", "load", "the program names tables by their files"),
    Row("read", None, "read_mesh", "read",
        "the program names meshes by their files; reading into a module needs no second word"),
    Row("write", None, "write_mesh", "Mesh.write", "the program has --output"),
    Row("make_mesh", None, "make_mesh", "Mesh", "the program reads meshes; in Python a class makes what it is"),
    Row("levels", None, "levels", "levels", "a level each, with its matrix: the program is run for each level"),
    Row("subdivision_matrix", None, "subdivision_matrix", "subdivision_matrix", "the program has `refine --matrix`"),
    Row("scheme", None, "AnyScheme", "scheme", "the program has --scheme and --option"),
    Row("version", None, "version", "version", "the program has --version"),
    Row("limit_cache", None, "limit_cache", None, "what is found is shared between meshes; Python finds it for each"),
    Row("refined_mesh", None, "refined_mesh level_mesh remaining_tags", None,
        "of one's own levels: `refine` is made of them"),
    Row("evaluate", None, "evaluate", None, "curves of schemes without a matrix: the program has `sample`"),
    Row("implicit_mesh", None, "implicit_mesh polygonize", None, "`implicit` is made of them"),
    Row("place_rows", None, "place_rows", None, "LimitSurface.stencils has them"),
    Row("cubic_bspline_creases", None, "cubic_bspline_creases", None,
        "in Python a scheme of one's own has them already"),
    Row("exit_status", None, "exit_status", None, "what the program does with the code of an error"),
    Row("name", None, "name", "RayHits.kinds", "words of an enumerator"),
    Row("check_output", None, "check_output", None, "for writers of other formats"),
    Row("jobs", None, "mesh_info limit_integrals", None, "`info` is made of them"),
    Row("throw_not_three", None, "throw_not_three", None, "of templates in headers"),
]

# Options, fields and arguments, by verb.
WORDS = [
    # Of every verb.
    Row("*", "output", None, None, "functions return what they make"),
    Row("*", "help", None, None, "docstrings are the help of functions"),
    Row("*", "quiet", None, None, "warnings on a terminal"),
    Row("*", "threads", None, "threads", "C++ takes those of oneTBB, tbb::global_control"),
    Row("*", "mem_limit", None, None, "of a process of its own"),
    Row("*", "json", None, None, "results are data"),
    Row("*", "report", None, None, "results are data"),
    Row("*", "format", None, None, "standard input and output are files of the shell"),
    Row("*", "picture", None, None, "for people who look at files"),
    Row("*", None, "progress", None, "the program shows it on a terminal"),
    # Meshes and schemes.
    Row("*", "boundary", "Mesh.boundary", "boundary", "C++ has rules in the mesh"),
    Row("*", "creasing", "Mesh.creasing", "creasing", "C++ has rules in the mesh"),
    Row("*", "triangles", "Mesh.triangles", "triangles", "C++ has rules in the mesh"),
    Row("*", "face_varying", "Mesh.face_varying_interpolation", "face_varying", "C++ has rules in the mesh"),
    Row("*", "face_varying", None, None, "texture coordinates of files, where the output has room for them"),
    Row("*", "attributes", "Mesh.attributes", "attributes", "C++ has rules in the mesh"),
    Row("*", "attributes", None, None, "values at vertices of files, where the output has room for them"),
    Row("*", "orient crease_angle crease_smoothing_groups", None, "orient crease_angle crease_smoothing_groups",
        "C++ changes the mesh first, by mesh/tagging.h"),
    Row("*", "sidecar", None, "read()", "of files, which functions of C++ and Python do not take"),
    Row("*", "option", "AnyScheme.AnyScheme", "option", "C++ has options in the scheme"),
    Row("*", "no_creases", "Mesh.creases Mesh.corners", "no_creases", "C++ clears the fields"),
    Row("*", "strict", "MeshInfo.faults", "strict", "C++ asks `info`"),
    Row("*", "triangulate", None, "triangulate", "C++ has no public function for it"),
    Row("analyze", None, "Mesh.boundary Mesh.creasing Mesh.triangles",
        "boundary creasing triangles no_creases strict triangulate orient crease_angle crease_smoothing_groups",
        "of meshes; the program takes the mesh as it is"),
    Row("*", None, "cache", None, "Python and the program make one a call"),
    # Verb by verb.
    Row("refine", "quiet", "Mesh.warnings", "quiet", "warnings of Python; C++ has them in the result"),
    Row("refine", "matrix", "subdivision_matrix()", "subdivision_matrix()", "a result of its own"),
    Row("refine", "no_tags", "Mesh.creases", "no_tags", "C++ clears the fields"),
    Row("refine", "closed", None, "closed", "C++: ControlPolygon says it of each curve"),
    Row("refine", None, None, "points", "of polygons; the program reads them from MESH"),
    Row("limit", "closed", None, "LimitCurve()", "of polygons, which have a class of their own"),
    Row("limit", "normals", "Limit.normals", "Limit.normals", "always there"),
    Row("info", "threads", None, None, "counting takes no time"),
    Row("info", "boundary creasing triangles option triangulate no_creases strict orient crease_angle crease_smoothing_groups",
        "Mesh.boundary Mesh.creasing Mesh.triangles AnyScheme.AnyScheme", None,
        "Python tells of the mesh and its own rules"),
    Row("sample", "at", "places", "face u v", "arrays as NumPy has them; C++ has a list of places"),
    Row("sample", "grid", "LimitSurface.grid", None, "NumPy makes grids"),
    Row("sample", "random seed clamp", None, None, "places are made by the caller"),
    Row("sample", "explain", "LimitSurface.explain", "LimitSurface.explain", "of one place, nothing is written"),
    Row("sample", "curvature", "curvature()", "Samples.curvature", "of samples that exist"),
    Row("sample", "closed", "LimitCurve.LimitCurve", "LimitCurve()", "of polygons, which have a class of their own"),
    Row("sample", "curves", "Construction.curves", "Construction.curves", "of what `construct` makes"),
    Row("sample", None, "normals", None, "what is not wanted takes no time"),
    Row("closest", "signed", "is_signed", "signed", "a keyword of C++"),
    Row("closest", None, "guess most_cells prove", None, "to save time where each microsecond counts"),
    Row("closest", None, "patches", None, "Python has one argument for both"),
    Row("intersect", "rays", "rays", "origins directions tmin tmax",
        "arrays as NumPy has them; C++ has a list of rays"),
    Row("intersect", None, "patches", None, "Python has one argument for both"),
    Row("tessellate", None, "patches", None, "patches with their control points, as `Patches.tessellate` of Python"),
    Row("tessellate", "face_ids", "Mesh.face_ids", "Mesh.face_ids", "always there"),
    Row("tessellate", "places", "Tessellation.places", "Tessellation.face",
        "always there, in the tessellation of a surface"),
    Row("flatten", None, "relative_chord", "relative_chord", "the shell has percentages, --chord 0.1%"),
    Row("flatten", None, "path", "path", "the program has --output"),
    Row("flatten", None, "scene", "scene", "the program has SCENE as an argument"),
    Row("step", "no_packing", "pack", "pack", "a flag of the shell can only be set"),
    Row("step", None, "face_names", "face_names", "the program has those of the file"),
    Row("step", None, "face_values", None, "colours: the program has those of the file; Python writes names alone"),
    Row("step", None, "path", "path", "the program has --output"),
    Row("step", None, "patches", None, "Python has one argument for both"),
    Row("bake", "tessellation", "face_sizes face_vertices", "tessellation",
        "C++ takes the faces between any places"),
    Row("bake", "precision", "in_double", "precision", "a word of the shell and of Python, float or double"),
    Row("bake", "tags", None, None, "for files that `apply` writes"),
    Row("bake", "manifest shard log plan", None, None, "many jobs of a shell"),
    Row("bake", "dictionary", None, None, "a file that is kept from run to run"),
    Row("bake", None, "patches", "Patches.bake", "the program tells them by their file"),
    Row("bake", None, "order", "order", "`refine` of the program writes points in that order"),
    Row("construct", None, "recipe", "recipe", "the program has RECIPE as an argument"),
    Row("implicit", "at", None, None, "values of a field, which is no mesh"),
    Row("implicit", None, "field", "field", "the program has FIELD as an argument"),
    Row("apply", "frames", None, None, "of files and sequences of them; arrays are cut by the caller"),
    Row("apply", "gpu device", None, "device", "in C++ of the component eval_gpu"),
    Row("apply", "any_cage", None, None, "arrays have no faces to compare"),
    Row("apply", None, "points", "points", "the program has POINTS as an argument"),
    Row("apply", None, "channels result", "out", "spans have no shape"),
    Row("apply", None, None, "weights", "of rational tables, instead of a last column"),
    Row("analyze", "valence", "valences", "valences", "a list where the shell has a range"),
    Row("analyze", "claim", "claims", "claims", "a list where the shell repeats the option"),
    Row("analyze", "mask sweep export", None, None, "pages and files for people"),
    Row("analyze", None, "exact", "Scheme()", "a class of masks is in both numbers in Python"),
    Row("analyze", None, "name", "name", "the program has the name of the file"),
    Row("fit", "targets cloud", "targets cloud", "vertices face u v points normals weights",
        "arrays as NumPy has them"),
    Row("fit", "thin_plate membrane", "fairness", "thin_plate membrane", "one struct of C++, Fairness"),
    Row("fit", "pin", "pins", "pins", "a list where the shell has one word"),
    Row("fit", "refine", "least_refinements most_refinements", "refinements",
        "the shell has a number or auto, Python a pair"),
    Row("fit", "method", "solver", None, "one struct of C++, FitSolverOptions"),
    Row("fit", "no_rank", "conditioning", None, "of reports"),
    Row("fit", "best_effort", "Fit.solved", "Fit.solved", "a fit that misses its targets is a result"),
    Row("fit", "samples seed", None, None, "a cloud is made by the caller"),
    Row("fit", "construct size", None, None, "polygons through the targets, which solve nothing"),
    Row("fit", "levels", None, None, "of torus-pieces, which has no matrix"),
    Row("fit", None, "guess", None, "control points, or patches with theirs, that a fit starts from: MESH of the program"),
    Row("fit", None, "schedule", "schedule", "a list, which falls from iteration to iteration"),
    Row("fit", None, "tolerance", "tolerance", "the program has --iterations"),
    Row("fit", None, "tangential", None, "for code that knows the method"),
    Row("schemes", "gallery gallery_faces threads", None, None, "a folder of pictures"),
]


class Headers:
    """What the headers declare that sublimit.h leads to: functions, by their arguments, and fields of structs."""

    def __init__(self) -> None:
        self.functions: dict[str, list[str]] = {}  # "Type::name" of members
        self.fields: dict[str, set[str]] = {}
        read: set[str] = set()
        files = ["sublimit/sublimit.h"]
        for depth in range(4):
            found: list[str] = []
            for name in files:
                text = self._file(name).read_text()
                found += re.findall(r'#include "(sublimit/[^"]+)"', text)
                self._declarations(_plain(text), "")
            read |= set(files)
            files = [name for name in dict.fromkeys(found) if name not in read and "/detail/" not in name]
            if depth == 1:  # what these include are parts, and functions of lower floors
                first = {name: list(arguments) for name, arguments in self.functions.items()}
        self.functions = {name: first.get(name, arguments) for name, arguments in self.functions.items()}
        self.first = {name for name in first if "::" not in name and name != "requires"}

    @staticmethod
    def _file(name: str) -> pathlib.Path:
        return next(SOURCE / floor / name for floor in ("stencils", "lib", "eval") if (SOURCE / floor / name).exists())

    def _declarations(self, text: str, scope: str) -> None:
        while found := re.search(r"\b(?:struct|class)\s+(\w+)[^;{}()=]*\{", text):
            end = _closing(text, found.end() - 1)
            self.fields.setdefault(found[1], set())
            self._declarations(text[found.end():end], f"{found[1]}::")
            text = text[:found.start()] + text[end + 1:]
        while (shorter := re.sub(r"\{[^{}]*\}", ";", text)) != text:  # bodies of functions
            text = shorter
        for statement in text.split(";"):
            declared, _, _ = statement.partition("=")
            if "(" in declared:
                head = re.match(r"(.*?)(\w+) ?\((.*)", " ".join(statement.split()))
                if head and not head[1].endswith(("return ", "~")):
                    self.functions.setdefault(scope + head[2], []).append(_arguments(head[3]))
                continue
            field = re.match(r"\s*(?:const |static |constexpr |mutable )*[\w:]+[\s*&]+(\w.*)", statement, re.S)
            if scope and field:
                self.fields[scope[:-2]] |= set(re.findall(r"(\w+)\s*(?:=[^,]*)?(?:,|$)", field[1].strip()))

    def words(self, function: str) -> set[str]:
        """Names of the arguments, with the fields of options instead of these."""
        words = set()
        for arguments in self.functions[f"{function}::{function}" if function in self.fields else function]:
            if re.search(r"\b(LimitMap|PartedSurface|LinearSource|LimitSamples)\b", arguments):
                continue  # of lower floors
            for argument in filter(None, (part.partition("=")[0].strip() for part in arguments.split(","))):
                options = re.search(r"\b(\w+Options)\b", argument)
                words |= self.fields[options[1]] if options else set(re.findall(r"[\s&*](\w+)$", argument))
        return words

    def has(self, word: str) -> bool:
        """Whether there is a member `Type.name` or a function `name()`."""
        owner, _, member = word.rpartition(".")
        if not owner:
            return word.removesuffix("()") in self.functions
        return member in self.fields.get(owner, set()) or f"{owner}::{member}" in self.functions


def _plain(text: str) -> str:
    """Without comments, texts, attributes, defaults in braces and arguments of templates."""
    text = re.sub(r'"(\\.|[^"\\])*"', '""', re.sub(r"//.*", "", text))
    text = re.sub(r"\[\[\w+\]\]|\bnamespace \w+ \{|^#.*$|\b(public|private|protected):", "", text, flags=re.M)
    text = re.sub(r"=\s*\{[^{}]*\}", "= 0", text)
    while (shorter := re.sub(r"<[\w:,\s*&().]*>", "", text)) != text:
        text = shorter
    return text


def _closing(text: str, opening: int) -> int:
    """Where the brace is closed that is opened here."""
    depth = 0
    for i in range(opening, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return i
    raise AssertionError("a brace is not closed")


def _arguments(text: str) -> str:
    """What stands before the parenthesis that closes the list."""
    depth = 1
    for i, letter in enumerate(text):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if depth == 0:
            return text[:i]
    return text


@lru_cache(maxsize=None)
def headers() -> Headers:
    return Headers()


@lru_cache(maxsize=None)
def options_of_the_program() -> dict[str, frozenset[str]]:
    """Options of each verb, from the completion that the program writes for bash."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.environ["SUBLIMIT_PROGRAM"], "--generate", "bash", folder], check=True)
        (file,) = pathlib.Path(folder).iterdir()
        verbs = re.findall(r"^    ([a-z]+)\)\n      options='([^']*)'", file.read_text(), re.M)
    return {verb: frozenset(name[2:].replace("-", "_") for name in names.split() if name.startswith("--"))
            for verb, names in verbs}


def thing_of_python(name: str) -> object:
    thing: object = sublimit
    for part in name.removesuffix("()").split("."):
        thing = getattr(thing, part)
    return thing


def arguments_of_python(function: str) -> set[str]:
    thing = thing_of_python(function)
    assert callable(thing)
    return set(inspect.signature(thing).parameters)


def functions_of_python() -> set[str]:
    return {name for name in sublimit.__all__ if inspect.isfunction(getattr(sublimit, name))}


def functions_of(verb: str) -> Row:
    named = [row for row in VERBS if row.program == verb]
    return named[0] if named else Row(verb, verb, verb, verb, "")


Words = dict[str, set[str]]  # by door


def words_of(verb: str) -> Words:
    """What there is of a verb at each door, but for the mesh, the surface and the scheme, which all begin with."""
    row = functions_of(verb)
    words = {
        "program": set(options_of_the_program()[verb]),
        "cpp": set().union(*(headers().words(function) for function in row.at("cpp"))),
        "python": set().union(*(arguments_of_python(function) for function in row.at("python"))),
    }
    return {door: found - {"mesh", "surface", "scheme", "self"} for door, found in words.items()}


def everywhere(words: Words) -> set[str]:
    return words["program"] & words["cpp"] & words["python"]


def is_there(door: str, word: str, words: Words) -> bool:
    """Whether a row's word is one of the verb, or another thing that there is."""
    if "." not in word and "()" not in word:
        return word in words[door]
    if door == "cpp":
        return headers().has(word)
    try:
        thing_of_python(word)
    except AttributeError:  # of instances alone, as docstrings list them
        owner, _, member = word.rpartition(".")
        listed = inspect.getdoc(thing_of_python(owner)) or ""
        return bool(re.search(rf"^\s*([\w, ]+, )?{member}[,\w ]* : ", listed, re.M))
    return True


def applies(row: Row, words: Words) -> bool:
    """Whether what a row says of a verb is so: doors have its words, and a door without any has none of the others'."""
    own = {word for door in DOORS for word in row.at(door) if "." not in word and "()" not in word}
    for door in DOORS:
        if not all(is_there(door, word, words) for word in row.at(door)):
            return False
        if not row.at(door) and own & words[door]:
            return False
    return True


VERBS_WITH_FUNCTIONS = [verb for verb in sorted(options_of_the_program())
                        if functions_of(verb).at("cpp") or functions_of(verb).at("python")]


def test_every_verb_is_a_function_of_all() -> None:
    assert len(options_of_the_program()) > 15
    there = {"program": set(options_of_the_program()), "cpp": headers().first, "python": functions_of_python()}
    for door, found in there.items():
        others = set.intersection(*(names for other, names in there.items() if other != door))
        known = set().union(*(row.at(door) for row in VERBS))
        unknown = found - others - known
        assert not unknown, f"{door} has {sorted(unknown)}: the other doors do not; VERBS should say why"


@pytest.mark.parametrize("row", VERBS, ids=[row.verb for row in VERBS])
def test_what_is_said_of_verbs_is_so(row: Row) -> None:
    assert row.at("program") <= set(options_of_the_program()), row
    for function in row.at("cpp"):
        declared = headers().functions
        assert function in declared or f"{function}::{function}" in declared, f"C++ has no {function}"
    for function in row.at("python"):
        assert is_there("python", f"{function}()", {}), f"Python has no {function}"
    assert row.why and len({frozenset(row.at(door)) for door in DOORS}) > 1, f"{row.verb} is the same at each door"
    if row.program:
        for door in ("cpp", "python"):
            assert row.at(door) or row.program not in (headers().first if door == "cpp" else functions_of_python()), row


@pytest.mark.parametrize("verb", VERBS_WITH_FUNCTIONS)
def test_every_option_is_a_field_and_an_argument(verb: str) -> None:
    words = words_of(verb)
    rows = [row for row in WORDS if row.verb in ("*", verb) and applies(row, words)]
    for door, found in words.items():
        unknown = found - everywhere(words) - set().union(*(row.at(door) for row in rows))
        assert not unknown, f"{verb} at the door {door} has {sorted(unknown)}: the others do not; WORDS should say why"


@pytest.mark.parametrize("row", WORDS, ids=[f"{row.verb}: {row.program or row.cpp or row.python}" for row in WORDS])
def test_what_is_said_of_words_is_so(row: Row) -> None:
    """Each row tells of words that are not those of every door."""
    verbs = VERBS_WITH_FUNCTIONS if row.verb == "*" else [row.verb]
    told = [verb for verb in verbs if applies(row, words_of(verb))]
    assert row.why and told, f"{row.verb} is not so: {row}"
    own = {word for door in DOORS for word in row.at(door)}
    assert any(not own & everywhere(words_of(verb)) for verb in told), f"not needed any more: {row}"
