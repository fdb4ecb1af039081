"""One table of the gallery, from the runs in a folder, and the commands that make them, put into a page between its markers.
usage: table.py FOLDER NAME PAGE COLUMN..."""
import json
import math
import pathlib
import sys

# Student's 97.5% quantile by degrees of freedom.
T975 = [math.nan, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
        2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042]


def mean(values):
    known = [v for v in values if v is not None]
    return sum(known) / len(known) if known else None


def of_targets(run, key):
    """The mean over the true targets, at steps that showed them."""
    return mean([t["at_sightings"][key] for t in run["evaluation"]["true_targets"]])


def robot(run, key):
    return run["evaluation"]["robot"]["all"][key]


def inner(run, *keys):
    """A number of an evaluation; none where something on the way to it is null."""
    value = run["evaluation"]
    for key in keys:
        value = value.get(key) if value else None
    return value


def false_ones(run):
    mapped, true = inner(run, "landmarks", "mapped"), inner(run, "landmarks", "true")
    return None if mapped is None or true is None else mapped - true


COLUMNS = {  # head, number of a run, decimals, factor
    "robot": ("robot [m]", lambda r: robot(r, "position_rmse_m"), 3, 1),
    "coverage": ("in its 95% ellipse [%]", lambda r: robot(r, "coverage_95"), 0, 100),
    "nees": ("NEES", lambda r: robot(r, "nees_mean"), 1, 1),
    "landmarks": ("landmarks [m]", lambda r: inner(r, "landmarks", "rmse_m"), 3, 1),
    "mapped": ("mapped", lambda r: inner(r, "landmarks", "mapped"), 1, 1),
    "false": ("of them false", false_ones, 1, 1),
    "targets": ("targets [m]", lambda r: of_targets(r, "position_rmse_m"), 3, 1),
    "target_heading": ("their headings [deg]", lambda r: of_targets(r, "heading_rmse_rad"), 1, math.degrees(1)),
    "target_coverage": ("in their 95% ellipses [%]", lambda r: of_targets(r, "coverage_95"), 0, 100),
    "tracked": ("tracked [%]", lambda r: mean([t["tracked_fraction"] for t in r["evaluation"]["true_targets"]]), 0, 100),
    "gospa": ("targets, GOSPA [m]", lambda r: inner(r, "target_set", "gospa_mean_m"), 2, 1),
    "relations": ("relations, step by step [m]", lambda r: inner(r, "relations", "translation_mean_error_m"), 3, 1),
    "path_relations": ("of the final path [m]", lambda r: inner(r, "relations", "path", "translation_mean_error_m"), 3, 1),
    "entropy": ("map entropy, step by step", lambda r: (r["summary"]["scan_map"] or {}).get("mean_map_entropy"), 2, 1),
    "path_entropy": ("of the final path", lambda r: (r["summary"]["scan_map"] or {}).get("path_entropy"), 2, 1),
    "cpu": ("CPU [% of the data's time]", lambda r: r["summary"]["timing"]["cpu_s"] / r["duration"], None, 100),
}


def cell(values, decimals, factor):
    known = [factor * v for v in values if v is not None]
    if not known:
        return "–"
    middle = sum(known) / len(known)
    if decimals is None:  # two digits: what a machine takes is not so exact
        return f"{middle:#.2g}".rstrip(".")
    if abs(middle) >= 100:
        decimals = 0
    text = f"{middle:.{decimals}f}"
    if len(known) < 2:
        return text
    deviation = math.sqrt(sum((v - middle) ** 2 for v in known) / (len(known) - 1))
    half = T975[min(len(known) - 1, len(T975) - 1)] * deviation / math.sqrt(len(known))
    return f"{text}\u00a0±\u00a0{half:.{decimals}f}"  # no line ends in it


def runs(folder):
    for path in sorted(folder.glob("*.json")):
        yield {"summary": json.loads(path.read_text()),
               "evaluation": json.loads(path.with_suffix(".evaluation").read_text()),
               "duration": float(path.with_suffix(".duration").read_text())}


def table(folder, columns):
    lines = ["| | " + " | ".join(COLUMNS[c][0] for c in columns) + " |", "| --- |" + " --- |" * len(columns)]
    for row in (folder / "rows").read_text().splitlines():
        name, label = row.split("\t")
        made = list(runs(folder / name))
        cells = [cell([COLUMNS[c][1](r) for r in made], *COLUMNS[c][2:]) for c in columns]
        lines.append(f"| {label} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main(folder, name, page, *columns):
    folder, page = pathlib.Path(folder), pathlib.Path(page)
    commands = (folder / "commands").read_text()
    begin, end = f"<!-- table {name} -->\n", "<!-- end -->"
    text = page.read_text()
    if begin not in text:
        sys.exit(f"table.py: error: {page} has no place for the table: write {begin.strip()} and {end} in it")
    head, rest = text.split(begin, 1)
    page.write_text(f"{head}{begin}\n{table(folder, columns)}\n\n```console\n{commands}```\n\n{end}{rest.split(end, 1)[1]}")


if __name__ == "__main__":
    main(*sys.argv[1:])
