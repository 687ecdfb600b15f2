#!/usr/bin/python3
"""verdict.py > verdict.txt: what the Verdict in Debian's VTK (python3-vtk9) says of random triangles of every shape: nine coordinates, then
least and largest angle, edge ratio, aspect ratio, radius ratio, scaled Jacobian."""
import random, vtk
random.seed(7)
pts=vtk.vtkPoints(); pts.SetDataTypeToDouble(); cells=vtk.vtkCellArray(); tri=[]
for i in range(60):
    s=10**random.uniform(-3,3); flat=10**random.uniform(-3,0)
    p=[[s*random.uniform(-1,1),s*flat*random.uniform(-1,1),s*random.uniform(-1,1)*flat] for _ in range(3)]
    tri.append(p)
    cells.InsertNextCell(3)
    for q in p: cells.InsertCellPoint(pts.InsertNextPoint(q))
pd=vtk.vtkPolyData(); pd.SetPoints(pts); pd.SetPolys(cells)
names=["MinAngle","MaxAngle","EdgeRatio","AspectRatio","RadiusRatio","ScaledJacobian"]
out=[]
for n in names:
    f=vtk.vtkMeshQuality(); f.SetInputData(pd); getattr(f,"SetTriangleQualityMeasureTo"+n)(); f.Update()
    a=f.GetOutput().GetCellData().GetArray("Quality"); out.append([a.GetTuple1(i) for i in range(len(tri))])
for i,p in enumerate(tri):
    print(" ".join(repr(x) for q in p for x in q), " ".join(repr(o[i]) for o in out))
