"""What of the simulation was chosen after looking at the thesis's times, beside the parameters that are fitted."""

CHOICES = [
    ["4.1 to 4.4", "how large the figures are, a scale for each table", "4.1: least squares over all cells; others: the cells "
     "of 8 nodes, which therefore count as no prediction"],
    ["4.1, 4.2", "an inbetween's MFB is sent as the box round what was drawn, not whole", "whole, it would take longer than "
     "the thesis's frames"],
    ["4.3", "keyframes have no moving parts", "with an MFB of each node the median error is 35 %"],
    ["4.4", "which film has which alignment", "the fastest on 2 nodes lies, the slowest stands, the others lean as their times "
     "lie between"],
]


def sheet():
    """As page.py shows tables."""
    return {"title": "Simulated: what was chosen after looking at the thesis's times",
            "note": "Beside the four costs, which are fitted on table 4.1. Errors of a table are no predictions as far as it "
                    "stands here.",
            "header": ["table", "chosen", "by what"], "rows": CHOICES}
