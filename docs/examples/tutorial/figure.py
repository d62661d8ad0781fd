import h5py
import matplotlib
matplotlib.use("Agg")  # draws without a screen
import matplotlib.pyplot as plt
import numpy as np

run = h5py.File("growing.run/run.vtkhdf", "r")
table, cells = run["observables"], run["cells"]
n = table.attrs["n_row"]  # frames
hours, count = table["time"][:n] / 3600, table["cells"][:n]
last = slice(*cells["frame_offset"][n - 1:n + 1])  # rows of the last frame
center, pressure = cells["center"][last], 1000 * cells["cytosol_pressure"][last]  # kPa to Pa
distance = np.linalg.norm(center - center.mean(axis=0), axis=1)
print("doubling time %.1f h" % (np.log(2) / np.polyfit(hours, np.log(count), 1)[0]))

figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
left.plot(hours, count)
left.set(xlabel="time (h)", ylabel="cells", ylim=(0, None))
right.plot(distance, pressure, "o")
right.set(xlabel="distance from the centre (µm)", ylabel="cytosol pressure (Pa)", ylim=(0, None))
figure.savefig("figure.svg")
