#!/usr/bin/env python3
"""Links that lead nowhere, and whatever a page would fetch from elsewhere.
usage: links.py site FOLDER           of the site's own pages: files, and anchors in them
       links.py markdown FILE...      of Markdown as code hosts show it: files, and headings"""
import html.parser
import pathlib
import re
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.fetched = set(), [], []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.ids.update(v for k, v in attrs.items() if k in ("id", "name") and v)
        target = attrs.get("src") or attrs.get("href")
        if target and re.match(r"(https?:)?//", target):
            if tag in ("script", "img", "link", "iframe") and attrs.get("rel") != "canonical":
                self.fetched.append(target)
        elif target and not re.match(r"[a-z]+:", target):
            self.links.append(target)


def broken(source, links, ids_of):
    """Of links in `source`, those to no file, or to a place in it that is not there."""
    for link in links:
        path, _, anchor = urllib.parse.unquote(link).partition("#")
        target = (source.parent / path.partition("?")[0]) if path else source
        if target.is_dir():
            target /= "index.html"
        if not target.exists():
            yield f"{source}: {link} is not there"
        elif anchor and anchor not in ids_of(target):
            yield f"{source}: {link} has no such place"


def of_site(folder):
    pages = {p: Page(p) for p in sorted(folder.rglob("*.html")) if "api" not in p.relative_to(folder).parts}
    ids = lambda path: pages[path].ids if path in pages else set()
    for path, page in pages.items():
        if path.name != "404.html":
            yield from broken(path, [l for l in page.links if not l.startswith("#__")], lambda p: ids(p.resolve()))
        yield from (f"{path}: fetches {f}" for f in page.fetched)


def headings(path):
    """The anchors that code hosts give a file's headings."""
    text = re.sub(r"^```.*?^```", "", path.read_text(), flags=re.S | re.M)
    for heading in re.findall(r"^#+ +(.*)$", text, flags=re.M):
        yield re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def of_markdown(path):
    text = re.sub(r"^```.*?^```|`[^`\n]*`", "", path.read_text(), flags=re.S | re.M)
    links = [l for l in re.findall(r"\]\(([^)\s]+)\)", text) if not re.match(r"[a-z]+:", l)]
    return broken(path, links, lambda p: set(headings(p)))


def main(kind, *paths):
    files = [pathlib.Path(p).resolve() for p in paths]
    found = list(of_site(files[0])) if kind == "site" else [b for f in files for b in of_markdown(f)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
