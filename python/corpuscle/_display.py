"""Tables and figures in notebooks."""

import base64
import html
import io


def plural(count, noun):
    """ "1 point", "1,200 points". """
    return f"{count:,} {noun}{'s' * (count != 1)}"


def table_html(heading, rows):
    """A table; all texts are escaped."""
    row = lambda tag, values: "<tr>" + "".join(f"<{tag} style='text-align:left'>{html.escape(str(v))}</{tag}>" for v in values) + "</tr>"
    return f"<table>{row('th', heading)}{''.join(row('td', r) for r in rows)}</table>"


def figure_html(draw):
    """The picture that draw(ax=...) makes, as an inline PNG; "" without matplotlib."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    figure = Figure(figsize=(8, 3), layout="constrained")  # not of pyplot: it belongs to no window
    FigureCanvasAgg(figure)
    draw(ax=figure.add_subplot())
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=100)
    return f"<img alt='plot' src='data:image/png;base64,{base64.b64encode(data.getvalue()).decode()}'>"
