"""The script that says when the studio's page is settled (settled.js), and how long that may take."""

import pathlib

SCRIPT = (pathlib.Path(__file__).parent / "settled.js").read_text()
PATIENCE = 120  # seconds for whatever the page must show: a machine may have much else to do
