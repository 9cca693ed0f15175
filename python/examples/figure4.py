"""Figure 4 of Frey, Steiner and How: elimination complexity of a growing graph, whole and pruned to a rate.

    sg-gen sine > sine.g2o && python3 figure4.py sine.g2o -o figure4.png

prints a table, and draws it with -o where matplotlib is installed.
"""

import argparse

import numpy as np
import sgtools as sg

options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
options.add_argument("graph", help="a graph of poses and landmarks")
options.add_argument("-r", "--rate", type=int, default=4)
options.add_argument("--every", type=int, default=10, help="a row for every so many steps")
options.add_argument("-o", "--output", help="a picture")
options = options.parse_args()

# %% The graphs: a landmark needs as many observations as mono cameras want, three.
full = sg.read(options.graph)
rate, count = options.rate, sg.candidates(full)
graphs = {
    "full": full,
    "dec": sg.decimate(full, rate, min_obs=3),
    "rand": sg.sample(full, count // rate, min_obs=3),
    "kf": sg.keyframes(full, rate=rate, min_obs=3),
}

# %% Their elimination complexity as they grow. Keyframes keep the ids of their poses, not their steps.
growth = {name: sg.growth(graph, every=options.every, min_obs=3) for name, graph in graphs.items()}
step = growth["full"]["step"]
ec = {
    name: np.interp(step, np.minimum(grown["step"] * (rate if name == "kf" else 1), step[-1]), grown["ec"])
    for name, grown in growth.items()
}

# %% What the paper predicts of the full graph's: section III, equations for G_dec and G_k.
ec["dec, predicted"] = ec["full"] * 9 / rate**2
ec["kf, predicted"] = ec["full"] / rate**3

print("step", *ec, sep="\t")
for k, at in enumerate(step):
    print(at, *(format(column[k], ".10g") for column in ec.values()), sep="\t")

# %%
if options.output:
    import matplotlib.pyplot as plt

    for name, column in ec.items():
        plt.semilogy(step, column, "--" if "predicted" in name else "-", label=name)
    plt.xlabel("step")
    plt.ylabel("elimination complexity")
    plt.legend()
    plt.savefig(options.output)
