#!/usr/bin/env python3
"""Public names that say nothing of themselves, of Doxygen's XML: also those that Doxygen does not warn of.
usage: undocumented.py XML_FOLDER    one a line as `file:line: name`; status 1 if there are any"""
import pathlib
import sys
import xml.etree.ElementTree as ET

SILENT = {"dir", "file", "page", "example"}  # compounds that are nobody's names; their members are


def documented(node):
    return any("".join(node.find(part).itertext()).strip()
               for part in ("briefdescription", "detaileddescription") if node.find(part) is not None)


def is_plain(member):
    """Destructors and what the compiler writes say all by their declaration."""
    name, args = member.findtext("name"), member.findtext("argsstring") or ""
    return name.startswith("~") or args.replace(" ", "").endswith(("=default", "=delete"))


def undocumented(compound):
    if compound.get("prot") == "private":
        return
    place, name = compound.find("location"), compound.findtext("compoundname")
    foreign = compound.get("kind") == "namespace" and not name.startswith("slamot")  # declared, not ours
    if compound.get("kind") not in SILENT and not foreign and not documented(compound):
        yield place, name
    for member in compound.iter("memberdef"):
        if member.get("prot") == "private" or member.get("kind") == "friend":
            continue
        full = f"{name}::{member.findtext('name')}"
        if not is_plain(member) and not documented(member):
            yield member.find("location"), full
        for value in member.findall("enumvalue"):
            if not documented(value):
                yield member.find("location"), f"{full}::{value.findtext('name')}"


def main(folder):
    found = set()
    for path in sorted(pathlib.Path(folder).glob("*.xml")):
        for compound in ET.parse(path).getroot().findall("compounddef"):
            for place, name in undocumented(compound):
                if place.get("file") != "[generated]":
                    found.add((place.get("file"), int(place.get("line")), name))
    for file, line, name in sorted(found):
        print(f"{file}:{line}: {name}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
