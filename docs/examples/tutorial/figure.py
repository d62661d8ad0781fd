import h5py
import numpy as np

run = h5py.File("growing.run/run.vtkhdf", "r")
table = run["observables"]                       # one row per frame
n = table.attrs["n_row"]
hours, count = table["time"][:n] / 3600, table["cells"][:n]
cells = run["cells"]                             # one row per cell and frame
last = slice(*cells["frame_offset"][n - 1:n + 1])
center, pressure = cells["center"][last], 1000 * cells["cytosol_pressure"][last]   # kPa to Pa
distance = np.linalg.norm(center - center.mean(axis=0), axis=1)
print("doubling time %.1f h" % (np.log(2) / np.polyfit(hours, np.log(count), 1)[0]))
print("mean pressure of the inner and the outer half %.1f and %.1f Pa" % tuple(
    pressure[side].mean() for side in (distance < np.median(distance), distance >= np.median(distance))))
