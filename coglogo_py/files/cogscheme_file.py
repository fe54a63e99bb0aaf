"""CogLogo's own files of cognitive schemes: text, one token a line. Reader and writer.

The reader takes every file that CogLogo 1.18.1 loads and understands it alike, but for these:

- repeated names are one thing: a cogniton's links gather in the first, as in CogLogo, and no empty
  second one is kept; `CognitiveScheme.check` reports them;
- repeated dependency lines are one link;
- groups of a scheme without cognitons are groups, not breeds;
- a missing line for the decision maker means MaximumWeight, with a warning;
- a missing ENDCS is no error, as in CogLogo, but for a warning: the file may have been cut off;
- a bias not above 0, NaN or infinite numbers and unknown decision makers are errors.

The grammar stands in docs/schemes.md. Blank lines and spaces are part of names.
"""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from coglogo_py import parts
from coglogo_py.border.errors import SchemeError, shown
from coglogo_py.decision import DecisionMaker, MaximumWeight, decision_maker_called
from coglogo_py.parts import AScheme, Cogniton, Culturon, Group, Role, Scheme

SECTIONS = ("INFLUENCE", "DEPENDENCY", "REINFORCEMENT")
OF_YAML_ALONE = (
    *("active_while", "activated_when", "deactivated_when"),
    *("type", "chance", "inherited"),
)
"""What of a cogniton such a file does not hold."""
KEYWORDS = frozenset(("STARTCS", "PLANPOS", "BREEDS", "COG", "GRP", "ROL", *SECTIONS, "ENDCS"))

# What Java's parseDouble takes, less hexadecimal, NaN and Infinity.
NUMBER = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)[dDfF]?\s*", re.A)
WHOLE_NUMBER = re.compile(r"[+-]?[0-9]{1,15}", re.A)


def parse(
    text: str,
    file: str | Path,
    kind: Callable[..., AScheme],
    decision_makers: Iterable[type[DecisionMaker]] = (),
) -> AScheme:
    r"""Return the scheme that a CogLogo file describes.

    Args:
        text: the file's content; lines end in LF, CR LF or CR.
        file: its path, for messages.
        kind: the class of the scheme.
        decision_makers: decision makers of the modeller's own that the file may name.

    Raises:
        SchemeError: the text is no scheme; says at which line and why.

    >>> from coglogo_py import CognitiveScheme
    >>> text = "STARTCS\ncows\nMaximumWeight\nCOG\nhunger\n-256\ntrue\nINFLUENCE\neat=2\n"
    >>> dict(parse(text, "cows.cogscheme", CognitiveScheme).cognitons[0].influence)
    {'eat': 2.0}
    """
    lines = _Lines(text, file)
    if lines.next != "STARTCS":
        raise lines.unexpected(
            "STARTCS", "is it a CogLogo scheme? One of the other form must end in .yaml"
        )
    lines.take("STARTCS")
    name = lines.take("the name of the scheme")
    maker = _decision_maker(lines, decision_makers)
    positions: dict[str, tuple[int, int]] = {}
    breeds: list[str] = []
    while lines.next in ("PLANPOS", "BREEDS"):
        if lines.take("a section") == "PLANPOS":
            while lines.in_section:
                plan, value = lines.pair("plan=x:y")
                positions[plan] = lines.position(value)
        else:
            while lines.next not in ("PLANPOS", "COG", "GRP", "ENDCS", None):
                breeds.append(lines.take("a breed"))
    repeated: list[str] = []
    cognitons = _cognitons(lines, repeated)
    groups = _groups(lines, repeated)
    if lines.next not in ("ENDCS", None):
        expected = "PLANPOS, BREEDS, COG, GRP or ENDCS"
        if groups or cognitons:
            expected = "ROL, GRP or ENDCS" if groups else "COG, GRP or ENDCS"
        raise lines.unexpected(expected, "every section begins with its keyword")
    if lines.next is None:
        lines.warn("no ENDCS at the end; the file may have been cut off", lines.taken)
    return kind(
        name,
        cognitons,
        groups,
        maker,
        tuple(breeds),
        positions,
        repeated=tuple(repeated),
    )


class _Lines:
    """The lines of a file, taken one after another."""

    def __init__(self, text: str, file: str | Path) -> None:
        self.file = file
        # Not splitlines, which also splits at characters that a name may hold.
        self.lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        if self.lines[-1] == "":
            self.lines.pop()
        self.taken = 0

    @property
    def next(self) -> str | None:
        """The line to be taken next, None at the end of the file."""
        return self.lines[self.taken] if self.taken < len(self.lines) else None

    @property
    def in_section(self) -> bool:
        """Whether the next line goes on with the section rather than beginning something."""
        return self.next is not None and self.next not in KEYWORDS

    def take(self, expected: str) -> str:
        line = self.next
        if line is None:
            raise self.unexpected(expected, "the file may have been cut off")
        self.taken += 1
        return line

    def named(self, keyword: str, what: str) -> Iterator[tuple[int, str]]:
        """Take the keyword and the name of each of several parts; yield the keyword's line too."""
        while self.next == keyword:
            self.take(keyword)
            line = self.taken
            yield line, self.take(f"the name of {what}")

    def unexpected(self, expected: str, remedy: str | None = None) -> SchemeError:
        """Return the error that the next line is not what is expected."""
        found = "the end of the file" if self.next is None else shown(self.next)
        return SchemeError(found, expected, remedy, self.file, self.taken + 1)

    def wrong(self, expected: str, remedy: str | None = None) -> SchemeError:
        """Return the error that the line just taken is not what is expected."""
        return SchemeError(
            shown(self.lines[self.taken - 1]), expected, remedy, self.file, self.taken
        )

    def warn(self, message: str, line: int) -> None:
        warnings.warn(f"{self.file}:{line}: {message}", stacklevel=2)

    def number(self, text: str) -> float:
        match = NUMBER.fullmatch(text)
        number = float(match[1]) if match else math.nan
        if not math.isfinite(number):
            raise self.wrong("a finite number", "write it with a point, as 0.5")
        return number

    def whole_number(self, text: str) -> int:
        if not WHOLE_NUMBER.fullmatch(text) or not -(2**31) <= int(text) < 2**31:
            raise self.wrong("a whole number of 32 bits")
        return int(text)

    def position(self, text: str) -> tuple[int, int]:
        x, colon, y = text.partition(":")
        if not colon:
            raise self.wrong("a position x:y", "write two whole numbers, as 97:-20")
        return self.whole_number(x), self.whole_number(y)

    def pair(self, form: str) -> tuple[str, str]:
        plan, equals, value = self.take(form).partition("=")
        if not equals:
            raise self.wrong(form, "the sections after it begin with their keyword")
        return plan, value


def _decision_maker(lines: _Lines, decision_makers: Iterable[type[DecisionMaker]]) -> DecisionMaker:
    if not lines.in_section:
        lines.warn("no line for the decision maker; MaximumWeight is taken", lines.taken + 1)
        return MaximumWeight()
    words = lines.take("a decision maker").split()
    if len(words) not in (1, 2):
        raise lines.wrong("a decision maker and its bias", "write MaximumWeight 1.0")
    bias = lines.number(words[1]) if len(words) == 2 else 1.0
    try:
        return decision_maker_called(words[0], bias, decision_makers)
    except SchemeError as error:
        raise error.at(lines.file, lines.taken) from None


def _cognitons(lines: _Lines, repeated: list[str]) -> tuple[Cogniton, ...]:
    # Links gather in the first of a name, and are joined once: there may be many.
    found: dict[str, list[Cogniton]] = {}
    for line, name in lines.named("COG", "a cogniton"):
        colour = _colour(lines)
        starting = _starting(lines, name)
        start_value, position = _value_and_position(lines)
        if name in found:
            repeated.append(f"cogniton {name!r} (line {line})")
        one = Cogniton(name, starting, start_value, colour, position, *_links(lines))
        found.setdefault(name, []).append(one)
    return tuple(
        Cogniton(first.name, first.starting, first.start_value, first.colour, first.position,
                 *parts.links_together([first, *others]))
        for first, *others in found.values()
    )  # fmt: skip


def _groups(lines: _Lines, repeated: list[str]) -> tuple[Group, ...]:
    groups: dict[str, dict[str, dict[str, list[Culturon]]]] = {}
    for line, group in lines.named("GRP", "a group"):
        if group in groups:
            repeated.append(f"group {group!r} (line {line})")
        roles = groups.setdefault(group, {})
        for line, role in lines.named("ROL", "a role"):
            if role in roles:
                repeated.append(f"role {role!r} of group {group!r} (line {line})")
            culturons = roles.setdefault(role, {})
            for line, name in lines.named("COG", "a culturon"):
                if name in culturons:
                    repeated.append(f"culturon {name!r} of role {role!r} (line {line})")
                culturons.setdefault(name, []).append(_culturon(lines, name))
        if lines.next == "COG":
            raise lines.unexpected("ROL, GRP or ENDCS", "a culturon stands in a role of its group")
    return tuple(
        Group(
            group,
            tuple(
                Role(role, tuple(map(parts.one_culturon, held.values())))
                for role, held in roles.items()
            ),
        )
        for group, roles in groups.items()
    )


def _culturon(lines: _Lines, name: str) -> Culturon:
    colour = _colour(lines)
    start_value, position = _value_and_position(lines)
    return Culturon(name, start_value, colour, position, *_links(lines))


def _colour(lines: _Lines) -> tuple[int, int, int]:
    rgb = lines.whole_number(lines.take("a colour, a whole number"))
    return rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255


def _starting(lines: _Lines, name: str) -> bool:
    """Take the line that says whether a cogniton is there at birth; anything but true is false."""
    if not lines.in_section:
        lines.warn(
            f"nothing says whether cogniton {name!r} is there at birth; taken as false",
            lines.taken + 1,
        )
        return False
    word = lines.take("true or false").lower()
    if word not in ("true", "false"):
        lines.warn(f"found {word!r} for true or false; taken as false", lines.taken)
    return word == "true"


def _value_and_position(lines: _Lines) -> tuple[float, tuple[int, int] | None]:
    value = lines.number(lines.take("a value")) if lines.in_section else 0.0
    position = lines.position(lines.take("a position")) if lines.in_section else None
    return value, position


def _links(lines: _Lines) -> tuple[dict[str, float], tuple[str, ...], dict[str, float]]:
    """Take the sections of a cogniton or culturon."""
    if lines.next != "INFLUENCE":
        raise lines.unexpected("INFLUENCE", "write the section even if it is empty")
    weights: dict[str, dict[str, float]] = {"INFLUENCE": {}, "REINFORCEMENT": {}}
    conditional: list[str] = []
    while lines.next in SECTIONS:
        section = lines.take("a section")
        while lines.in_section:
            if section == "DEPENDENCY":
                conditional.append(lines.take("a plan"))
            else:
                plan, value = lines.pair("plan=weight")
                weights[section][plan] = lines.number(value)
    return weights["INFLUENCE"], tuple(conditional), weights["REINFORCEMENT"]


def written(scheme: Scheme) -> str:
    """Return the CogLogo file of a scheme, which reads back as an equal scheme.

    Args:
        scheme: the scheme to write.

    Raises:
        SchemeError: a name, or the written-out order of plans, does not go into such a file.

    >>> from coglogo_py import CognitiveScheme
    >>> print(written(CognitiveScheme("cows", breeds=("bulls",))))
    STARTCS
    cows
    MaximumWeight 1.0
    BREEDS
    bulls
    ENDCS
    <BLANKLINE>
    """
    for group in scheme.groups:
        if group.attributes:
            raise SchemeError(
                f"attributes of the group {group.name!r}",
                "none: a CogLogo file holds no attributes of groups",
                "save it as .yaml",
            )
        if group.within is not None:
            raise SchemeError(
                f"the group {group.name!r} within {group.within[0]!r}",
                "none: a CogLogo file holds no groups in others",
                "save it as .yaml",
            )
        if group != group.without_positions():
            raise SchemeError(
                f"positions of the group {group.name!r} or of its roles",
                "none: a CogLogo file holds those of cognitons, culturons and plans",
                "save it as .yaml",
            )
    for one in scheme.cognitons:
        plain = Cogniton(one.name, one.starting, one.start_value)
        for name in OF_YAML_ALONE:
            if getattr(one, name) != getattr(plain, name):
                raise SchemeError(
                    f"{name} of the cogniton {one.name!r}",
                    "none: a CogLogo file does not hold it",
                    "save it as .yaml",
                )
    if scheme.plans != scheme.linked_plans:
        raise SchemeError(
            f"the plans' own order {list(scheme.plans)}",
            f"the order in which links name them, {list(scheme.linked_plans)}: "
            "a CogLogo file holds no other",
            "save it as .yaml, or give up the order with "
            "dataclasses.replace(scheme, plan_order=None)",
        )
    if scheme.groups and not scheme.cognitons:
        warnings.warn(
            f"scheme {scheme.name!r} has groups but no cogniton: CogLogo 1.18.1 takes them for "
            "breeds; add a cogniton if the file is meant for it",
            stacklevel=3,
        )
    maker = scheme.decision_maker
    lines = ["STARTCS", _token(scheme.name, "scheme")]
    lines.append(f"{_token(maker.name, 'decision maker')} {maker.bias!r}")
    if scheme.plan_positions:
        lines.append("PLANPOS")
        for plan, (x, y) in scheme.plan_positions.items():
            lines.append(f"{_key(plan)}={x}:{y}")
    lines.append("BREEDS")
    lines.extend(_token(breed, "breed") for breed in scheme.breeds)
    for cogniton in scheme.cognitons:
        lines += ["COG", _token(cogniton.name, "cogniton"), _argb(cogniton.colour)]
        lines.append("true" if cogniton.starting else "false")
        lines += _rest(cogniton)
    for group in scheme.groups:
        lines += ["GRP", _token(group.name, "group")]
        for role in group.roles:
            lines += ["ROL", _token(role.name, "role")]
            for culturon in role.culturons:
                lines += ["COG", _token(culturon.name, "culturon"), _argb(culturon.colour)]
                lines += _rest(culturon)
    lines.append("ENDCS")
    return "\n".join(lines) + "\n"


def _rest(holder: Cogniton | Culturon) -> list[str]:
    """Return the lines of a cogniton or culturon from its value on."""
    lines = [repr(holder.start_value)]
    if holder.position is not None:
        lines.append(f"{holder.position[0]}:{holder.position[1]}")
    lines.append("INFLUENCE")
    lines += [f"{_key(plan)}={weight!r}" for plan, weight in holder.influence.items()]
    lines.append("DEPENDENCY")
    lines += [_token(plan, "plan") for plan in holder.conditional]
    lines.append("REINFORCEMENT")
    lines += [f"{_key(plan)}={weight!r}" for plan, weight in holder.reinforcement.items()]
    return lines


def _argb(colour: tuple[int, int, int]) -> str:
    """Return an opaque colour as Java's signed whole number."""
    red, green, blue = colour
    return str((red << 16 | green << 8 | blue) - 2**24)


def _token(name: str, what: str) -> str:
    checks = (
        ("a name on one line", "\n" not in name and "\r" not in name),
        ("text", "\0" not in name),
        ("a name other than the keywords of the file", name not in KEYWORDS),
    )
    for expected, fits in checks:
        if not fits:
            found = f"the {what} name {name!r}"
            raise SchemeError(found, expected, "rename it or save it as .yaml")
    return name


def _key(plan: str) -> str:
    """Return a plan's name for the left of an equals sign."""
    if "=" in plan:
        raise SchemeError(
            f"the plan name {plan!r}", "a name without '='", "rename it or save it as .yaml"
        )
    return _token(plan, "plan")
