"""Reads a STEP file back with OpenCascade: is it valid, what area has it, what are its faces?

    python -m venv /tmp/cad && /tmp/cad/bin/pip install cadquery-ocp-novtk
    /tmp/cad/bin/python xtask/scripts/read_step.py FILE.step [expected area]
"""

import sys

from OCP.BRep import BRep_Tool
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.Geom import Geom_BSplineSurface
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS


def explore(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def main():
    reader = STEPControl_Reader()
    if reader.ReadFile(sys.argv[1]) != IFSelect_ReturnStatus.IFSelect_RetDone:
        sys.exit("not a STEP file")
    reader.TransferRoots()
    shape = reader.OneShape()
    valid = BRepCheck_Analyzer(shape).IsValid()
    area = GProp_GProps()
    BRepGProp.SurfaceProperties_s(shape, area, 1e-11)
    faces = list(explore(shape, TopAbs_FACE))
    kinds = set()
    for face in faces:
        surface = BRep_Tool.Surface_s(TopoDS.Face(face))
        name = type(surface).__name__
        if isinstance(surface, Geom_BSplineSurface):
            rational = "rational" if surface.IsURational() or surface.IsVRational() else "polynomial"
            name = f"{rational} B-spline of degree {surface.UDegree()} x {surface.VDegree()}"
        kinds.add(name)
    edges = len({edge.TShape() if hasattr(edge, "TShape") else edge for edge in explore(shape, TopAbs_EDGE)})
    print(f"valid: {valid}; {len(faces)} faces, {edges} edges; {', '.join(sorted(kinds))}")
    print(f"area: {area.Mass():.15g}")
    good = valid
    if len(sys.argv) > 2:
        error = area.Mass() / float(sys.argv[2]) - 1.0
        print(f"relative error of the area: {error:.2e}")
        good = good and abs(error) < 1e-9
    sys.exit(0 if good else 1)


main()
