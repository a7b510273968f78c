# SPDX-License-Identifier: Apache-2.0
"""Control meshes."""
from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _arrays as arrays
from . import _sublimit
from ._errors import InvalidMesh, InvalidParameter
from ._schemes import Scheme, request

Points = npt.ArrayLike
"""Points of a mesh: (vertices, 3), real numbers."""


class Mesh:
    """A mesh: points, faces of any size, tags, and what vertices and faces carry. It never changes.

    Parameters
    ----------
    points : (vertices, 3), real numbers
    faces : (faces, 3) or (faces, 4) integers; or a list of lists; or ``(sizes, corners)``, the number of corners of each
        face and the vertices of all faces, face by face. Vertices count from 0, counter-clockwise in each face.
    creases : {(tail, head): sharpness}, rows (tail, head, sharpness) or two arrays ``(edges, sharpness)``, optional
        Sharpness of edges in levels, >= 0; 10 or more is infinite: the edge stays sharp on all levels.
    corners : {vertex: sharpness}, rows (vertex, sharpness) or two arrays ``(vertices, sharpness)``, optional
        Sharpness of vertices, in the same unit.
    holes : (holes,), numbers of faces that are refined but are not part of the limit, optional
    boundary : ``"none"``, ``"edge-only"`` or ``"edge-and-corner"``, optional
        Rule for the boundary (default: edge-and-corner). ``"none"``: faces that touch it are holes; ``"edge-only"``: its edges
        are sharp; ``"edge-and-corner"``: its edges are sharp, and vertices of a single face are corners.
    uv : (values, 1 to 3), optional
        Texture coordinates: one for each vertex, one for each corner, or values that `uv_faces` refers to.
    uv_faces : number of the value in `uv` for each corner, in the form of `faces` or as a flat array, optional
    normals : (normals, 3), optional
        One for each vertex, one for each corner, or normals that `face_normals` refers to. They are read from and written to
        files; schemes ignore them.
    face_normals : number of the normal in `normals` for each corner, -1 for none, in the form of `uv_faces`, optional
    face_ids : (faces,), a number for each face, optional
    face_names : another name of `groups`, optional; as an attribute, the group of each face, else its object
    groups, objects, materials, smoothing_groups : list of str, a name for each face, empty for none, optional
        Lines ``g``, ``o``, ``usemtl`` and ``s`` of an .obj. Groups are names of faces in a STEP file, too.
    material_files : list of str, files of the materials, optional
        Lines ``mtllib`` of an .obj.
    vertex_values : {name: (vertices,)}, real numbers, optional
        Properties of vertices in a .ply. Colours are ``"red"``, ``"green"``, ``"blue"`` and ``"alpha"``: 0 to 255 if their type
        is uint8, 0 to 1 otherwise; an .obj has colours too. Files keep integers of 8, 16 and 32 bits, float32 and float64; other
        types become float64.
    face_values : {name: (faces,)}, the same for faces, optional

    A mesh has all of these as attributes, in a form that the constructor accepts. `with_points` changes the points and keeps
    the rest. Refined meshes and triangles carry names and values on, as `refine` says.

    Raises
    ------
    InvalidMesh
        An array of another shape or type, NaN and infinite points, faces or tags that name vertices or faces that do not
        exist, faces of two corners, names or values that are not one for each face or vertex, both `groups` and `face_names`.

    Examples
    --------
    >>> import sublimit
    >>> triangle = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], corners={0: 10})
    >>> triangle
    <sublimit.Mesh: 3 vertices, 1 faces>
    >>> triangle.faces
    (array([3], dtype=int32), array([0, 1, 2], dtype=int32))
    >>> sublimit.Mesh(2 * triangle.points, triangle.faces, corners=triangle.corners)
    <sublimit.Mesh: 3 vertices, 1 faces>
    >>> hot = sublimit.Mesh(triangle.points, triangle.faces, materials=["iron"], vertex_values={"heat": [0, 2, 4]})
    >>> fine = sublimit.refine(hot, "bilinear")
    >>> fine.vertex_values["heat"], fine.materials
    (array([0., 2., 4., 2., 1., 3., 2.]), ['iron', 'iron', 'iron'])
    """

    __module__ = "sublimit"
    __slots__ = ("_core", "__weakref__")
    _core: _sublimit.Mesh

    def __init__(self, points: Points, faces: Any, *, creases: Mapping[tuple[int, int], float] | Iterable[Any] | None = None,
                 corners: Mapping[int, float] | Iterable[Any] | None = None, holes: npt.ArrayLike | None = None,
                 boundary: str | None = None, uv: npt.ArrayLike | None = None, uv_faces: Any = None,
                 normals: npt.ArrayLike | None = None, face_normals: Any = None, face_ids: npt.ArrayLike | None = None,
                 face_names: Iterable[str] | None = None, groups: Iterable[str] | None = None,
                 objects: Iterable[str] | None = None, materials: Iterable[str] | None = None,
                 smoothing_groups: Iterable[str] | None = None, material_files: Iterable[str] | None = None,
                 vertex_values: Mapping[str, npt.ArrayLike] | None = None,
                 face_values: Mapping[str, npt.ArrayLike] | None = None) -> None:
        try:
            positions = arrays.floats(points, "points", (None, 3), "(vertices, 3)")
            sizes, vertices = arrays.faces(faces)
            if uv is None and uv_faces is not None:
                raise InvalidMesh("uv_faces says which values corners have, but there is no uv")
            if normals is None and face_normals is not None:
                raise InvalidMesh("face_normals says which normals corners have, but there are no normals")
            if groups is not None and face_names is not None:
                raise InvalidMesh("face_names is another name of groups; give one of them")
            names = ((groups, "groups") if face_names is None else (face_names, "face_names"), (objects, "objects"),
                     (materials, "materials"), (smoothing_groups, "smoothing_groups"))
            of_groups, of_objects, of_materials, of_smoothing = (names_of(given, len(sizes), name) for given, name in names)
            self._core = _sublimit.Mesh(
                positions, sizes, vertices, _creases(creases), _corners(corners),
                arrays.ints([] if holes is None else holes, "holes", (None,), "(holes,)"), boundary,
                None if uv is None else _channel(uv, uv_faces, sizes, vertices, len(positions)),
                None if normals is None else _normals(normals, face_normals, sizes, vertices, len(positions)),
                arrays.ints([] if face_ids is None else face_ids, "face_ids", (None if face_ids is None else len(sizes),),
                            f"({len(sizes)} faces,)"),
                ((of_groups, of_objects, of_materials, of_smoothing), names_of(material_files, None, "material_files"),
                 _value_rows(vertex_values, "vertex_values", len(positions), "vertices"),
                 _value_rows(face_values, "face_values", len(sizes), "faces")))
        except InvalidParameter as error:  # a constructor of meshes raises InvalidMesh for all that is wrong with one
            raise InvalidMesh(str(error)) from None

    @classmethod
    def _of(cls, core: _sublimit.Mesh) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._core = core
        return mesh

    @property
    def points(self) -> arrays.Floats:
        """Positions of the vertices, (vertices, 3), read-only."""
        return self._core.points

    @property
    def faces(self) -> tuple[arrays.Ints, arrays.Ints]:
        """``(sizes, corners)``: number of corners of each face, and the vertices of all faces, face by face. Read-only."""
        return self._core.sizes, self._core.corners

    @property
    def face_array(self) -> arrays.Ints:
        """Vertices of the faces, (faces, corners of each), if all faces have the same size. Read-only.

        Raises
        ------
        InvalidParameter
            The mesh has no faces, or faces of different sizes.
        """
        sizes, vertices = self.faces
        if len(sizes) == 0 or (sizes != sizes[0]).any():
            raise InvalidParameter(f"faces have {sorted(set(sizes.tolist()))} corners; faces of one size make an array")
        return vertices.reshape(len(sizes), int(sizes[0]))

    @property
    def creases(self) -> tuple[arrays.Ints, arrays.Floats32]:
        """``(edges, sharpness)`` of the creases: (creases, 2), the vertices of each, and (creases,), in levels."""
        return self._core.creases

    @property
    def corners(self) -> tuple[arrays.Ints, arrays.Floats32]:
        """``(vertices, sharpness)`` of the sharp vertices: (corners,) each, sharpness in levels."""
        return self._core.sharp_vertices

    @property
    def holes(self) -> arrays.Ints:
        """Numbers of the faces that are refined but are not part of the limit, (holes,)."""
        return self._core.holes

    @property
    def boundary(self) -> str | None:
        """Rule of the mesh for its boundary: ``"none"``, ``"edge-only"`` or ``"edge-and-corner"``. None if it has no rule."""
        return self._core.boundary

    @property
    def uv(self) -> arrays.Floats | None:
        """Texture coordinates, (values, 1 to 3); None if the mesh has none. Read-only."""
        return self._core.channels[0][1] if self._core.channels else None

    @property
    def uv_faces(self) -> arrays.Ints | None:
        """Number of the value in `uv` for each corner, (corners,); None if the mesh has no texture coordinates. Read-only."""
        return self._core.channels[0][2] if self._core.channels else None

    @property
    def normals(self) -> arrays.Floats | None:
        """Normals, (normals, 3); None if the mesh has none. Read-only."""
        return self._core.normals if len(self._core.normals) else None

    @property
    def face_normals(self) -> arrays.Ints | None:
        """Number of the normal in `normals` for each corner, -1 for none: (corners,). None if no corner has one. Read-only."""
        return self._core.face_normals if len(self._core.face_normals) else None

    @property
    def face_ids(self) -> arrays.Ints | None:
        """A number for each face, (faces,); None if the mesh has none. Read-only.

        For a mesh that `tessellate` made it is the face of the control mesh that the triangle lies on.
        """
        return self._core.face_ids if len(self._core.face_ids) else None

    @property
    def face_names(self) -> list[str] | None:
        """A name for each face, its group or else its object, empty for none; None if no face has one."""
        return _texts_or_none(self._core.face_names)

    @property
    def groups(self) -> list[str] | None:
        """Group of each face, empty for none; None if no face has one."""
        return _texts_or_none(self._core.groups)

    @property
    def objects(self) -> list[str] | None:
        """Object of each face, empty for none; None if no face has one."""
        return _texts_or_none(self._core.objects)

    @property
    def materials(self) -> list[str] | None:
        """Material of each face, empty for none; None if no face has one."""
        return _texts_or_none(self._core.materials)

    @property
    def smoothing_groups(self) -> list[str] | None:
        """Smoothing group of each face, empty for none; None if no face has one."""
        return _texts_or_none(self._core.smoothing_groups)

    @property
    def material_files(self) -> list[str]:
        """Files of the materials; empty if there are none."""
        return _texts(self._core.material_files)

    @property
    def vertex_values(self) -> dict[str, npt.NDArray[Any]]:
        """Values of vertices, {name: (vertices,)}, each in the type that files keep. Read-only.

        Values of integer types are rounded, as in files: those of a refined mesh are exact where the control mesh has floats.
        """
        return _values(self._core.vertex_values)

    @property
    def face_values(self) -> dict[str, npt.NDArray[Any]]:
        """Values of faces, {name: (faces,)}, each in the type that files keep. Read-only."""
        return _values(self._core.face_values)

    @property
    def scheme(self) -> str:
        """Name of the scheme that the file says, as USD does, or that refined the mesh; empty if unknown."""
        return self._core.scheme

    @property
    def warnings(self) -> list[str]:
        """Reservations of the reader about the file, each with file:line, and of the function that made the mesh."""
        return self._core.warnings

    def with_points(self, points: Points) -> Mesh:
        """Returns the mesh with other points, as in another frame. Faces, tags and all else stay.

        Parameters
        ----------
        points : (vertices, 3), real numbers

        Raises
        ------
        InvalidParameter
            An array of another shape or type; NaN and infinite points.

        Examples
        --------
        >>> import sublimit
        >>> triangle = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], corners={0: 10})
        >>> triangle.with_points(2 * triangle.points).corners[1]
        array([10.], dtype=float32)
        """
        count = len(self._core.points)
        return Mesh._of(self._core.with_points(arrays.floats(points, "points", (count, 3), f"({count} vertices, 3)")))

    def info(self, scheme: Scheme | str | None = None, *, limit: bool = False) -> dict[str, Any]:
        """Returns counts, valences, boundaries, tags, rules and faults, as ``sublimit info --json`` prints them.

        Parameters
        ----------
        scheme : name or `Scheme`, to report whether it can refine the mesh, and the memory of its levels (default: none)
        limit : report area, volume, centroid and inertia of the limit too, with error bounds where errors exceed rounding
            (default: False)

        Raises
        ------
        InvalidOption
            An unknown scheme, or `limit` without a scheme.
        UnsupportedTopology
            The limit is requested, and the scheme has none for this mesh.
        """
        asked = _sublimit.MeshRequest() if scheme is None else request(scheme)
        found: dict[str, Any] = json.loads(_sublimit.info(self._core, asked, "mesh", bool(limit)))
        return found

    @classmethod
    def from_trimesh(cls, mesh: Any) -> Mesh:
        """Makes a mesh from one of another package.

        Parameters
        ----------
        mesh : a ``trimesh.Trimesh`` or another object with `vertices` and `faces`; or a ``meshio.Mesh`` or another object with
            `points` and `cells`, of which triangles, quads and polygons are taken

        Raises
        ------
        TypeError
            The object has neither pair of attributes.
        """
        if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
            return cls(np.asarray(mesh.vertices), np.asarray(mesh.faces))
        if hasattr(mesh, "points") and hasattr(mesh, "cells"):
            kept = [np.asarray(block.data) for block in mesh.cells if block.type in ("triangle", "quad", "polygon")]
            sizes = [np.full(len(block), block.shape[1], np.int32) for block in kept] or [np.zeros(0, np.int32)]
            corners = [block.reshape(-1) for block in kept] or [np.zeros(0, np.int32)]
            points = np.asarray(mesh.points)
            if points.ndim == 2 and points.shape[1] == 2:
                points = np.column_stack([points, np.zeros(len(points))])
            return cls(points, (np.concatenate(sizes), np.concatenate(corners)))
        raise TypeError(f"a {type(mesh).__name__} has neither vertices and faces nor points and cells")

    def to_trimesh(self) -> Any:
        """Returns a ``trimesh.Trimesh`` with the same vertices and the triangles of `triangles`.

        Raises
        ------
        ImportError
            trimesh is not installed.
        """
        import trimesh

        return trimesh.Trimesh(self.points, self.triangles(), process=False)

    def triangles(self) -> arrays.Ints:
        """Returns the faces cut into triangles, each as a fan from its first corner: (triangles, 3)."""
        sizes, corners = self.faces
        first = np.repeat(np.cumsum(sizes) - sizes, sizes - 2)
        number = np.arange(len(first)) - np.repeat(np.cumsum(sizes - 2) - (sizes - 2), sizes - 2)
        return np.column_stack([corners[first], corners[first + number + 1], corners[first + number + 2]]).astype(np.int32)

    def _repr_html_(self) -> str:
        from ._pictures import mesh_picture

        info = self.info()
        sizes = ", ".join(f"{count} of {size} corners" for size, count in info["face_sizes"].items()) or "none"
        return (f"<div>{mesh_picture(self)}<p>{info['vertices']} vertices, {info['edges']} edges, {info['faces']} faces ({sizes}); "
                f"{info['creases']} creases, {info['corners']} corners, {info['holes']} holes</p></div>")

    def faults(self) -> list[str]:
        """Returns the reasons why the mesh is not a manifold, in words; empty if it is one."""
        return self._core.faults()

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a file, which appears whole or not at all.

        Parameters
        ----------
        path : path that ends in .obj, which holds the tags too, .ply, .off, .stl, .glb, .gltf, .usda or .usdz

        Raises
        ------
        InvalidOption
            Another extension.
        InvalidParameter
            Normals per corner, and a .ply; a name that the file cannot hold, such as one with a line end.
        InvalidMesh
            Values that the file cannot hold, such as colours that are not finite and an .obj.
        IoError
            The file cannot be written.
        ResourceError
            The disk is full.
        """
        self._core.write(os.fspath(path))

    def __repr__(self) -> str:
        return f"<sublimit.Mesh: {len(self._core.points)} vertices, {len(self._core.sizes)} faces>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Mesh._of, (self._core,)


def info(mesh: Mesh, scheme: Scheme | str | None = None, *, limit: bool = False) -> dict[str, Any]:
    """Returns counts, valences, boundaries, tags, rules and faults of a mesh, as ``sublimit info --json`` prints them.

    Calls `Mesh.info`.

    Parameters
    ----------
    mesh : a `Mesh`
    scheme : name or `Scheme`, to report whether it can refine the mesh, and the memory of its levels (default: none)
    limit : report area, volume, centroid and inertia of the limit too (default: False)

    Raises
    ------
    InvalidOption
        An unknown scheme, or `limit` without a scheme.
    UnsupportedTopology
        The limit is requested, and the scheme has none for this mesh.
    TypeError
        `mesh` is not a `Mesh`.

    Examples
    --------
    >>> import sublimit
    >>> triangle = sublimit.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> sublimit.info(triangle, "loop")["scheme"]["takes_mesh"]
    'yes'
    """
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh is a {type(mesh).__name__}; a sublimit.Mesh is right")
    return mesh.info(scheme, limit=limit)


def read(path: str | os.PathLike[str], *, sidecar: str | os.PathLike[str] | None = None) -> Mesh:
    """Reads a mesh from a file, and tags from a JSON file beside it, which override those of the mesh's own file.

    Parameters
    ----------
    path : path that ends in .obj, which may have tags, .ply, .off, .stl, .glb, .gltf, .usda or .usdz, each also compressed as .gz
    sidecar : path of the JSON file, or ``"none"`` (default: the path with the extension .json, if that file has tags)

    Raises
    ------
    FormatError
        A file cannot be parsed; the message starts with file:line, or has the key.
    InvalidMesh
        Faces or tags name vertices, edges or faces that do not exist.
    IoError
        A file is missing, a directory or unreadable.
    """
    return Mesh._of(_sublimit.read(os.fspath(path), "" if sidecar is None else os.fspath(sidecar)))


def tag_rows(values: Any, name: str, columns: int, words: str) -> arrays.Floats:
    """Returns tags as rows: vertices, then a sharpness or a rate, (tags, columns).

    Parameters
    ----------
    values : mapping from vertices to numbers, rows, or two arrays (vertices, numbers) as in `Mesh`; None for no rows
    name : name of the argument, for messages
    columns : 3 for edges, 2 for vertices
    words : accepted forms in words, for messages
    """
    if isinstance(values, Mapping):
        values = [(*(key if columns == 3 else (key,)), sharpness) for key, sharpness in values.items()]
    elif isinstance(values, tuple) and len(values) == 2 and all(isinstance(part, np.ndarray) for part in values):
        values = _joined(values[0], values[1], name, columns)
    elif values is not None and not isinstance(values, np.ndarray):
        values = [tuple(row) for row in values]
    return arrays.floats([] if values is None else values, name, (None, columns), words, finite=False)


def _sharp_rows(values: Any, name: str, columns: int, words: str) -> arrays.Floats:
    rows = tag_rows(values, name, columns, words)
    if np.isnan(rows[:, -1]).any():
        row = int(np.argmax(np.isnan(rows[:, -1])))
        raise InvalidMesh(f"{name}[{row}] has sharpness nan; 0 to infinity is right")
    return rows


def _joined(first: npt.NDArray[Any], second: npt.NDArray[Any], name: str, columns: int) -> Any:
    """Returns two arrays, the vertices of tags and their sharpness, as rows; unchanged if they are two rows themselves."""
    is_pair = second.ndim == 1 and first.shape == ((len(second), 2) if columns == 3 else (len(second),))
    if is_pair and first.dtype.kind not in "iu" and first.size > 0:
        is_pair = False
    if is_pair and columns == 2 and len(first) == 2 and second.dtype.kind in "iu":
        raise InvalidParameter(f"{name} is two arrays of two whole numbers, which may be (vertices, sharpness) or two rows; give a "
                               "list of rows, or sharpness in float")
    return np.column_stack([first, second]) if is_pair else [first, second]


def whole(column: arrays.Floats, name: str, what: str = "vertex") -> arrays.Ints:
    wrong = ~(column == np.floor(column)) | (np.abs(column) > 2**31 - 1)
    if wrong.any():
        raise InvalidMesh(f"{name} names {what} {column[wrong][0]:.17g}; whole numbers are right")
    return np.ascontiguousarray(column, dtype=np.int32)


def _creases(values: Any) -> tuple[arrays.Ints, arrays.Floats32]:
    rows = _sharp_rows(values, "creases", 3, "{(tail, head): sharpness}, rows (tail, head, sharpness) or (edges, sharpness)")
    return whole(rows[:, :2], "creases"), np.ascontiguousarray(rows[:, 2], dtype=np.float32)


def _corners(values: Any) -> tuple[arrays.Ints, arrays.Floats32]:
    rows = _sharp_rows(values, "corners", 2, "{vertex: sharpness}, rows (vertex, sharpness) or (vertices, sharpness)")
    return whole(rows[:, 0], "corners"), np.ascontiguousarray(rows[:, 1], dtype=np.float32)


def _channel(uv: Any, uv_faces: Any, sizes: arrays.Ints, vertices: arrays.Ints,
             num_points: int) -> tuple[arrays.Floats, arrays.Ints]:
    values = arrays.floats(uv, "uv", (None, None), "(values, 1 to 3)")
    if not 1 <= values.shape[1] <= 3:
        raise InvalidParameter(f"uv has shape {values.shape}; (values, 1 to 3) is right")
    if uv_faces is None:
        if len(values) == len(vertices):
            return values, np.arange(len(vertices), dtype=np.int32)
        if len(values) == num_points:
            return values, vertices
        raise InvalidMesh(f"uv has {len(values)} values; {num_points} of vertices or {len(vertices)} of corners are right, "
                          "or uv_faces to say which corner has which")
    indices = _of_corners(uv_faces, "uv_faces", sizes, vertices)
    if len(indices) and not 0 <= indices.min() <= indices.max() < len(values):
        raise InvalidMesh(f"uv_faces names value {indices.max() if indices.min() >= 0 else indices.min()}; uv has {len(values)}")
    return values, indices


def _normals(normals: Any, face_normals: Any, sizes: arrays.Ints, vertices: arrays.Ints,
             num_points: int) -> tuple[arrays.Floats, arrays.Ints]:
    values = arrays.floats(normals, "normals", (None, 3), "(normals, 3)")
    if face_normals is None:
        if len(values) == num_points:
            return values, np.zeros(0, np.int32)
        if len(values) == len(vertices):
            return values, np.arange(len(vertices), dtype=np.int32)
        raise InvalidMesh(f"normals has {len(values)} rows; {num_points} of vertices or {len(vertices)} of corners are right, or "
                          "face_normals to say which corner has which")
    indices = _of_corners(face_normals, "face_normals", sizes, vertices)
    if len(indices) and not -1 <= indices.min() <= indices.max() < len(values):
        raise InvalidMesh(f"face_normals names normal {indices.max() if indices.min() >= -1 else indices.min()}; normals has "
                          f"{len(values)}, and -1 is none")
    return values, indices


def _of_corners(values: Any, name: str, sizes: arrays.Ints, vertices: arrays.Ints) -> arrays.Ints:
    """Returns a number for each corner of all faces, given in the form of faces or as a flat array."""
    array = np.asarray(values) if isinstance(values, np.ndarray) else None
    if array is not None and array.ndim == 1 and array.dtype != object:
        indices = arrays.ints(array, name, (None,), "(corners,)")
    else:
        indices = arrays.faces(values, name)[1]
    if len(indices) != len(vertices):
        raise InvalidMesh(f"{name} has {len(indices)} corners; the {len(sizes)} faces have {len(vertices)}")
    return indices


def names_of(names: Iterable[str] | None, num_faces: int | None = None, argument: str = "face_names") -> list[bytes]:
    """Returns names of faces, or of files, as the compiled part takes them: bytes in UTF-8.

    Parameters
    ----------
    names : a str for each face; None for no names
    num_faces : required number of names; None if any is right, or the compiled part checks it
    argument : name of the argument, for messages
    """
    if names is None:
        return []
    if isinstance(names, (str, bytes)):
        raise TypeError(f"{argument} is one word; a list of names is right")
    all_of_them = list(names)
    for i, name in enumerate(all_of_them):
        if not isinstance(name, str):
            raise TypeError(f"{argument}[{i}] is a {type(name).__name__}; a str is right, empty for none")
    if num_faces is not None and len(all_of_them) != num_faces:
        raise InvalidMesh(f"{argument} has {len(all_of_them)} names; {num_faces} are right, one for each face")
    return [name.encode("utf-8", "surrogateescape") for name in all_of_them]


def _texts(names: Sequence[bytes]) -> list[str]:
    return [name.decode("utf-8", "surrogateescape") for name in names]


def _texts_or_none(names: Sequence[bytes]) -> list[str] | None:
    return _texts(names) if any(names) else None


def _value_rows(values: Mapping[str, npt.ArrayLike] | None, argument: str, count: int,
                what: str) -> list[tuple[bytes, arrays.Floats, str]]:
    """Returns values as the compiled part takes them: name, numbers, and the type that files have.

    Raises
    ------
    TypeError
        No mapping, or a name that is no str.
    InvalidParameter
        An array of another shape or type.
    """
    if values is None:
        return []
    if not isinstance(values, Mapping):
        raise TypeError(f"{argument} is a {type(values).__name__}; a mapping {{name: ({what},)}} is right")
    rows = []
    for name, numbers in values.items():
        if not isinstance(name, str):
            raise TypeError(f"{argument} has a name that is a {type(name).__name__}; a str is right")
        array = arrays.any_array(numbers, f"{argument}[{name!r}]")
        kind = array.dtype.name if array.dtype.name in _sublimit.value_types else "float64"
        rows.append((name.encode("utf-8", "surrogateescape"),
                     arrays.floats(array, f"{argument}[{name!r}]", (count,), f"({count} {what},)", finite=False), kind))
    return rows


def _values(rows: Sequence[tuple[bytes, arrays.Floats, str]]) -> dict[str, npt.NDArray[Any]]:
    """Returns values by name as read-only arrays of the types that files have, rounded as in files."""
    values: dict[str, npt.NDArray[Any]] = {}
    for name, numbers, kind in rows:
        array: npt.NDArray[Any] = numbers
        dtype = np.dtype(kind)
        if dtype.kind in "iu":
            array = np.clip(np.rint(array), np.iinfo(dtype).min, np.iinfo(dtype).max).astype(dtype)
        elif dtype != array.dtype:
            with np.errstate(over="ignore"):
                array = array.astype(dtype)
        array.setflags(write=False)
        values[name.decode("utf-8", "surrogateescape")] = array
    return values
