# SPDX-License-Identifier: Apache-2.0
# Reads files of tables with the lines of NumPy that eval/table_format.md shows, and exports with SciPy: all make the
# points that the library made.
#   read_table.py table_format.md DIRECTORY NAME...
import json, pathlib, re, sys
import numpy as np, scipy.io, scipy.sparse

page, directory, names = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]
shown = {}
exec(re.search(r"```python\n(.*?)```", page.read_text(), re.S).group(1), shown)

def near(what, a, b, eps):
    assert a.shape == b.shape, (what, a.shape, b.shape)
    error = np.abs(a - b).max(initial=0) / max(1, np.abs(b).max(initial=0))
    assert error < 100 * eps, (what, error)

for name in names:
    points, expected = np.load(directory / (name + ".points.npy")), np.load(directory / (name + ".expected.npy"))
    eps = np.finfo(expected.dtype).eps
    metadata, arrays = shown["read"](directory / name)
    assert metadata["format"] == "sublimit-table"
    near(name, shown["apply"](metadata, arrays, points), expected, eps)

    def quotients(flat):  # matrices make homogeneous columns
        columns = flat.reshape(len(expected), -1, points.shape[1])
        return shown["divided"](columns) if metadata.get("coordinates") else columns
    csr = scipy.sparse.load_npz(directory / (name + ".npz"))
    assert csr.format == "csr" and csr.dtype == expected.dtype and csr.has_sorted_indices
    near(name + ".npz", quotients(csr @ points), expected, eps)
    text = scipy.io.mmread(directory / (name + ".mtx")).tocsr()
    near(name + ".mtx", quotients(text @ points), expected, eps)

    files = directory / (name + "_arrays")
    assert json.loads((files / "metadata.json").read_text())["scheme"] == metadata["scheme"]
    assert sorted(f.stem for f in files.glob("*.npy")) == sorted(arrays)
    for key, array in arrays.items():
        loaded = np.load(files / (key + ".npy"))
        assert loaded.dtype == array.dtype and loaded.shape == array.shape and (loaded == array).all(), key
print("read", *names)
