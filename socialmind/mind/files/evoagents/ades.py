"""`Skills/<Skill>/<Skill>.ades`: a skill (thesis, A.3). Reader and writer.

The skill's name, `input:N` and N lines of inputs, `output:N` and N lines of outputs, then the
internal function: `neural` with the lines of `network_lines`, `hardCoded` with `class:Name` for a
Python function in the skill's folder, or `cognitonScheme`, which is ours, with `scheme:file` and
`cogniton:number:Name` for each input that is not called as its cogniton.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from coglogo_py import CognitiveScheme
from socialmind.errors import ModelError, of_model_file
from socialmind.mind.files.evoagents.network_lines import NEURAL, network_lines, network_of
from socialmind.mind.files.evoagents.text_file import Line, Lines, field, inside, is_file, one_line
from socialmind.mind.files.python_file import load_beside
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.links import Input, Output
from socialmind.mind.modules import Skill

INPUT, OUTPUT = "input", "output"
CLASS, SCHEME, COGNITON = "class", "scheme", "cogniton"
FUNCTIONS = (NEURAL, Programmed.keyword, CognitonScheme.keyword)
GENERAL_REMEDY = "correct it; docs/minds_files.md shows the form"

Link = TypeVar("Link", Input, Output)


def parse(text: str, file: str | Path) -> Skill:
    r"""Return the skill that a file describes, without its weights.

    Args:
        text: the file's content.
        file: its path, for messages and for the files of programs and schemes beside it.

    Raises:
        ModelError: the text is no such file; says at which line and why.

    >>> text = "Avoid\ninput:1\nSE:S1\noutput:2\nMO:M1\nMO:M2\nneural\nlayers:2\n"
    >>> skill = parse(text, "Avoid.ades")
    >>> [str(one) for one in skill.outputs], skill.function
    (['MO:M1', 'MO:M2'], a perceptron of 2 hidden layers)
    """
    lines = Lines(text, file)
    name = lines.take("the name of a skill", "begin with its name")
    if len(name.fields) > 1:
        raise lines.error(
            repr(name.text), "the name of the skill", "begin with its name", name.number
        )
    where = f"in the skill {name.text!r}"
    inputs = _links(lines, INPUT, Input.parse, where)
    outputs = _links(lines, OUTPUT, Output.parse, where)
    keyword = lines.take(f"{' or '.join(FUNCTIONS)} {where}", "name its internal function")
    if keyword.text not in FUNCTIONS:
        lines.put_back()
        counted = f"do the numbers after {INPUT}: and {OUTPUT}: count its lines?"
        raise lines.unexpected(f"{' or '.join(FUNCTIONS)} {where}", counted)
    given = lines.rest()
    with lines.placing(name.number, GENERAL_REMEDY, where):
        function: InternalFunction
        if keyword.text == NEURAL:
            function = network_of(lines, given, len(inputs), len(outputs), keyword.number)
        elif keyword.text == Programmed.keyword:
            function = _program(lines, given, name.text, keyword)
        else:
            function = _scheme(lines, given, inputs, keyword)
        return Skill(name.text, inputs, outputs, function, None, lines.file, name.number)


def _links(
    lines: Lines, keyword: str, parse_link: Callable[[str, int], Link], where: str
) -> list[Link]:
    """Take the line with the number of inputs or outputs, and as many lines."""
    form = f"{keyword}:number {where}"
    head = lines.take(form)
    if head.fields[0] != keyword or len(head.fields) != 2:
        lines.put_back()
        remedy = f"write {keyword}:2 before two {keyword}s"
        if keyword == OUTPUT:
            remedy += f"; does {INPUT}: count the lines before?"
        raise lines.unexpected(form, remedy)
    count = lines.whole_number(head.fields[1], f"the number of {keyword}s {where}", head.number)
    links: list[Link] = []
    while len(links) < count:
        expected = f"{keyword} {len(links) + 1} of {count} {where}"
        remedy = f"correct the number in line {head.number}, or add what is missing"
        line = lines.take(expected, remedy)
        if line.fields[0] == OUTPUT or line.text in FUNCTIONS:
            lines.put_back()
            raise lines.unexpected(expected, remedy)
        form = "SE:S1 or SH:S1:5" if keyword == INPUT else "MO:M1 or SK:Avoid"
        with lines.placing(line.number, f"write it as {form}", where):
            links.append(parse_link(line.text, line.number))
    return links


def _parameters(
    lines: Lines, given: list[Line], keyword: Line, needed: str, allowed: tuple[str, ...]
) -> dict[str, list[Line]]:
    """Return the lines of a function by keyword; the needed one stands there once."""
    found: dict[str, list[Line]] = {}
    for line in given:
        if line.fields[0] not in allowed:
            raise lines.error(
                repr(line.text),
                " or ".join(f"{one}:" for one in allowed) + f" after {keyword.text}",
                "take the line out, or is it another function?",
                line.number,
            )
        found.setdefault(line.fields[0], []).append(line)
    if len(found.get(needed, [])) != 1 or len(found[needed][0].fields) != 2:
        count = len(found.get(needed, []))
        line = found[needed][-1] if count else keyword
        raise lines.error(
            repr(line.text) if count else f"{keyword.text} without {needed}:",
            f"one line {needed}:Name",
            "write which function it is" if needed == CLASS else "write which file it is",
            line.number,
        )
    return found


def _program(lines: Lines, given: list[Line], skill: str, keyword: Line) -> Programmed:
    """Return the function of `class:Name`: of Name.py, else of <Skill>.py."""
    line = _parameters(lines, given, keyword, CLASS, (CLASS,))[CLASS][0]
    written = line.fields[1]
    folder = Path(lines.file).parent
    path = folder / f"{Path(written).name}.py"
    if not is_file(path) and is_file(folder / f"{skill}.py"):
        path = folder / f"{skill}.py"
    function = load_beside(path, "", written, lines.file, line.number, only=True)
    return Programmed(function, written)


def _scheme(lines: Lines, given: list[Line], inputs: list[Input], keyword: Line) -> CognitonScheme:
    """Return the scheme of `scheme:file`, with the cognitons that inputs write."""
    found = _parameters(lines, given, keyword, SCHEME, (SCHEME, COGNITON))
    cognitons: dict[str, str] = {}
    for line in found.get(COGNITON, []):
        if len(line.fields) != 3:
            raise lines.error(
                repr(line.text), "cogniton:number of the input:Name", "write cogniton:0:Hunger",
                line.number,
            )  # fmt: skip
        place = lines.whole_number(line.fields[1], "the number of an input", line.number)
        if place >= len(inputs):
            raise lines.error(
                f"the input {place} in {line.text!r}",
                f"0 … {len(inputs) - 1}" if inputs else "no input, for there is none",
                "inputs are counted from 0, in their order",
                line.number,
            )
        if str(inputs[place]) in cognitons:
            raise lines.error(
                f"a second cogniton for the input {place}", "one", "take one out", line.number
            )
        cognitons[str(inputs[place])] = line.fields[2]
    line = found[SCHEME][0]
    return scheme_function(
        Path(lines.file).parent, line.fields[1], cognitons, lines.file, line.number
    )


def scheme_function(
    folder: Path, source: str, cognitons: dict[str, str], named_in: str, line: int | None
) -> CognitonScheme:
    """Return the internal function that a scheme's file describes.

    Args:
        folder: the folder from which the file's path leads.
        source: that path.
        cognitons: the cogniton that each input writes, as for `CognitonScheme`.
        named_in: the file that names it, for messages.
        line: its line there.

    Raises:
        ModelError: there is no such file, or it is no scheme.
    """
    path = inside(folder, source, "the scheme", named_in, line)
    if not source or not is_file(path):
        raise ModelError(
            f"the scheme {source!r}", "a file that there is", f"write {path}", named_in, line
        )
    with of_model_file(path):
        return CognitonScheme(CognitiveScheme.load(path), cognitons, source)


def written(skill: Skill) -> str:
    """Return the file of a skill, which reads back as an equal one.

    Its weights, a program's Python file and a scheme's file are written by `folder`.

    Raises:
        ModelError: a function that does not go into such a file.

    >>> from socialmind.mind.functions.elman import Elman
    >>> print(written(Skill("Avoid", ["SE:S1"], ["MO:M1"], Elman(1))), end="")
    Avoid
    input:1
    SE:S1
    output:1
    MO:M1
    neural
    TYPE:ELMAN
    LAYERS:1
    HIDDEN_TRANSFER:RELU
    HIDDEN_NEURON_ADDED:2
    """
    lines = [field(skill.name, "the name of a skill")]
    for keyword, links in ((INPUT, skill.inputs), (OUTPUT, skill.outputs)):
        lines.append(f"{keyword}:{len(links)}")
        for link in links:
            field(link.name, f"the name of a {link.module}")
            lines.append(str(link))
    function = skill.function
    if isinstance(function, Programmed):
        lines += [function.keyword, f"{CLASS}:{program_name(function)}"]
    elif isinstance(function, CognitonScheme):
        lines += [function.keyword, f"{SCHEME}:{scheme_name(skill, function)}"]
        for place, one in enumerate(skill.inputs):
            if str(one) in function.cognitons:
                cogniton = field(function.cognitons[str(one)], "the name of a cogniton")
                lines.append(f"{COGNITON}:{place}:{cogniton}")
    elif isinstance(function, NeatGraph) and skill.genome is not None:
        # The graph evolves together with its weights, and so it stands in their file.
        lines += [NEURAL, *network_lines(NeatGraph())]
    else:
        lines += [NEURAL, *network_lines(function)]
    return "\n".join(lines) + "\n"


def program_name(function: Programmed) -> str:
    """Return what `class:` says of a program.

    >>> def turn_left():
    ...     return 0.0, 1.0
    >>> program_name(Programmed(turn_left)), program_name(Programmed(turn_left, "TurnLeft"))
    ('turn_left', 'TurnLeft')
    """
    return function.written or function.name


def scheme_name(skill: Skill, function: CognitonScheme) -> str:
    """Return the name of the file that holds a skill's scheme."""
    name = Path(function.source).name or f"{skill.name}.yaml"
    return one_line(name, f"the file of the scheme of {skill.name!r}", ":#")
