"""The outcome of open days as a page for the owner of an arcade: what was tried, what was lost, who waited."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

STYLE = """
body { font: 17px/1.5 system-ui, sans-serif; color: #16202e; max-width: 60em; margin: 3em auto; padding: 0 1.5em }
h1 { font-size: 2em; margin-bottom: 0 } h2 { margin-top: 2em } .verdict { font-size: 1.3em; font-weight: 600 }
.good { color: #0b6b3a } .bad { color: #a4161a } table { border-collapse: collapse; width: 100% }
th, td { padding: .4em .8em; border-bottom: 1px solid #cdd6e0; text-align: right } 
th:first-child, td:first-child { text-align: left }
"""
ROWS = {
    "visitors who played": "visitors",
    "matches": "matches",
    "of these in events": "matches_of_events",
    "left before the end": "left",
    "high scores entered": "high_scores",
    "kills of the program": "kills",
    "of these power cuts": "power_cuts",
    "problems": "problems",
}


def page(figures: Mapping[str, Any]) -> str:
    """The page, as HTML."""
    days = figures.get("days") or [figures]
    found: Sequence[str] = figures["problems"]
    verdict = "Nothing was lost, nothing was counted twice." if not found else f"{len(found)} problems."
    counts: Counter[str] = sum((Counter(day["counts"]) for day in days), Counter())
    parts = [
        f"<h1>{len(days)} open day{'s' * (len(days) > 1)}, {figures['visitors']} visitors</h1>",
        f"<p>Played by a script in simulated time, {figures['hours']:g} hours a day, seed {figures['seed']}.</p>",
        f'<p class="verdict {"bad" if found else "good"}">{verdict}</p>',
        _list(found),
        "<h2>Day by day</h2>",
        _table(["", *(day["opening"] for day in days)], _rows(days)),
        "<h2>Waiting</h2>",
        f"<p>{_waiting(days)}</p>",
        "<h2>Memory</h2>",
        _list(_memory(days)),
        "<h2>What happened besides</h2>",
        _list(f"{name}: {count}" for name, count in sorted(counts.items())),
    ]
    return f"<!doctype html><meta charset=utf-8><title>Open days</title><style>{STYLE}</style>{''.join(parts)}\n"


def _rows(days: Sequence[Mapping[str, Any]]) -> list[list[str]]:
    rows = []
    for name, key in ROWS.items():
        values = [len(day[key]) if key == "problems" else day[key] for day in days]
        rows.append([name, *map(str, values)])
    games = sorted({game for day in days for game in day["games"]})
    return rows + [[f"matches of {game}", *(str(day["games"].get(game, 0)) for day in days)] for game in games]


def _waiting(days: Sequence[Mapping[str, Any]]) -> str:
    waits = [day["waits"] for day in days if day["waits"]]
    if not waits:
        return "No class came with its phones."
    turns, longest = sum(one["turns"] for one in waits), max(one["longest_minutes"] for one in waits)
    share = max(one["most_of_share"] for one in waits)
    return (
        f"{turns} times somebody of a class of phones waited for a seat: at most {longest:g} minutes, and at most "
        f"{share:g} times as many matches as a fair queue takes (the limit is 2)."
    )


def _memory(days: Sequence[Mapping[str, Any]]) -> list[str]:
    return [
        f"{day['opening']}, a run of {run['hours']:g} hours: {run['warm_mb']:.0f} MB after half an hour, "
        f"{run['end_mb']:.0f} MB at its end, at most {run['most_mb']:.0f} MB"
        for day in days
        for run in day["memory"]
    ] or ["No run was long enough."]


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    head = "".join(f"<th>{escape(cell)}</th>" for cell in header)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def _list(lines: Iterable[str]) -> str:
    return f"<ul>{''.join(f'<li>{escape(line)}</li>' for line in lines)}</ul>"
