# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
"""The page of sizes, include/SIZES.md: the tables whose first column is `machine`. A check that measures sizes names
the columns. It compares them with the row of its machine, or writes them into it."""

import pathlib

FIRST = "machine"
NOT_MEASURED = "-"


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def is_row(line):
    return line.startswith("|")


def tables(lines):
    """(columns, number of the first row, number behind the last) of each table of machines."""
    for number, line in enumerate(lines):
        if is_row(line) and cells_of(line)[0] == FIRST:
            begin = end = number + 2
            while end < len(lines) and is_row(lines[end]):
                end += 1
            yield cells_of(line), begin, end


def compare(page, machine, found, allowed):
    """In words, which of `found` {column: size} the page does not hold; `allowed(column, size)` may differ."""
    lines = pathlib.Path(page).read_text(encoding="utf-8").splitlines()
    noted = {}
    for columns, begin, end in tables(lines):
        for cells in map(cells_of, lines[begin:end]):
            if cells[0] == machine:
                noted.update(zip(columns[1:], cells[1:]))
    out = []
    for column, size in found.items():
        cell = noted.get(column, NOT_MEASURED)
        if cell == NOT_MEASURED:
            out.append(f"{page} has no '{column}' of {machine}; it is {size:g}")
        elif abs(size - float(cell)) > allowed(column, size):
            out.append(f"{page} says {column} {cell} of {machine}; it is {size:g}")
    return out


def note(page, machine, found):
    """Writes `found` {column: text} into the row of this machine; other machines and other columns stay."""
    path = pathlib.Path(page)
    lines = path.read_text(encoding="utf-8").splitlines()
    left = dict(found)
    for columns, begin, end in reversed(list(tables(lines))):
        ours = [column for column in columns[1:] if column in left]
        if not ours:
            continue
        rows = {cells[0]: cells for cells in map(cells_of, lines[begin:end])}
        row = rows.setdefault(machine, [machine] + [NOT_MEASURED] * (len(columns) - 1))
        for column in ours:
            row[columns.index(column)] = left.pop(column)
        lines[begin:end] = ["| " + " | ".join(rows[name]) + " |" for name in sorted(rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return [f"{page} has no column '{column}'" for column in left]


def add_options(parser):
    parser.add_argument("--sizes", nargs=2, metavar=("PAGE", "MACHINE"), help="compare with the row of this machine")
    parser.add_argument("--note", action="store_true", help="write the row instead")


def check_or_note(options, found, allowed):
    """`found`: {column: text of a number}. Returns faults."""
    if not options.sizes:
        return []
    if options.note:
        return note(*options.sizes, found)
    return compare(*options.sizes, {column: float(text) for column, text in found.items()}, allowed)
