"""The site's navigation: every page must be in it, and the API pages, which Doxygen makes beside the site's own, come last."""
import logging

from mkdocs.structure.nav import Link


def on_nav(nav, config, files):
    placed = {page.file.src_path for page in nav.pages}
    for file in files.documentation_pages():
        if file.src_path not in placed:
            logging.getLogger("mkdocs.navigation").warning("mkdocs.yml has no place for doc/%s", file.src_path)
    nav.items.append(Link("API", "api/index.html"))
    return nav
