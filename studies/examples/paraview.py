"""A mesh for ParaView

The run is written as VTU files, which ParaView opens by `paraview/machine.pvd`. Here one mesh is read back
and drawn, coloured by speed.
"""

from pathlib import Path

import meshio
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import PolyCollection

from support_exudyn import simple_scenario, simulate
from support_exudyn.postprocessing.export.meshes import to_vtu
from support_exudyn.postprocessing.export.sampling import Sampling

scenario = simple_scenario(
    "reference",
    pins={"rear_base": {"clearance_mm": 1.5, "friction": 0.25}},
    drive={"mode": 2, "start_s": 3, "end_s": 5},
    duration_s=5,
)
result = simulate(scenario, accuracy="draft")
written = to_vtu(result, Path("paraview"), Sampling(every=500))
print(len(written), "files, such as", written[0])

steps = sorted(Path("paraview").glob("machine_*.vtu"))
mesh = meshio.read(steps[-3])  # at 4 s, in mid-rise
speed = np.linalg.norm(mesh.point_data["velocity_m_s"], axis=1)
figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
for cells in mesh.cells:
    corners = mesh.points[cells.data]
    order = np.argsort(corners[:, :, 2].mean(axis=1))  # the nearest last
    faces = PolyCollection(corners[order][:, :, :2], array=speed[cells.data].mean(axis=1)[order])
    axes.add_collection(faces)
axes.autoscale()
axes.set(aspect="equal", xlabel="forward [m]", ylabel="up [m]")
figure.colorbar(faces, label="speed [m/s]")
figure.savefig("paraview.png", dpi=120)
