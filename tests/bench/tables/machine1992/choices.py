"""What of the simulation was chosen after looking at the thesis's times, beside the parameters that are fitted."""

CHOICES = [
    ["4.1 to 4.4", "how large the figures are: a scale for each table", "4.1: least squares over all cells. Others: the "
     "cells of 8 nodes, which therefore are no predictions"],
    ["4.1, 4.2", "for an inbetween, a node sends the box around what it has drawn, not the whole MFB", "sending the whole "
     "MFB would take longer than the thesis's frames"],
    ["4.3", "keyframes have no moving parts", "if each node also sent an MFB, keyframes would take much longer than the "
     "thesis's"],
    ["4.4", "which film has which alignment", "in the fastest film on 2 nodes the bodies lie, in the slowest they stand, in "
     "the others they lean, the more the faster the film is"],
]


def sheet():
    """As page.py shows tables."""
    return {"title": "Simulated: what was chosen after looking at the thesis's times", "page": "parameters",
            "note": "The four costs are fitted on table 4.1. What this table lists was chosen beside them, so the errors of "
                    "a table are smaller than those of a true prediction would be.",
            "header": ["table", "choice", "reason"], "rows": CHOICES}
