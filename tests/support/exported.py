"""Files of the dialog *Export*, read again."""

from support.command_line import table


def read(text):
    """Return the comments by key and the table of a CSV."""
    comments, header, rows = table(text)
    return comments, [dict(zip(header, row, strict=True)) for row in rows]
