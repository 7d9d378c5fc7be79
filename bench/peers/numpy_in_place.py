"""How many afferent-steps per second does NumPy compute on one core, for the tasks of work.py?

Method: carefully optimized NumPy. Every operation writes in place, into arrays allocated before the timing starts. Afferents are
processed in blocks that stay in cache (256 kB per array), all steps of one block before the next. Each spike is stored as step and
afferent. A first run, not timed, checks that no afferent fires twice in a step; the result is the median wall time of the runs.
The tasks and forms are described in work.py.

    numpy_in_place.py [--work shared ...] [--dtype float32 ...] [--form folded ...] [--n 100000] [--runs 5] [--block AFFERENTS]
"""

import time
from types import SimpleNamespace

import numpy as np
import work
from numpy import add, greater, maximum, multiply, subtract


def constants(dtype):
    """The constants of work.py as numbers of this type."""
    k = work.K
    return SimpleNamespace(
        k=dtype(k), k_A=dtype(work.K_A), K_B=dtype(work.K_B), K_C=dtype(work.K_C), keep_C=dtype(work.keep(work.F_C)),
        I_leak0=dtype(work.I_LEAK0), E_L=dtype(work.E_L), V_th=dtype(work.V_TH), drop=dtype(work.DROP), zero=dtype(0),
        k_A_k=dtype(work.K_A * k), K_B_k=dtype(work.K_B * k), K_C_k=dtype(work.K_C * k), leak_k=dtype(work.I_LEAK0 * k))


class Task:
    """A task with everything that is computed before the timing starts. `name`, `form`: see work.py; n: number of afferents."""

    def __init__(self, name, dtype, form, n):
        self.name, self.dtype, self.folded, self.n, self.c = name, dtype, form == "folded", n, constants(dtype)
        samples = work.SAMPLES[name]
        self.press, self.g = work.press(samples), work.gains(n).astype(dtype)
        f_B = work.corners(n) if name == "own" else np.full(n, work.F_B)
        self.keep_B = work.keep(f_B).astype(dtype)
        self.frames = work.frames(n, samples, dtype) if name == "streamed" else None


def shared(task, rows):
    """Returns a function that computes the increase of u in a step, before the limit at E_L, for the slice `rows` of the afferents.

    The function returns the same array in every call."""
    c, g = task.c, task.g[rows]
    du = np.empty_like(g)
    I = [task.dtype(I * work.K if task.folded else I) for I in work.currents(task.press)]

    def as_written(step):
        multiply(g, I[step], out=du)
        subtract(du, c.I_leak0, out=du)
        return multiply(du, c.k, out=du)

    def folded(step):
        multiply(g, I[step], out=du)
        return subtract(du, c.leak_k, out=du)

    return folded if task.folded else as_written


def receptor(task, rows, du):
    """Returns a function of the force change dF, which computes the increase of u.

    Before the call, `du` must contain the static current k_A F. The function adds the dynamic currents, subtracts the leak, and converts
    the sum to the increase of u, also in `du`."""
    c, keep_C, keep_B = task.c, task.c.keep_C, task.keep_B[rows]
    if task.name == "streamed":
        keep_B = keep_B[0]
    x_B, x_C, part = np.zeros_like(du), np.zeros_like(du), np.empty_like(du)

    def as_written(dF):
        for x, keep, K in (x_B, keep_B, c.K_B), (x_C, keep_C, c.K_C):
            multiply(keep, x, out=x)
            multiply(keep, dF, out=part)
            add(x, part, out=x)
            multiply(K, x, out=part)
            maximum(part, c.zero, out=part)
            add(du, part, out=du)
        subtract(du, c.I_leak0, out=du)
        return multiply(du, c.k, out=du)

    def folded(dF):
        for x, keep, K_k in (x_B, keep_B, c.K_B_k), (x_C, keep_C, c.K_C_k):
            add(x, dF, out=x)
            multiply(keep, x, out=x)
            maximum(x, c.zero, out=part)
            multiply(K_k, part, out=part)
            add(du, part, out=du)
        return subtract(du, c.leak_k, out=du)

    return folded if task.folded else as_written


def own(task, rows):
    """As shared(), for the task `own`."""
    g, press = task.g[rows], [task.dtype(F) for F in task.press]
    F, before, du = multiply(g, press[0]), np.empty_like(g), np.empty_like(g)
    add_response = receptor(task, rows, du)
    static = [task.dtype(work.K_A * work.K * F) for F in task.press]
    change = [task.dtype(F - task.press[max(step - 1, 0)]) for step, F in enumerate(task.press)]

    def as_written(step):
        nonlocal F, before
        F, before = before, F
        multiply(g, press[step], out=F)
        multiply(task.c.k_A, F, out=du)
        return add_response(subtract(F, before, out=before))

    def folded(step):
        multiply(g, static[step], out=du)
        return add_response(multiply(g, change[step], out=F))

    return folded if task.folded else as_written


def streamed(task, rows):
    """As shared(), for the task `streamed`."""
    frames, k_A = task.frames, task.c.k_A_k if task.folded else task.c.k_A
    du, dF = np.empty(rows.stop - rows.start, task.dtype), np.empty(rows.stop - rows.start, task.dtype)
    add_response = receptor(task, rows, du)

    def rise(step):
        F = frames[step, rows]
        multiply(k_A, F, out=du)
        return add_response(subtract(F, frames[max(step - 1, 0), rows], out=dF))

    return rise


def fire(task, rows, rise, watched):
    """Computes all steps of the afferents `rows`.

    Returns their spikes as (step, index of the first afferent of `rows`, indexes in `rows` of the afferents that fired).
    `rise`: computes the increase of u in a step. `watched`: checks that no afferent fires twice in a step."""
    c, spikes = task.c, []
    u, over = np.full(rows.stop - rows.start, c.E_L), np.empty(rows.stop - rows.start, bool)
    for step in range(len(task.press)):
        add(u, rise(step), out=u)
        maximum(u, c.E_L, out=u)
        greater(u, c.V_th, out=over)
        fired = over.nonzero()[0]
        if fired.size:
            u[fired] -= c.drop
            spikes.append((step, rows.start, fired))
        assert not (watched and np.any(u > c.V_th)), "an afferent fired twice in a step"
    return spikes


def run(task, block, watched=False):
    """Runs the complete task once, in blocks of `block` afferents; returns its wall time (s) and its spikes, see fire()."""
    make = {"shared": shared, "own": own, "streamed": streamed}[task.name]
    blocks = [slice(low, min(low + block, task.n)) for low in range(0, task.n, block)]
    ready = [(rows, make(task, rows)) for rows in blocks]
    start = time.perf_counter()
    spikes = [spike for rows, rise in ready for spike in fire(task, rows, rise, watched)]
    return time.perf_counter() - start, spikes


def count(spikes):
    return sum(fired.size for _, _, fired in spikes)


def main():
    options = work.arguments(form=["as-written", "folded"], block=0)
    print(work.machine())
    for name, dtype, form in options.works:
        task = Task(name, np.dtype(dtype).type, form, options.n)
        block = options.block or 2**18 // task.g.itemsize
        total = count(run(task, block, watched=True)[1])
        runs = [run(task, block) for _ in range(options.runs)]
        assert all(count(spikes) == total for _, spikes in runs)
        work.report(f"numpy {np.__version__}", name, dtype, f"{form}, blocks of {block}", options.n, [s for s, _ in runs], total)


if __name__ == "__main__":
    main()
