"""Tables in HTML, as notebooks show them."""

from collections.abc import Sequence
from html import escape

from user_forces.values.value import cleaned

LEFT, RIGHT = "text-align: left", "text-align: right"
CAPTION = f"caption-side: top; white-space: nowrap; {LEFT}"


def html_table(title: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table with its title; columns whose header begins with > are of numbers. No header: names and words."""
    styles = [RIGHT if name.startswith(">") else LEFT for name in header]
    styles += [LEFT] * (max(map(len, rows), default=0) - len(styles))
    head = "".join(_cell("th", name.lstrip(">"), style) for name, style in zip(header, styles, strict=False))
    body = "".join(
        f"<tr>{''.join(_cell('td', one, style) for one, style in zip(row, styles, strict=False))}</tr>"
        for row in rows
    )
    return (
        f"<table><caption style='{CAPTION}'><b>{escape(cleaned(title))}</b></caption>"
        + (f"<thead><tr>{head}</tr></thead>" if header else "")
        + f"<tbody>{body}</tbody></table>"
    )


def _cell(tag: str, text: str, style: str) -> str:
    return f"<{tag} style='{style}'>{escape(cleaned(text))}</{tag}>"
