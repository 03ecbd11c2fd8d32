"""Files of the dialog *Export*, read again."""

import csv
import io
import json


def read(text):
    """Return the comments by key and the table of a CSV."""
    comments = dict(line[2:].split(": ", 1) for line in text.splitlines() if line.startswith("# "))
    body = "\n".join(line for line in text.splitlines() if not line.startswith("# "))
    table = list(csv.DictReader(io.StringIO(body)))
    return {key: json.loads(value) for key, value in comments.items()}, table
