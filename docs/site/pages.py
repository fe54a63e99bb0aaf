"""What the site holds: the pages of docs/ and all files of the repository that they link to.

Every page has its path in the repository as its source, so that a link which is right on GitHub is
right in the site, and `mkdocs build --strict` fails on one that is not.
"""

import os
import re
from pathlib import Path

from mkdocs.structure.files import File, Files

ROOT = Path(__file__).parents[2]
HERE = "docs/site"
LINK = re.compile(r"\]\(([^)\s#]+)")
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.DOTALL | re.MULTILINE)


def on_files(files, config):
    """Give the site its files.

    Args:
        files: What MkDocs found in docs/, and what its theme brings.
        config: The configuration of the site.

    Returns:
        The theme's files, the assets of the site, and the pages with all that they link to.
    """
    brought = [one for one in files if one.src_uri.startswith("assets/") or not one.src_dir]
    paths = sorted((ROOT / "docs").rglob("*.md"))
    paths += [path for path in sorted((ROOT / HERE / "assets").rglob("*")) if path.is_file()]
    seen = list(dict.fromkeys(path.relative_to(ROOT).as_posix() for path in paths))
    for name in seen:
        seen += [other for other in linked(name) if other not in seen]
    return Files(brought + [file_of(name, config) for name in seen])


def linked(name):
    """Return the files of the repository that a page links to.

    Args:
        name: The page's path in the repository.

    Returns:
        Their paths in the repository, in the order of the links.
    """
    if not name.endswith(".md"):
        return []
    text = CODE.sub("", (ROOT / name).read_text("utf-8"))
    found = [os.path.normpath(Path(name).parent / one) for one in LINK.findall(text)]
    return [one for one in dict.fromkeys(found) if (ROOT / one).is_file()]


def file_of(name, config):
    """Return a file of the site: pages of docs/ stand at its top, assets in a folder of theirs.

    Args:
        name: The file's path in the repository.
        config: The configuration of the site.

    Returns:
        The file as MkDocs takes it.
    """
    made = File(name, str(ROOT), config.site_dir, config.use_directory_urls)
    made.dest_uri = made.dest_uri.removeprefix(HERE + "/").removeprefix("docs/")
    return made
