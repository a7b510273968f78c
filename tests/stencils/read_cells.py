# SPDX-License-Identifier: Apache-2.0
# read_cells.py CELLS.vtu PLACES.csv POINTS.csv: places inside of Bezier cells, by their data, and the points that VTK has there.
import sys

from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
assert grid.GetNumberOfCells() > 0, "no cells"
data = grid.GetCellData()
assert data.GetHigherOrderDegrees() is not None, "no degrees"
face, corners, exact = (data.GetArray(name) for name in ("face", "corners", "exact"))
step = max(1, grid.GetNumberOfCells() // 400)
with open(sys.argv[2], "w") as places, open(sys.argv[3], "w") as points:
    places.write("face,u,v\n")
    points.write("exact,x,y,z\n")
    for c in range(0, grid.GetNumberOfCells(), step):
        cell = grid.GetCell(c)
        at = corners.GetTuple(c)
        for s, t in ((0.25, 0.125), (0.5, 0.25), (0.125, 0.75), (1, 0), (0, 0.5)):
            if cell.GetCellType() == 77:
                w = ((1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t)
            else:
                assert cell.GetCellType() == 76
                w = (1 - s - t, s, t, 0)
            u, v = (sum(w[k] * at[2 * k + i] for k in range(4)) for i in (0, 1))
            x, weights = [0.0] * 3, [0.0] * grid.GetMaxCellSize()
            cell.EvaluateLocation(reference(0), (s, t, 0), x, weights)
            places.write(f"{face.GetValue(c)},{u!r},{v!r}\n")
            points.write(f"{int(exact.GetValue(c))},{x[0]!r},{x[1]!r},{x[2]!r}\n")
