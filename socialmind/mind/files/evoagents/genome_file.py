"""`Skills/<Skill>/<Skill>.genome`: the weights of a skill. Reader and writer.

A text file that needs nothing but itself to be understood: its version, the skill, its function in
the lines of an `.ades` file (for a NEAT graph with the topology), how many weights, one weight a
line in the genome's order, and `end`, which shows that nothing was cut off. Weights are written
with as many digits as it takes to read back the same bits. docs/minds_files.md describes the order.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from socialmind.mind.files.evoagents.network_lines import NEURAL, network_lines, network_of
from socialmind.mind.files.evoagents.text_file import NUMBER, Lines
from socialmind.mind.functions.contract import InternalFunction
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.modules import Skill

FORMAT = "socialmind genome"
VERSION = 1
WEIGHTS, END = "weights", "end"
CUT_OFF = "the file was cut off: take a whole copy of it, or train the skill again"


def parse(text: str, file: str | Path, skill: Skill) -> Skill:
    """Return a skill with the weights that a file holds.

    A skill whose NEAT graph is not drawn yet gets the file's graph as well.

    Args:
        text: the file's content.
        file: its path, for messages.
        skill: the skill without weights.

    Raises:
        ModelError: the text is no such file, or belongs to another skill or function; says at
            which line and why.

    >>> from socialmind.mind.functions.perceptron import Perceptron
    >>> seek = Skill("Seek", ["SE:S1"], ["MO:M1"], Perceptron(layers=0), [0.1, -2.0])
    >>> parse(written(seek), "Seek.genome", seek.changed(genome=None)).genome
    array([ 0.1, -2. ])
    """
    lines = Lines(text, file)
    other = lines.next is not None and lines.next.text.startswith(FORMAT + " ")
    begin = f"begin with {FORMAT} {VERSION}; is it a file of weights?"
    wrong_version = "read it with the version of socialmind that wrote it" if other else begin
    lines.keyword(f"{FORMAT} {VERSION}", wrong_version, CUT_OFF)
    lines.keyword(f"skill:{skill.name}", f"is it the file of {skill.name!r}?", CUT_OFF)
    retrain = "train the skill again, or give it back the inputs and outputs it had"
    lines.keyword(f"inputs:{len(skill.inputs)}", retrain, CUT_OFF)
    lines.keyword(f"outputs:{len(skill.outputs)}", retrain, CUT_OFF)
    function = _function(lines, skill)
    skill = skill.changed(function=function, genome=None)
    genome = _weights(lines, skill)
    return skill.changed(genome=genome)


def _function(lines: Lines, skill: Skill) -> InternalFunction:
    """Take the lines of the function; it must be the skill's."""
    begun = lines.keyword(NEURAL, "after it come the lines of the network", CUT_OFF)
    given = []
    while (line := lines.next) is not None and line.fields[0] != WEIGHTS:
        if NUMBER.fullmatch(line.text):
            raise lines.unexpected(f"{WEIGHTS}:number", "write how many weights follow")
        given.append(lines.take(WEIGHTS))
    if line is None:
        raise lines.unexpected(f"{WEIGHTS}:number", CUT_OFF)
    function = network_of(lines, given, len(skill.inputs), len(skill.outputs), begun.number)
    undrawn = skill.function == NeatGraph() and isinstance(function, NeatGraph)
    if not undrawn and function != skill.function:
        raise lines.error(
            f"weights of {function}",
            f"weights of {skill.function}, the function of the skill {skill.name!r}",
            f"give {skill.name!r} the function that the weights were trained for, or train again",
            begun.number,
        )
    return function


def _weights(lines: Lines, skill: Skill) -> NDArray[np.float64]:
    size = skill.genome_size
    counted = f"{len(skill.inputs)} inputs, {len(skill.outputs)} outputs and {skill.function}"
    lines.keyword(f"{WEIGHTS}:{size}", f"so many have {counted}: train the skill again", CUT_OFF)
    weights = np.empty(size)
    for place in range(size):
        expected = f"weight {place + 1} of {size} of the skill {skill.name!r}"
        line = lines.take(expected, CUT_OFF)
        weight = float(line.text) if NUMBER.fullmatch(line.text) else math.nan
        if not math.isfinite(weight):
            lines.put_back()
            remedy = CUT_OFF if line.text == END else "write a finite number, as 0.5"
            raise lines.unexpected(f"{expected}, a finite number", remedy)
        weights[place] = weight
    lines.keyword(END, f"take out what is more than {size} weights", CUT_OFF)
    if lines.next is not None:
        raise lines.unexpected(f"nothing after {END}", "take out what is too much")
    return weights


def written(skill: Skill) -> str:
    """Return the file of a skill's weights.

    Raises:
        ModelError: the skill has none.

    >>> from socialmind.mind.functions.perceptron import Perceptron
    >>> seek = Skill("Seek", ["SE:S1"], ["MO:M1"], Perceptron(layers=0), [0.1, -2.0])
    >>> print(written(seek), end="")
    socialmind genome 1
    # a perceptron of no hidden layer
    skill:Seek
    inputs:1
    outputs:1
    neural
    TYPE:BASIC
    LAYERS:0
    HIDDEN_TRANSFER:RELU
    HIDDEN_NEURON_ADDED:2
    weights:2
    0.1
    -2.0
    end
    """
    if skill.genome is None:
        raise skill.refused("without weights", "weights", "set its genome before it is saved")
    lines = [
        f"{FORMAT} {VERSION}",
        f"# {skill.function}",
        f"skill:{skill.name}",
        f"inputs:{len(skill.inputs)}",
        f"outputs:{len(skill.outputs)}",
        NEURAL,
        *network_lines(skill.function),
        f"{WEIGHTS}:{len(skill.genome)}",
        *(repr(weight) for weight in skill.genome.tolist()),
        END,
    ]
    return "\n".join(lines) + "\n"
