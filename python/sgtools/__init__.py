"""Elimination complexity of SLAM graphs: order, prune, score and solve them, with numpy in and out.

    >>> import sgtools as sg
    >>> graph = sg.read("manhattan.g2o")
    >>> sg.ec(graph, "colamd"), sg.ec(graph, "wmf")
    >>> sparse = sg.decimate(graph, 4)
    >>> solution = sg.solve(sparse)
    >>> sg.trajectory_error(solution.graph, graph)["ate"]

Names and meanings are those of the commands: sg-ec(1), sg-dec(1), sg-solve(1) and the rest tell more.
"""

from ._core import (
    ComputationError,
    Graph,
    InputError,
    Solution,
    __version__,
    bayes_tree,
    candidates,
    chi2,
    covariances,
    decimate,
    ec,
    ecgreedy,
    elimination,
    from_arrays,
    growth,
    joint_covariance,
    keyframes,
    order,
    orderings,
    parse,
    read,
    sample,
    sigmas,
    solve,
    tgreedy,
    trajectory_error,
)

__all__ = [name for name in dir() if not name.startswith("_")]
