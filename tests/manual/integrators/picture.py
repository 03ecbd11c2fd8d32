"""Work and precision: time over error, a panel for each work, a curve for each method."""

import math
from io import BytesIO


def _frontier(samples):
    """Return the Pareto-optimal samples in time and error, from the fastest."""
    kept = []
    for sample in sorted(samples, key=lambda sample: (sample.seconds, sample.error)):
        if math.isfinite(sample.error) and (not kept or sample.error < kept[-1].error):
            kept.append(sample)
    return kept


def draw(report, suffix):
    """The picture as a file of this suffix (".svg", ".png").  Raises `ImportError` without Matplotlib."""
    from matplotlib.figure import Figure

    columns = min(3, len(report.measured))
    rows = -(-len(report.measured) // columns)
    figure = Figure(figsize=(5.0 * columns, 4.0 * rows + 0.6), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    colours = {name: f"C{i}" for i, name in enumerate(report.methods)}
    for panel, one in zip(panels, report.measured, strict=False):
        for name, samples in one.samples.items():
            kept = _frontier(samples)
            # An exact result has no place on a logarithmic axis.
            panel.loglog(
                [max(sample.error, 1e-17) for sample in kept],
                [1e3 * sample.seconds for sample in kept],
                ".-",
                color=colours[name],
            )
        panel.invert_xaxis()
        panel.set(title=f"{one.work.name}: {one.work.title}", xlabel="largest error", ylabel="ms")
        panel.grid(alpha=0.3)
    for panel in panels[len(report.measured) :]:
        panel.set_axis_off()
    handles = [panels[0].plot([], [], ".-", color=colour, label=name)[0] for name, colour in colours.items()]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(colours) or 1)
    file = BytesIO()
    figure.savefig(file, format=suffix.removeprefix("."))
    return file.getvalue()
