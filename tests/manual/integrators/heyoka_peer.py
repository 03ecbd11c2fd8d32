"""heyoka: Taylor series by JIT-compiled automatic differentiation, of the order that the tolerance asks for."""

import heyoka
import numpy as np

from hess_mechanics import systems

from .method import Method, half_decades, version


def _ladders(work):
    plain = [(tolerance,) for tolerance in half_decades(2, 18)]
    ladder = (*plain, *((tolerance, "high accuracy") for tolerance in half_decades(15, 18)))
    if work.name == "D":
        return [tuple((*setting, kind) for setting in ladder) for kind in ("nt_event", "t_event")]
    if work.name == "B2":
        # Twice the recommended width is often faster still.
        width = heyoka.recommended_simd_size()
        return [tuple((*setting, f"{lanes} lanes") for setting in ladder) for lanes in (width, 2 * width)]
    return [ladder]


def _options(setting):
    return {"tol": float(setting[0]), "high_accuracy": "high accuracy" in setting}


def _motion_equations(work):
    variables = heyoka.make_vars("w1", "w2", "g1", "g2", "g3")
    # Numbers instead of parameters: factors 0 and 1 fall out.
    return list(zip(variables, systems()["suslov"].field(variables, work.parameters), strict=True))


def _orbit(work, setting):
    integrator = heyoka.taylor_adaptive(_motion_equations(work), work.initial[0], **_options(setting))

    def run():
        integrator.time = 0.0
        integrator.state[:] = work.initial[0]
        if work.times.size > 1:
            return integrator.propagate_grid(work.times)[-1]
        integrator.propagate_until(work.times[0])
        return integrator.state[None].copy()

    return run


def _ensemble(work, setting):
    """Batch after batch, each lane with its own step."""
    width = int(str(setting[-1]).split()[0])
    blocks = [work.initial[i : i + width].T.copy() for i in range(0, len(work.initial), width)]
    out = np.empty_like(work.initial)
    integrator = heyoka.taylor_adaptive_batch(_motion_equations(work), blocks[0], **_options(setting))

    def run():
        for i, block in enumerate(blocks):
            integrator.set_time(0.0)
            integrator.state[:] = block
            integrator.propagate_until(work.times[0])
            out[width * i : width * (i + 1)] = integrator.state.T
        return out

    return run


def _crossings(work, setting):
    equations = _motion_equations(work)
    found = []

    def passed(integrator, time, direction):
        integrator.update_d_output(time)
        found.append(integrator.d_output.copy())

    def stopped(integrator, direction):
        found.append(integrator.state.copy())
        return True  # go on

    upward, height = heyoka.event_direction.positive, equations[4][0]
    if "nt_event" in setting:
        events = {"nt_events": [heyoka.nt_event(height, passed, direction=upward)]}
    else:
        events = {"t_events": [heyoka.t_event(height, callback=stopped, direction=upward)]}
    integrator = heyoka.taylor_adaptive(equations, work.initial[0], **events, **_options(setting))

    def run():
        found.clear()
        integrator.time = 0.0
        integrator.state[:] = work.initial[0]
        integrator.propagate_until(work.times[0])
        return np.array(found)

    return run


_WAYS = {
    "A": _orbit,
    "A2": _orbit,
    "B2": _ensemble,
    "D": _crossings,
}


def _prepare(work, setting):
    return _WAYS[work.name](work, setting)


METHOD = Method("heyoka", version("heyoka"), _ladders, _prepare)
