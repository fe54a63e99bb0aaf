"""Files of schemes as an editor opens and saves them: what did not change stays byte for byte."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from coglogo_py import CognitiveScheme, DecisionMaker, SchemeError
from coglogo_py.files import cogscheme_file, yaml_file
from coglogo_py.files.reading import text_in
from socialmind.errors import SocialmindError
from socialmind.studio.schemes.document import Document, document_of, scheme_of
from socialmind.studio.schemes.rewriting import rewritten

YAML = (".yaml", ".yml")
SUFFIXES = (*YAML, ".cogscheme")
Makers = Iterable[type[DecisionMaker]]


@dataclass(frozen=True)
class Written:
    """The text of a scheme's file.

    Attributes:
        text: all of it.
        notes: what could not be kept, in sentences.
    """

    text: str
    notes: tuple[str, ...] = ()


def opened(path: Path, makers: Makers = ()) -> tuple[str, Document]:
    """Return the text of a scheme's file, and what it describes.

    Args:
        path: a YAML or CogLogo file.
        makers: decision makers of the modeller's own.

    Raises:
        SchemeError: it is none.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise SchemeError(f"{path.name}", f"a file that ends in {', '.join(SUFFIXES)}")
    text = text_in(path, latin_1=True)
    return text, document_of(CognitiveScheme.parsed(text, path, makers))


def written(
    document: Document, suffix: str, base: str = "", base_suffix: str = "", makers: Makers = ()
) -> Written:
    """Return the text of the file that a document is saved in.

    Args:
        document: what is to be saved.
        suffix: of the file.
        base: the text that the document was opened from; "" for none.
        base_suffix: of its file.
        makers: decision makers of the modeller's own.

    Raises:
        SchemeError: the document is no scheme, or the form cannot hold it.
    """
    makers = tuple(makers)
    scheme = scheme_of(document, makers)
    yaml = suffix.lower() in YAML
    scheme, notes = (scheme, ()) if yaml else _for_coglogo(scheme)
    if base and (base_suffix.lower() in YAML) == yaml:
        before = CognitiveScheme.parsed(base, f"text{base_suffix}", makers)
        if _same(scheme, before):
            return Written(base, notes)
        if yaml:
            return _changed(document, scheme, before, base, suffix, makers)
    if yaml:
        return Written(yaml_file.written(scheme))
    return Written(cogscheme_file.written(scheme), notes)


def _changed(
    document: Document,
    scheme: CognitiveScheme,
    before: CognitiveScheme,
    base: str,
    suffix: str,
    makers: Makers,
) -> Written:
    """Return a YAML text with what changed; written anew only where that cannot be told apart."""
    ends = "\r\n" if "\r\n" in base else "\n"
    order = None if scheme.plan_order is None else list(scheme.plan_order)
    try:
        text = rewritten(base.replace("\r\n", "\n"), document_of(before), document, order)
        if _same(CognitiveScheme.parsed(text, f"text{suffix}", makers), scheme):
            return Written(text.replace("\n", ends))
    except (SchemeError, SocialmindError):
        pass
    note = "the file was written anew: its comments could not be kept with this change"
    return Written(yaml_file.written(scheme).replace("\n", ends), (note,))


def _same(one: CognitiveScheme, other: CognitiveScheme) -> bool:
    return one == other and bool(one.plan_order) == bool(other.plan_order)


def _for_coglogo(scheme: CognitiveScheme) -> tuple[CognitiveScheme, tuple[str, ...]]:
    """Return a scheme as CogLogo's form can hold it, and what that leaves out, in sentences."""
    notes = []
    placeless = replace(scheme, groups=tuple(one.without_positions() for one in scheme.groups))
    if placeless.groups != scheme.groups:
        notes.append("CogLogo's form holds no places of groups and roles: they are laid out anew")
    if scheme.plans == scheme.linked_plans:
        return placeless, tuple(notes)
    named = {*scheme.linked_plans, *scheme.plan_positions}
    lost = [plan for plan in scheme.plans if plan not in named]
    if lost:
        notes.append(f"CogLogo's form holds no plans without links or positions: {', '.join(lost)}")
    else:
        notes.append("CogLogo's form holds no order of plans: that of the links is taken")
    return replace(placeless, plan_order=None), tuple(notes)
